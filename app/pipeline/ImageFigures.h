// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"
#include "core/environment/Flip.h"

#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// How near pictures come to their references, in display values: sRGB at the project's exposure,
/// clipped to [0, 1]. nullopt = identical (or nothing compared).
struct ImageFigures {
    std::optional<double> psnr;  ///< dB, squared errors pooled over all pictures
    std::optional<double> ssim;  ///< averaged over pictures (faces of local maps)
    std::optional<double> flip;  ///< mean over all pixels, 0..1
    double meanError = 0.0;      ///< mean absolute difference over all pixels and channels, 0..1
};

/// Gathers the figures of one method over any number of pairs of pictures.
class ImageTally {
public:
    /// Pictures of one size; mask: empty, or one entry per pixel, non-zero where it counts.
    /// Returns FLIP's error for each pixel.
    std::vector<float> add(const DisplayImage& image, const DisplayImage& reference,
                           std::span<const unsigned char> mask);
    /// Local maps of one resolution as strips of six faces, each face a picture of 90 degrees.
    /// Returns FLIP's error for each texel.
    std::vector<float> add(const LocalEnvironmentMap& ours, const LocalEnvironmentMap& truth,
                           float exposure);
    [[nodiscard]] ImageFigures figures() const;

private:
    PsnrAccumulator m_squared;
    MeanErrorAccumulator m_absolute;
    FlipAccumulator m_flip;
    std::vector<double> m_ssim;
};

}  // namespace reflet
