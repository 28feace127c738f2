// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Linear radiance × exposure → sRGB code values in [0, 1], clipped (IEC 61966-2-1). NaN is black.
[[nodiscard]] glm::vec3 toDisplay(const glm::vec3& radiance, float exposure);
/// One channel, not clipped from above; the linear piece goes on below zero.
[[nodiscard]] float srgbFromLinear(float linear);
[[nodiscard]] float linearFromSrgb(float encoded);

/// A picture of display values in [0, 1], rows from the top.
struct DisplayImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
};
/// The six faces below one another, transformed for display.
[[nodiscard]] DisplayImage displayStrip(const CubeMap<glm::vec3>& radiance, float exposure);

/// Pools squared errors over any number of image pairs; PSNR = 10 log10(1 / mean squared error)
/// over all channels of all pooled pixels, peak 1. nullopt when the images are identical (or none
/// was added): an infinite figure is not a number.
class PsnrAccumulator {
public:
    /// mask: empty, or one entry per pixel, non-zero where it counts. Sizes must agree.
    void add(const DisplayImage& image, const DisplayImage& reference,
             std::span<const unsigned char> mask = {});
    [[nodiscard]] std::optional<double> decibels() const;

private:
    double m_squaredError = 0.0;
    std::size_t m_samples = 0;
};

/// Pools the mean absolute difference of display values over all channels of any number of image
/// pairs: 0 for identical images, 1 for black against white.
class MeanErrorAccumulator {
public:
    /// mask: as of PsnrAccumulator.
    void add(const DisplayImage& image, const DisplayImage& reference,
             std::span<const unsigned char> mask = {});
    /// nullopt when nothing was added.
    [[nodiscard]] std::optional<double> mean() const;

private:
    double m_error = 0.0;
    std::size_t m_samples = 0;
};

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004): 11×11 Gaussian window, sigma 1.5,
/// K1 = 0.01, K2 = 0.03, dynamic range 1, on luma (Rec. 601 weights as in the authors' code) of the
/// display values, mean over the windows that lie wholly inside. An image six times as high as wide
/// is a cube strip: no window crosses from one face into the next.
/// nullopt when an image (or a face) is smaller than the window, or the images are identical.
[[nodiscard]] std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference);
/// The same over the pixels where mask (one entry per pixel, or empty: all) is non-zero, windows
/// centred on them; nullopt also when no window is.
[[nodiscard]] std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference,
                                         std::span<const unsigned char> mask);

}  // namespace reflet
