// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/Vehicle.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace reflet {

/// Where a vehicle's body takes its reflections from, as a viewer sees it: directions weighted by
/// the area in the viewer's picture that shows them, times how strongly it mirrors there (Fresnel
/// of paint and glass, base colour of chrome). Hidden parts of the body are not told from visible
/// ones, but what faces away does not count.
///
/// Made once for viewers all around at several heights and distances; the one most like the viewer
/// asked for answers. Frame of the vehicle: x forward, y left, z up, origin at the vehicle's middle
/// on the running surface; metres.
class BodyReflections {
public:
    /// All bodies in a row, as on a straight road.
    explicit BodyReflections(const Vehicle& vehicle);

    /// A unit direction in the vehicle's frame, drawn by the weights: `u` in [0, 1)², evenly spread
    /// u give directions spread by the weights.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& eye, const glm::dvec2& u) const;
    /// Height of the middle of the vehicle's bodies above the running surface.
    [[nodiscard]] double centerHeight() const { return m_centerHeight; }
    [[nodiscard]] double length() const { return m_length; }
    /// The share of the weight of a viewer in each texel of a cube map (CubeDirection), with
    /// kResolution texels along an edge, face by face; sums to 1.
    static constexpr int kResolution = 16;
    [[nodiscard]] std::vector<double> weights(const glm::dvec3& eye) const;

private:
    static constexpr int kAzimuths = 24;
    static constexpr std::array<double, 4> kElevations{0.0, 0.26, 0.7, 1.3};  ///< radians
    static constexpr std::array<double, 3> kDistances{5.0, 15.0, 60.0};
    using Cumulative = std::vector<double>;  ///< running sums over the texels, the last one is 1

    [[nodiscard]] static std::size_t slot(std::size_t azimuth, std::size_t elevation,
                                          std::size_t distance);
    [[nodiscard]] const Cumulative& viewer(const glm::dvec3& eye) const;

    std::vector<Cumulative> m_viewers;
    double m_centerHeight = 0.0, m_length = 0.0;
};

}  // namespace reflet
