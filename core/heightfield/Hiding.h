// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <vector>

namespace reflet {

/// What surely hides things behind it: the city as columns that are lower than anything solid in
/// and around them, so that a box found hidden is hidden in the city itself, too. For culling:
/// never says "hidden" of a box of which any point can be seen, but may miss that one is.
class Hiding {
public:
    /// Cells count as solid up to the lowest of what stands on the ground at the centres of the
    /// cell and its eight neighbours: walls, which fatten a heightfield by up to a cell, lose it
    /// here, and what is thinner than three cells hides nothing, nor does what hangs over a gap
    /// (bridges, crowns of trees).
    explicit Hiding(const Heightfield& field);

    /// Whether no straight line from the eye reaches a point of the box. An empty box is hidden.
    [[nodiscard]] bool hides(const glm::dvec3& eye, const Box& box) const;

private:
    struct Wedge {
        glm::dvec2 left{0.0}, right{0.0};  ///< edges, unit vectors in the plan
        double slope = 0.0;                ///< steepest line of sight to the box: rise / run
        double reach = 0.0;                ///< metres in the plan before which it must be hidden
    };
    struct Cells {
        int i0 = 0, j0 = 0, i1 = 0, j1 = 0;  ///< the last ones included
    };
    [[nodiscard]] bool blocked(const glm::dvec3& eye, const Wedge& wedge) const;
    [[nodiscard]] Cells touched(const glm::dvec2& min, const glm::dvec2& max) const;
    /// The lowest column of those that a rectangle of the plan touches; -infinity when it leaves
    /// the grid.
    [[nodiscard]] double lowest(const glm::dvec2& min, const glm::dvec2& max) const;
    [[nodiscard]] double highest(const glm::dvec2& min, const glm::dvec2& max) const;

    GridSpec m_grid;
    std::vector<float> m_solid;  ///< -infinity where nothing is sure
    double m_highest = 0.0;
};

}  // namespace reflet
