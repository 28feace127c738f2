// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/io/VectorFile.h"
#include "importers/common/CityBuilder.h"

#include <cstddef>
#include <filesystem>

namespace reflet::trees {

/// Whether a vector file is a register of trees, as far as its form tells: points or tables, and
/// nothing that may have areas.
[[nodiscard]] bool looksLikeRegister(const VectorFile& file);

/// Reads a register of trees: each point becomes one SolitaryVegetationObject with a trunk and a
/// crown (TreeShape.h) that stands on the ground (CityImport::aboveGround). Its height, its crown
/// and its kind are attributes (TreeFields.h); what is missing is filled in, with a warning. Tables
/// (CSV) have coordinates in their columns. Each tree is accounted for as loaded or skipped.
[[nodiscard]] Result<Imported<CityImport>> importRegister(importers::Purpose purpose,
                                                          VectorFile& file, std::size_t bytes,
                                                          const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);

}  // namespace reflet::trees
