// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/Samples.h"
#include "core/samples/kit/SampleCity.h"

#include <cstdint>

/// The test scene of Meyer and Loscos 2003, section 7: 1 km², 8 roads, buildings of 25,600
/// triangles in all, 8 trees of 59,100 triangles each, 54 REMs at 128², cells of 0.5 m. The paper
/// gives these figures and not the plan; the plan here is ours.
namespace reflet::paper {

inline constexpr std::size_t kBuildings = 256;
inline constexpr std::size_t kTrianglesPerBuilding = 100;  ///< 256 x 100 = 25,600
inline constexpr std::size_t kTrees = 8;
inline constexpr std::size_t kTrianglesPerTree = 59'100;
inline constexpr std::size_t kProbes = 54;

[[nodiscard]] kit::SampleCity makeCity(std::uint64_t seed);
[[nodiscard]] Project makeProject(const std::string& modelFileName);
[[nodiscard]] Sample makePaper(std::uint64_t seed);

}  // namespace reflet::paper
