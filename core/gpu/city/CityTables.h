// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/city/CityMesh.h"

namespace reflet {

/// The pass that shades a surface. textured: its image is there and its triangles have uv.
[[nodiscard]] ShadeKind shadeKind(const SurfaceLook& look, bool textured);

/// Fills mesh.surfaces, mesh.facades and mesh.walls from the looks; mesh.textures must be filled.
/// The record after the last surface's is that of triangles without a surface.
void fillSurfaceTables(const DrawnCity& city, const std::vector<ShadeKind>& kinds, CityMesh& mesh);

/// Scales a part of the city about its centre.
struct PartScale {
    glm::vec3 center{0.0F};
    float factor = 1.0F;
    /// Exactly the same place for factor 1.
    [[nodiscard]] glm::vec3 operator()(const glm::vec3& place) const {
        return factor == 1.0F ? place : center + factor * (place - center);
    }
};

/// Writes the records of a triangle, scaled, as the number-th of mesh.triangles: its plane, and in
/// mesh.mapping its texture mapping when it is textured (then the factor must be 1).
void writeTriangle(const CityModel& city, std::uint32_t triangle, ShadeKind kind,
                   const PartScale& scale, std::size_t number, CityMesh& mesh);

}  // namespace reflet
