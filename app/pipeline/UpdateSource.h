// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/CityChanges.h"
#include "app/pipeline/PreparedCity.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// A probe whose picture changes.
struct AffectedProbe {
    enum class Why {
        Sees,  ///< its map shows a place that a changed object takes or has left
        Lit,   ///< it does not, but light or shadow on what it shows may come from there
        Near,  ///< it has no map yet, and stands less than kNearChange from one
    };
    std::string id;
    Why why = Why::Sees;
    std::string object;  ///< the nearest of the changes that are seen, or of all
};
inline constexpr double kNearChange = 150.0;  ///< metres in the plan

/// A new delivery of a city model, compared with the one that the project has.
struct SourceUpdate {
    Project project;        ///< with the new delivery in place of the old one, and all else kept
    std::string model;      ///< the path that the project had
    std::string file;       ///< the path that it has now
    bool sameFile = false;  ///< byte by byte: the project is as it was
    CityChanges changes;
    bool attributesCompared = false;  ///< of CityJSON and its text sequences alone
    std::vector<AffectedProbe> probes;
    std::vector<Diagnostic> diagnostics;  ///< of reading the new delivery
};

/// Reads `file` as the project's model is read (its options, CRS and placement) and tells what
/// differs. `model`: its path in the project, or the name of its file; "" where there is but one.
/// Nothing is written. `before`: the city as it is.
///
/// Usage for an unknown model; Refused for a model without objects (terrain, orthophoto), for a
/// file that is in another CRS or has no object in common with the old one: that is another city;
/// and for a file that was written over the old one, which cannot be compared any more.
[[nodiscard]] Result<SourceUpdate> updateSource(const PreparedCity& before,
                                                const std::string& model,
                                                const std::filesystem::path& file,
                                                const JobContext& job);

/// Which probes are to be baked again: by their maps and sights where the cache holds them, else by
/// their distance.
[[nodiscard]] std::vector<AffectedProbe> affectedProbes(const PreparedCity& before,
                                                        const std::vector<ObjectChange>& changes,
                                                        const JobContext& job);

/// {model, file, sameFile, attributesCompared, added[], removed[], changed[], unchanged, probes[]}.
[[nodiscard]] nlohmann::json updateJson(const SourceUpdate& update);

}  // namespace reflet
