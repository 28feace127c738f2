// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/ImageMetrics.h"

#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Pixels per degree of a picture 0.7 m wide on 3840 pixels, seen from 0.7 m: the observer whom the
/// authors of FLIP take where nothing is known.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// Pixels per degree of a cube map's face: its edge spans 90 degrees.
[[nodiscard]] constexpr double facePixelsPerDegree(int resolution) {
    return double(resolution) / 90.0;
}

/// LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A
/// Difference Evaluator for Alternating Images"): for each pixel, from 0 (the same) to 1, how much
/// an observer who flips between two display images sees change. Both are filtered with the eye's
/// contrast sensitivity (section 4.1.1), colours compared with Hunt-adjusted HyAB distances (4.1.2,
/// 4.1.3), and edges and points that appear or vanish raise the difference (4.2, 4.3).
///
/// Beyond its border a picture is taken to go on with the pixels of its border, as the authors do.
/// An image six times as high as wide is a cube strip: no window crosses from one face into the
/// next. pixelsPerDegree > 0; sizes must agree.
[[nodiscard]] std::vector<float> flipMap(const DisplayImage& image, const DisplayImage& reference,
                                         double pixelsPerDegree);

/// Pools FLIP over any number of image pairs: the mean over all pixels that count.
class FlipAccumulator {
public:
    /// mask: empty, or one entry per pixel, non-zero where it counts. errors: of flipMap.
    void add(std::span<const float> errors, std::span<const unsigned char> mask = {});
    /// nullopt when nothing was added.
    [[nodiscard]] std::optional<double> mean() const;

private:
    double m_sum = 0.0;
    std::size_t m_pixels = 0;
};

/// A heat map for people: black, violet, orange, yellow and white at 0, 1/4, 1/2, 3/4 and 1, of
/// steadily growing luminance (readable in grey and by the colour-blind).
[[nodiscard]] glm::vec3 heatColor(float error);
/// The pixels of flipMap as a picture of the given width.
[[nodiscard]] DisplayImage heatImage(std::span<const float> errors, int width);

}  // namespace reflet
