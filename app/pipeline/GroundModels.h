// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"
#include "core/base/ContentHash.h"

#include <optional>

namespace reflet {

/// The models of a project that are rasters, read after the city models because they belong under
/// them: first the heights, whose files become one ground where their grids fit, then the pictures
/// that are laid on it. Models of other uses are passed over.

/// Reads terrain into the city, in its frame; where `options.frame` is not set (no city model came
/// before) the first terrain makes the frame. `options` holds what is the same for all.
[[nodiscard]] Result<void> readTerrain(const std::vector<ModelReference>& models,
                                       const std::filesystem::path& folder,
                                       const ImportOptions& options, LoadedCity& loaded,
                                       const JobContext& job);

/// Lays orthophotos on the ground that is there.
[[nodiscard]] Result<void> layOrthophotos(const std::vector<ModelReference>& models,
                                          const std::filesystem::path& folder, LoadedCity& loaded,
                                          const JobContext& job);

/// Adds what the rasters depend on: their bytes, how they are read and placed.
[[nodiscard]] Result<void> addGroundModels(ContentHash& hash,
                                           const std::vector<ModelReference>& models,
                                           const std::filesystem::path& folder,
                                           std::vector<Diagnostic>& remarks);

/// What a file is good for, by its content.
[[nodiscard]] ModelUse useOf(const std::filesystem::path& path);

/// nullopt when fewer than three buildings stand over terrain, or none of it was given.
[[nodiscard]] std::optional<GroundFit> groundFit(const CityModel& city);
/// What to say of it: nullopt when they fit. Between 20 and 60 m one of both has heights above the
/// ellipsoid, the other above the sea.
[[nodiscard]] std::optional<Diagnostic> groundFitRemark(const GroundFit& fit);
/// Finds out how the buildings stand on the terrain, and remarks on it.
void judgeGroundFit(LoadedCity& loaded);

}  // namespace reflet
