// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/base/Diagnostic.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// A probe as somebody else has placed it.
struct ImportedProbe {
    std::string id;            ///< as in the file; may be empty, and twice in it
    glm::dvec3 position{0.0};  ///< absolute, in the frame's CRS; z = NaN where there is no height
    std::optional<int> resolution;
    std::string where;  ///< in the file, for people: "line 7"
};

/// Reads places of probes: a CSV (PlaceTable), the points of a GeoJSON, GeoPackage or another
/// vector file (VectorFile), or the `probes` of a Reflet project or of `suggest --json`. Of a file
/// with layers that has one named "probes", that one alone counts.
///
/// Brought into `frame`'s CRS, never by a ballpark transformation. What names no CRS is in the
/// frame's; GeoJSON as readLines() has it. Heights are taken to be in the frame's datum.
///
/// What is left out (rows without numbers, shapes that are no points) is told in `remarks`.
/// Unreadable for what is none of these, or holds no place; Refused for a CRS that cannot be
/// brought into the project's; ResourceLimit above 64 MB or 100 000 probes.
[[nodiscard]] Result<std::vector<ImportedProbe>> readProbes(const std::filesystem::path& path,
                                                            const ProjectFrame& frame,
                                                            std::vector<Diagnostic>& remarks);

struct ProbeImport {
    Project project;
    std::vector<std::string> added;   ///< ids in the project
    std::vector<Diagnostic> remarks;  ///< what became of others; new names; probes in solids
    std::size_t withoutHeight = 0;    ///< were put kProbeHeight above the ground
    std::size_t inSolids = 0;         ///< of the added ones: cannot be baked where they stand
};

/// The city's project with these probes added, locked unless they are `movable`: those without a
/// height kProbeHeight above the ground, ids kept where they are free. Those outside of the city,
/// and those that stand where a probe is already (to a centimetre), are left out and told; those in
/// solids are added, told with the nearest free place. Refused when all lie outside of the city.
[[nodiscard]] Result<ProbeImport> withProbes(const PreparedCity& city,
                                             const std::vector<ImportedProbe>& probes, bool movable,
                                             const JobContext& job);

/// Writes probes by the suffix of the path: .csv, .json (both read back by readProbes()), .geojson
/// or .gpkg (a layer "probes"). Usage for another suffix.
[[nodiscard]] Result<void> writeProbes(const std::vector<Probe>& probes, const ProjectFrame& frame,
                                       const std::filesystem::path& path);

}  // namespace reflet
