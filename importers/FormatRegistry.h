// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// The beginning of a file, by which its format is told.
struct FileHead {
    static constexpr std::size_t kSize = std::size_t(64) << 10;
    std::string name;   ///< file name in lower case, without ".gz"
    std::string bytes;  ///< the first kSize bytes, unpacked
    /// The same as UTF-8 without byte order mark and leading white space: UTF-16 is decoded, other
    /// bytes are left as they are.
    std::string text;
};

/// A format of city models. To add one: an entry in the table of FormatRegistry.cpp.
struct CityFormat {
    std::string_view name;                   ///< for people: "CityJSON"
    std::vector<std::string_view> suffixes;  ///< ".city.json": lower-case
    /// Whether the content is of this format; the first that says yes reads the file. The name may
    /// help where the beginning of a sound file can leave the question open.
    bool (*recognises)(const FileHead& head);
    /// As importCityJson() and inspectCityJson().
    Result<Imported<CityImport>> (*read)(const std::filesystem::path& path,
                                         const ImportOptions& options, const JobContext& job);
    Result<Imported<SourceSummary>> (*inspect)(const std::filesystem::path& path,
                                               const ImportOptions& options, const JobContext& job);
};

/// All formats, in the order in which they are asked.
[[nodiscard]] std::span<const CityFormat> cityFormats();

/// The format of a file: by its content, else, for what may be a damaged file, by its suffix.
/// Unreadable when the file cannot be read, and for what Reflet does not know: a format that is
/// known by name (IFC, FBX, SketchUp, DWG, ...) is named with the way out of it.
[[nodiscard]] Result<const CityFormat*> cityFormatOf(const std::filesystem::path& path);

/// Suffixes of all formats, without the dot, for filters: "json" stands for ".city.json" too.
[[nodiscard]] std::vector<std::string> citySuffixes();
/// Whether the name ends like that of a city model.
[[nodiscard]] bool hasCitySuffix(std::string_view fileName);

/// What a file is among others in a folder. A city's folder also holds files of the same suffixes
/// that are something else: metadata, code lists, pictures of walls, tiles of a tileset.
enum class PlaceInFolder { City, Raster, Tileset, Other };
/// By suffix and content. What has the suffix of city models alone may be damaged: it counts.
[[nodiscard]] PlaceInFolder placeInFolder(const std::filesystem::path& path);

}  // namespace reflet
