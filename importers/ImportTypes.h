// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/city/CityModel.h"
#include "core/city/ReadingOptions.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// What is asked of an importer.
struct ImportOptions : ReadingOptions {
    /// The frame to import into; nullopt = made from the file.
    std::optional<ProjectFrame> frame;
    /// CRS of a frame that is made; "" = the file's own, or its UTM zone when that is not in
    /// metres.
    std::string projectCrs;
    bool strict = false;  ///< refuse what would otherwise be repaired or guessed
    std::size_t maxFileBytes = std::size_t(4) << 30;
};

/// The size of a raster file.
struct RasterSize {
    int columns = 0, rows = 0, bands = 0;
};

/// Code of the remark that coordinates lie where their CRS is used only with east and north
/// exchanged.
inline constexpr const char* kAxesExchanged = "axes-exchanged";

/// How the CRS of a file was found.
enum class CrsRule {
    Declared,  ///< the file says it
    Format,    ///< its format is in this one
    Given,     ///< the file says nothing, the user does (--crs)
    Replaced,  ///< the file says something that cannot be used, the user says what to take
    Assumed,   ///< nobody says anything: local metres, or the project's own
};
[[nodiscard]] const char* toString(CrsRule rule);

struct CrsAccount {
    CrsRule rule = CrsRule::Assumed;
    std::optional<std::string> written;  ///< as the file has it
    std::string operation;               ///< PROJ's name of it; empty = no transformation
    std::optional<double> accuracy;      ///< metres; nullopt = unknown. Ballpark ones are refused.
};

/// How a city object fared that something was said about.
enum class ObjectResult { Loaded, Repaired, Skipped };
[[nodiscard]] const char* toString(ObjectResult result);

struct ObjectAccount {
    std::string id, type, lod;  ///< type as written; the level that was loaded, or empty
    ObjectResult result = ObjectResult::Loaded;
    std::size_t firstRemark = 0, remarks = 0;  ///< in Imported::diagnostics, one behind the other
};

/// What `info` and `import` tell about a file; keys of the JSON reports in DESIGN section 7.
struct SourceSummary {
    std::string format;  ///< "CityJSON"
    std::string version;
    std::optional<std::string> crsHorizontal;  ///< "EPSG:n"
    std::optional<std::string> crsVertical;
    std::size_t objects = 0;
    std::map<std::string, std::size_t> byType;
    std::vector<std::string> lods;  ///< ascending
    std::size_t surfaces = 0;       ///< polygons with their holes, without template instances
    /// Without template instances; by the formula that needs no triangulation: over all surfaces,
    /// points + 2 * holes - 2, every point counted as it is written. CityModel::triangles holds the
    /// real ones: fewer where points are repeated or lie on a line, others where edges cross.
    std::size_t triangles = 0;
    std::size_t instanceTriangles = 0;  ///< of all instances, by the same formula
    std::size_t instances = 0;
    std::size_t vertices = 0;  ///< of the file; after an import: those that were used
    Box bounds;                ///< of the surfaces' vertices, in the source CRS: east, north, up
    std::size_t texturesReferenced = 0;
    std::size_t texturesResolved = 0;
    std::vector<RasterSize> raster;  ///< of each raster file; empty for city models
    CrsAccount crsAccount = {};
    std::vector<std::string> texturesMissing = {};  ///< as written, each once
    std::vector<ObjectAccount> remarked = {};       ///< objects with remarks, in their order
};

struct CityImport {
    CityModel city;
    SourceSummary summary;  ///< of what was loaded
    /// Objects whose heights count from the ground, which their file does not know: indices. Made
    /// for drapeOnTerrain(), which needs the terrain of all files.
    std::vector<std::uint32_t> aboveGround;
};

}  // namespace reflet
