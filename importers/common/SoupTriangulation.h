// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/base/JobContext.h"
#include "importers/common/CityGeometry.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace reflet::importers {

/// The triangles of a soup, in the order of its surfaces.
struct SoupTriangles {
    struct Triangle {
        std::array<std::uint32_t, 3> vertex{};  ///< from `vertexCount` on: index into born
        std::uint32_t surface = 0;              ///< index into the soup's surfaces
    };
    enum class State : std::uint8_t { Good, Repaired, Degenerate, BadVertex, LeftOut };
    struct Problem {
        std::uint32_t surface = 0;
        std::string text;
    };
    std::uint32_t vertexCount = 0;
    std::vector<Triangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uv;  ///< one for each triangle if the soup has textures
    std::vector<glm::dvec3> born;              ///< points where edges of a polygon cross
    std::vector<State> states;                 ///< one for each surface
    std::vector<Problem> problems;             ///< of the surfaces without triangles
    double worstDeviation = 0.0;               ///< metres out of plane
    std::size_t notPlanar = 0;                 ///< surfaces more than 1 cm out of plane
    std::uint32_t worstSurface = 0;
};

/// Triangulates all surfaces but those of owners that are left out. Parallel and deterministic.
/// ResourceLimit when crossing edges would make many more points than the file has; Cancelled.
[[nodiscard]] Result<SoupTriangles> triangulateSoup(const SurfaceSoup& soup,
                                                    const std::vector<glm::dvec3>& vertices,
                                                    const std::vector<glm::vec2>& textureVertices,
                                                    const std::vector<bool>& leftOut,
                                                    const std::string& subject,
                                                    const JobContext& job);

}  // namespace reflet::importers
