// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "core/samples/kit/Palette.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace reflet::kit {

/// What a polygon is made of and what it is.
struct Skin {
    Paint paint = Paint::None;
    SurfaceType surface = SurfaceType::Unknown;
};

struct MeshFace {
    std::uint32_t first = 0;  ///< index into Mesh::points()
    std::uint32_t count = 0;
    Skin skin;
};

/// Simple polygons without holes, their points snapped to the millimetres of the file that they
/// are written to: what is planar and distinct here is so there. Metres outside, millimetres
/// inside.
class Mesh {
public:
    /// Counter-clockwise seen from outside. Points that fall together on the millimetre grid are
    /// merged, and a polygon that vanishes by that is left out.
    void polygon(std::span<const glm::dvec3> ring, Skin skin);
    void polygon(std::initializer_list<glm::dvec3> ring, Skin skin) {
        polygon(std::span<const glm::dvec3>(ring.begin(), ring.size()), skin);
    }
    [[nodiscard]] const std::vector<glm::ivec3>& points() const { return m_points; }
    [[nodiscard]] const std::vector<MeshFace>& faces() const { return m_faces; }
    /// Of any triangulation without extra points: a polygon of n points gives n - 2.
    [[nodiscard]] std::size_t triangleCount() const { return m_triangles; }

private:
    std::vector<glm::ivec3> m_points;
    std::vector<MeshFace> m_faces;
    std::size_t m_triangles = 0;
};

}  // namespace reflet::kit
