// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/io/PlanPolygon.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace reflet::extrusion {

/// Coordinates along a ridge (u) and across it (v), the ridge at v = 0.
struct RidgeFrame {
    glm::dvec2 origin{0.0};
    glm::dvec2 along{1.0, 0.0};  ///< unit; across is its left
    double half = 0.0;           ///< metres: the polygon lies within |v| <= half

    [[nodiscard]] double across(const glm::dvec2& p) const {
        return glm::dot(p - origin, glm::dvec2(-along.y, along.x));
    }
    [[nodiscard]] double alongOf(const glm::dvec2& p) const { return glm::dot(p - origin, along); }
};

/// In the middle of the smallest rectangle around a polygon that is parallel to one of its edges,
/// along its longer side, or across it.
[[nodiscard]] RidgeFrame ridgeFrame(const PlanPolygon& polygon, bool acrossTheLonger);

/// The polygon cut by the line v = 0. Points are those of its rings, and those where edges
/// were cut; the line is moved by centimetres where it would run through a corner.
struct RidgeSplit {
    std::vector<glm::dvec2> points;
    std::vector<bool> onRidge;                      ///< of each point
    std::vector<std::vector<std::uint32_t>> rings;  ///< of the polygon, cuts included
    /// Polygons left of the line (v > 0) and right of it, as rings: outer, then holes.
    std::vector<std::vector<std::vector<std::uint32_t>>> left, right;
};
/// nullopt when the line cannot be placed clear of all corners.
[[nodiscard]] std::optional<RidgeSplit> splitAlong(const PlanPolygon& polygon, RidgeFrame& frame);

}  // namespace reflet::extrusion
