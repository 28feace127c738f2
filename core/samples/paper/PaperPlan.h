// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Random.h"
#include "core/samples/kit/SampleCity.h"
#include "core/samples/kit/Shapes.h"

#include <array>

namespace reflet::paper {

/// A square kilometre about the origin; four roads run north, four east, 200 m apart.
inline constexpr double kHalf = 500.0;
inline constexpr std::array<double, 4> kRoads{-300.0, -100.0, 100.0, 300.0};
inline constexpr double kRoadHalf = 7.0;  ///< half a carriageway
inline constexpr double kPavementWidth = 4.5;
inline constexpr double kPavementHeight = 0.15;
inline constexpr double kLane = 2.2;  ///< from a road's axis to where cars drive

/// Between the roads: 5 x 5 blocks without their pavements, number = row * 5 + column.
[[nodiscard]] kit::Plot blockPlot(int row, int column);
/// The blocks that hold a green with trees in place of some of their buildings.
inline constexpr std::array<int, 4> kGreenBlocks{11, 12, 13, 17};

void addGround(kit::SampleCity& city);
void addBuildings(kit::SampleCity& city, kit::Random random);
void addTrees(kit::SampleCity& city, kit::Random random);

}  // namespace reflet::paper
