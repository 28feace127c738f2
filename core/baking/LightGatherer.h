// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/CityAppearance.h"
#include "core/baking/RayScene.h"

#include <array>
#include <vector>

namespace reflet {

/// Ambient light at one point, gathered with rays: the sky where it is seen, and one bounce of sun
/// and sky where something stands in the way. A function of point and normal alone, free of noise:
/// the directions are fixed in the normal's frame, and occlusion fades out between 12 and 25 m.
class LightGatherer {
public:
    /// All must outlive this.
    LightGatherer(const CityModel& city, const RayScene& scene, const CityAppearance& appearance,
                  const Sky& sky);

    /// How many directions: Fine for large surfaces, Medium for small ones and where each result is
    /// used once, Coarse for leaves and ornaments.
    enum class Effort { Coarse, Medium, Fine };

    struct Light {
        glm::vec3 irradiance{0.0F};  ///< divided by pi
        float nearest = kInfinity;   ///< metres to the nearest thing that a ray met
    };
    /// normal: unit, on the side from which the light is wanted.
    [[nodiscard]] Light gather(const glm::vec3& point, const glm::vec3& normal,
                               Effort effort) const;
    /// Irradiance / pi towards +x −x +y −y +z −z at a point in the air.
    [[nodiscard]] std::array<glm::vec3, 6> gatherCube(const glm::vec3& point) const;
    /// Metres that rays start above their surface.
    [[nodiscard]] static float lift();
    /// Metres beyond which nothing hides or throws light.
    [[nodiscard]] static float reach();

private:
    struct Rays;
    [[nodiscard]] glm::vec3 skyLight(const glm::vec3& direction) const;
    void lightEnds(Rays& rays) const;

    const CityModel& m_city;
    const RayScene& m_scene;
    const CityAppearance& m_appearance;
    const Sky& m_sky;
    std::vector<glm::vec3> m_skyTable;  ///< radiance by azimuth and z
};

/// Two unit vectors that make a right-handed frame with n; continuous for all normals near up.
struct NormalFrame {
    glm::vec3 tangent;
    glm::vec3 bitangent;
};
[[nodiscard]] NormalFrame frameAround(const glm::vec3& n);

}  // namespace reflet
