// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/city/TexturePages.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace reflet {

/// How a surface is shaded: each kind has a full-screen pass of its own and this value in the
/// stencil buffer. 0 is the sky. The same numbers stand in city_shade.frag.glsl.
enum class ShadeKind : std::uint8_t { Sky, Plain, Ground, Joints, Facade, Textured };
inline constexpr int kShadeKinds = 6;

/// Position and the number of the triangle whose last vertex this is (GL's provoking vertex).
struct CityVertex {
    glm::vec3 position{0.0F};
    std::uint32_t triangle = 0;
};

/// Triangles of one kind that lie together, those of large parts first. Leaves are there several
/// times: all of them, and thinned n times: one in 4^n, 2^n times as large, so that a tree far away
/// keeps its density with less of them (Cook et al. 2007, stochastic simplification).
struct CityChunk {
    Box bounds;
    ShadeKind kind = ShadeKind::Plain;
    bool leaves = false;
    int thinned = 0;  ///< n; 0 to kThinnings, 0 for what is no leaf
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

inline constexpr int kThinnings = 3;

/// One texel of a table that shaders read: bits of floats or integers.
using TableTexel = glm::uvec4;

/// The city's geometry and looks as tables for the GPU. Triangles are numbered in the order of the
/// index buffer: by kind, then thinning, chunk and size.
struct CityMesh {
    std::vector<CityVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<CityChunk> chunks;
    /// Per triangle: how large the connected part is that it belongs to, metres; falling in a
    /// chunk. The square root of the product of the two largest edges of the part's box.
    std::vector<float> partSize;
    std::vector<TableTexel> triangles;  ///< two texels each: (normal, surface), (a corner, 0)
    std::vector<TableTexel> surfaces;   ///< kSurfaceTexels each
    std::vector<TableTexel> facades;    ///< kFacadeTexels each
    std::vector<TableTexel> walls;      ///< triangles of gables: (u, z) of three corners, two each
    /// Two each, from the first textured triangle: (gradient of u, u at the corner), the same of v.
    std::vector<TableTexel> mapping;
    std::uint32_t firstTextured = 0;
    TexturePages textures;
    Box bounds;
};

inline constexpr int kSurfaceTexels = 5;
inline constexpr int kFacadeTexels = 12;

/// How many triangles of a chunk belong to parts of at least this size, metres.
[[nodiscard]] std::uint32_t trianglesOfSize(const CityMesh& mesh, const CityChunk& chunk,
                                            float size);

}  // namespace reflet
