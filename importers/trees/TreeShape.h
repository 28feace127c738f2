// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/CityBuilder.h"
#include "importers/extrusion/Building.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet::trees {

/// A tree as a register tells of it. Metres.
struct Tree {
    importers::ObjectOutline outline;   ///< its geometry is filled in by pieceOf()
    std::optional<glm::dvec2> place;    ///< of the trunk, in the source CRS: east, north
    std::optional<double> height;       ///< from the ground to the top
    std::optional<double> crown;        ///< diameter
    std::optional<double> trunkRadius;  ///< at breast height
    bool needles = false;               ///< a conifer
    std::vector<std::pair<importers::Issue, std::string>> notes;
};

/// Metres of a tree of unknown height.
inline constexpr double kUnknownHeight = 10.0;

/// What a tree looks like when all that is missing was filled in.
struct TreeSize {
    double height = 0.0;
    double crown = 0.0;      ///< diameter
    double crownBase = 0.0;  ///< height of the lowest leaves
    double trunkRadius = 0.0;
};
/// A tree of unknown height is 1.6 times as high as its crown is wide, else of the default; a crown
/// of unknown width is 0.6 times as wide as the tree is high, that of a conifer 0.4 times. Leaves
/// begin at a third of the height, needles at a tenth. A trunk of unknown girth is a fortieth of
/// the height thick; none has a radius below 4 cm or above 1 m.
[[nodiscard]] TreeSize sizeOf(const Tree& tree, double defaultHeight);

/// Makes the trees SolitaryVegetationObjects of LoD 2 that stand on the ground: a trunk, and a
/// crown over it, an ellipsoid or, of needles, a cone; both closed, facing outward.
[[nodiscard]] importers::CityPiece pieceOf(importers::CityBuilder& builder, std::vector<Tree> trees,
                                           double defaultHeight,
                                           const extrusion::MetricScale& metres);

}  // namespace reflet::trees
