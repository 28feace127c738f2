// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// Version of the document that importReportText() writes; keys are only ever added to one.
inline constexpr int kImportReportVersion = 1;

/// {severity, code, object, text, remedy}.
[[nodiscard]] nlohmann::json remarkJson(const Diagnostic& remark);
/// What came of a file, by the keys that `info` and `import` print. A remark on an object tells its
/// type, level of detail and result too.
[[nodiscard]] nlohmann::json fileReportJson(const FileReport& report);
/// {median, buildings}, or null.
[[nodiscard]] nlohmann::json groundFitJson(const std::optional<GroundFit>& fit);

/// An import as a whole: what the window's report and `import --report` write.
struct ImportAccount {
    std::string project;  ///< its file or name
    ProjectFrame frame;
    bool generatedGround = false;
    std::optional<GroundFit> groundFit;
    std::vector<Diagnostic> remarks;  ///< on the city as a whole
    std::span<const FileReport> files;
    std::span<const CityObject> objects;  ///< that FileReport::firstObject counts in
};
/// The versioned document: `files[]` as fileReportJson() with `accounts[]`, one for each object,
/// {id, type, lod, result, remarks[]}: those that were loaded, in the order of the city, then those
/// that were skipped.
[[nodiscard]] std::string importReportText(const ImportAccount& account);

}  // namespace reflet
