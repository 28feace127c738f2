// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <vector>

namespace reflet {

/// The filters of FLIP (Andersson et al. 2020, sections 4.1.1 and 4.2.1) for one observer, each
/// taken apart into one pass along rows and one along columns. All are cut off at three standard
/// deviations of the widest; beyond the border, the pixels of the border go on.
class FlipFilters {
public:
    explicit FlipFilters(double pixelsPerDegree);

    /// Contrast sensitivity on the three opponent channels; rows of `width` pixels.
    [[nodiscard]] std::vector<glm::dvec3> contrast(std::span<const glm::dvec3> opponent,
                                                   int width) const;
    /// The length of the gradient, and of the second derivatives, that the eye's edge and point
    /// detectors give; of a channel in [0, 1].
    [[nodiscard]] std::vector<double> edges(std::span<const double> lightness, int width) const;
    [[nodiscard]] std::vector<double> points(std::span<const double> lightness, int width) const;

private:
    /// One-dimensional, of odd length, the middle at the pixel itself.
    using Kernel = std::vector<double>;
    template <class T>
    static std::vector<T> convolve(std::span<const T> in, int width, const Kernel& alongRows,
                                   const Kernel& alongColumns);
    [[nodiscard]] std::vector<double> strength(std::span<const double> lightness, int width,
                                               const Kernel& derivative) const;

    /// A channel's kernel is a weighted sum of round Gaussians, the weights adding up to 1.
    struct Gaussian {
        double weight = 0.0;
        Kernel kernel;
    };
    std::array<std::vector<Gaussian>, 3> m_contrast;
    Kernel m_smooth, m_edge, m_point;
};

}  // namespace reflet
