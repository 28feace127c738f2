// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/environment/CubeMap.h"

namespace reflet {

/// Linear radiance × exposure → sRGB code values in [0, 1], clipped (IEC 61966-2-1).
[[nodiscard]] glm::vec3 toDisplay(const glm::vec3& radiance, float exposure);
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
    void add(const DisplayImage& image, const DisplayImage& reference, std::span<const unsigned char> mask = {});
    [[nodiscard]] std::optional<double> decibels() const;

private:
    double m_squaredError = 0.0;
    std::size_t m_samples = 0;
};

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004): 11×11 Gaussian window, sigma 1.5,
/// K1 = 0.01, K2 = 0.03, on luma (Rec. 601 weights as in the authors' code) of the display values,
/// mean over the windows that lie wholly inside (for a cube strip: per face, then averaged).
/// nullopt when an image is smaller than the window, or the images are identical.
[[nodiscard]] std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference);
/// The same over the pixels where mask is non-zero (windows centred on them).
[[nodiscard]] std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference,
                                         std::span<const unsigned char> mask);

}  // namespace reflet
