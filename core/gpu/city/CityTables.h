// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/city/CityMesh.h"

namespace reflet {

/// The pass that shades a surface. textured: its image is there and its triangles have uv.
[[nodiscard]] ShadeKind shadeKind(const SurfaceLook& look, bool textured);

/// Fills mesh.surfaces, mesh.facades and mesh.walls from the looks; mesh.textures must be filled.
/// The record after the last surface's is that of triangles without a surface.
void fillSurfaceTables(const DrawnCity& city, const std::vector<ShadeKind>& kinds, CityMesh& mesh);

/// Adds a triangle's records: its plane, and its texture mapping when it is textured.
void addTriangle(const CityModel& city, std::uint32_t triangle, ShadeKind kind, CityMesh& mesh);

}  // namespace reflet
