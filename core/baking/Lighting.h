// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <vector>

namespace reflet {

/// The light on the city: a sun and an analytic sky. Radiance is scaled so that a white horizontal
/// surface in clear noon sun has a radiance near 1.
struct Lighting {
    glm::dvec3 sunDirection{0.3, -0.5, 0.8};  ///< unit, towards the sun, project frame
    float turbidity = 2.5F;                   ///< haze of the sky, 2 (clear) .. 10 (hazy)

    friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// An analytic clear sky (Preetham, Shirley, Smits 1999; Perez distribution) with a smooth fall to
/// dusk when the sun sets, evaluated with precomputed coefficients. Below the horizon: a plain
/// ground haze, continuous at the horizon. No sun disc: the sun is a light of its own.
class Sky {
public:
    explicit Sky(const Lighting& lighting);
    /// Linear Rec. 709 radiance from a direction (unit, project frame).
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;
    /// Irradiance / pi that the sun brings to a surface facing it, and its colour; zero at night.
    [[nodiscard]] glm::vec3 sunRadiance() const { return m_sunRadiance; }
    [[nodiscard]] const glm::vec3& sunDirection() const { return m_sunDirection; }
    /// Irradiance / pi of the unoccluded sky on a surface with this normal (precomputed, smooth).
    [[nodiscard]] glm::vec3 ambient(const glm::vec3& normal) const;

    /// How much artificial light is on: 0 by day, 1 when the sun is well below the horizon.
    [[nodiscard]] float night() const { return m_night; }

private:
    [[nodiscard]] glm::vec3 above(const glm::vec3& direction) const;
    void tabulateAmbient();

    glm::vec3 m_sunDirection;
    glm::vec3 m_sunRadiance{0.0F};
    glm::vec3 m_shapeDirection;  ///< the sun's direction lifted to the horizon, for the sky's shape
    glm::vec3 m_zenith;          ///< Yxy at the zenith, divided by the Perez function there
    float m_perez[3][5];         ///< Perez coefficients of Y, x, y
    float m_scale;               ///< from kcd/m² to scene radiance, with the fall to dusk
    float m_night = 0.0F;
    glm::vec3 m_ground{0.0F};             ///< radiance straight down
    std::vector<glm::vec3> m_irradiance;  ///< irradiance / pi by elevation and azimuth
};

}  // namespace reflet
