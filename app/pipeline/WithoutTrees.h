// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/DrivenCity.h"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace reflet {

/// The trees of a city: its objects of type SolitaryVegetation that have triangles.
struct TreeCount {
    std::size_t objects = 0, triangles = 0;
};
[[nodiscard]] TreeCount treesOf(const CityModel& city);

/// The city without the triangles of its trees. Objects, surfaces and vertices stay, and keep their
/// numbers. It has a content hash of its own.
[[nodiscard]] LoadedCity withoutTrees(const LoadedCity& city);

/// The same driven city without its trees, probes baked for it where the cache beside the project
/// file lacks them. nullopt: the city has no trees. Fails as openDriven() does.
[[nodiscard]] Result<std::optional<DrivenCity>> drivenWithoutTrees(
    const DrivenCity& driven, const std::filesystem::path& projectFile, const JobContext& job);

}  // namespace reflet
