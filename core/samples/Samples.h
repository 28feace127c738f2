// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/project/Project.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A built-in city as it is written to a folder: a CityJSON 2.0 file that goes through the importer
/// like anybody's, and the project that refers to it.
struct Sample {
    std::string modelFileName;  ///< e.g. "square.city.json"
    std::string modelJson;
    Project project;  ///< models[0].path = modelFileName
};

/// "square", "paper" and "whale".
[[nodiscard]] std::vector<std::string> sampleNames();
/// Deterministic: the same name and seed give the same bytes. Usage for an unknown name.
[[nodiscard]] Result<Sample> makeSample(std::string_view name, std::uint64_t seed);

}  // namespace reflet
