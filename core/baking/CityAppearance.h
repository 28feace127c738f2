// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/Facade.h"
#include "core/baking/MipTexture.h"
#include "core/baking/SurfaceLook.h"

#include <memory>
#include <vector>

namespace reflet {

/// Colours of a city's surfaces: textures, materials and procedural looks, by the rule that
/// SurfaceLook states. View-independent but for the footprint.
class CityAppearance {
public:
    /// `city` must outlive this. looks: of the city. textures: one per CityModel::textures. night:
    /// 0 by day, 1 when windows are lit.
    CityAppearance(const CityModel& city, std::shared_ptr<const SurfaceLooks> looks,
                   std::shared_ptr<const std::vector<MipTexture>> textures, float night);

    /// At a point of a triangle; normal: the triangle's, unit, either way.
    [[nodiscard]] Appearance at(std::uint32_t triangle, const glm::vec3& point,
                                const glm::vec3& normal, const glm::vec2& barycentric,
                                const Footprint& footprint) const;
    /// The mean colour around a triangle, for the light that it throws on others.
    [[nodiscard]] glm::vec3 mean(std::uint32_t triangle) const;
    [[nodiscard]] const SurfaceLooks& looks() const { return *m_looks; }

private:
    [[nodiscard]] Appearance untextured(std::uint32_t surface, const glm::vec3& point,
                                        const glm::vec3& normal, const Footprint& footprint) const;
    [[nodiscard]] const MipTexture* textureOf(std::uint32_t surface) const;
    [[nodiscard]] glm::vec4 texel(const MipTexture& texture, std::uint32_t triangle,
                                  const glm::vec3& normal, const glm::vec2& barycentric,
                                  const Footprint& footprint) const;

    const CityModel& m_city;
    std::shared_ptr<const SurfaceLooks> m_looks;
    std::shared_ptr<const std::vector<MipTexture>> m_textures;
    float m_night;
};

}  // namespace reflet
