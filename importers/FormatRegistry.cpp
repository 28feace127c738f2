// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/FormatRegistry.h"

#include "importers/ForeignFormats.h"
#include "importers/archive/ArchiveImporter.h"
#include "importers/citygml/CityGmlImporter.h"
#include "importers/cityjson/CityJsonImporter.h"
#include "importers/cityjsonseq/CityJsonSeqImporter.h"
#include "importers/common/ByteSource.h"
#include "importers/footprints/FootprintImporter.h"
#include "importers/obj/ObjFile.h"
#include "importers/obj/ObjImporter.h"
#include "importers/osm/OsmImporter.h"
#include "importers/osm/OsmReader.h"
#include "importers/terrain/TerrainImporter.h"
#include "importers/tiles/TilesImporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

namespace reflet {

namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// In lower case, without the suffix of a packed file.
std::string plainName(std::string name) {
    name = lowerCase(std::move(name));
    if (name.ends_with(".gz"))
        name.resize(name.size() - 3);
    return name;
}

// ---- the formats ----

/// Keys come in any order, and a file may be damaged: what looks like a JSON object and is nothing
/// else that is known is read as CityJSON, whose reader says what is missing.
bool looksLikeCityJson(const FileHead& head) {
    return head.text.starts_with('{');
}

/// A first line that is an object of CityJSON by itself, and another object behind it. A first line
/// may be longer than what is seen here: then the name has to tell.
bool looksLikeCityJsonSeq(const FileHead& head) {
    if (!looksLikeCityJson(head))
        return false;
    const std::string_view text = head.text;
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos)
        return head.name.ends_with(".jsonl") || head.name.ends_with(".ndjson");
    const std::size_t next = text.find_first_not_of(" \t\r\n\x1e", end);
    return text.substr(0, end).find("\"CityJSON") != std::string_view::npos &&
           next != std::string_view::npos && text[next] == '{';
}

/// Its root names one of CityGML's namespaces; the tag may be long, but not that long.
bool looksLikeCityGml(const FileHead& head) {
    return head.text.starts_with('<') &&
           head.text.find("http://www.opengis.net/citygml") != std::string::npos;
}

/// Formats of rasters that begin in a way of their own; the others are told by their suffix.
bool looksLikeRaster(const FileHead& head) {
    using namespace std::string_view_literals;
    const auto starts = [&](std::string_view magic) { return head.bytes.starts_with(magic); };
    return starts("II*\0"sv) || starts("II+\0"sv) || starts("MM\0*"sv) || starts("MM\0+"sv) ||
           head.text.starts_with("<VRTDataset") || lowerCase(head.text.substr(0, 5)) == "ncols" ||
           starts("EHFA_HEADER_TAG");
}

bool says(std::string_view text, std::string_view word) {
    return text.find(word) != std::string_view::npos;
}

bool looksLikeGeoJson(const FileHead& head) {
    if (!head.text.starts_with('{') || says(head.text, "\"CityJSON"))
        return false;
    return head.name.ends_with(".geojson") || says(head.text, "\"FeatureCollection\"") ||
           (says(head.text, "\"Feature\"") && says(head.text, "\"geometry\""));
}

bool looksLikeGeoPackage(const FileHead& head) {
    constexpr std::size_t kApplication = 68;  // where SQLite keeps the id of its application
    return head.bytes.starts_with("SQLite format 3") &&
           (head.name.ends_with(".gpkg") ||
            (head.bytes.size() > kApplication && says(head.bytes.substr(kApplication, 4), "GP")));
}

bool looksLikeShapefile(const FileHead& head) {
    return head.bytes.starts_with(std::string_view("\0\0\x27\x0a", 4));
}

bool looksLikeFlatGeobuf(const FileHead& head) {
    return head.bytes.starts_with("fgb\x03");
}

/// Text in columns has no sign of its own but its name.
bool looksLikeCsv(const FileHead& head) {
    return (head.name.ends_with(".csv") || head.name.ends_with(".tsv")) && !head.text.empty() &&
           head.text.find('\0') == std::string::npos;
}

bool looksLikeOsm(const FileHead& head) {
    return osm::looksLikeOsmXml(std::string_view(head.text).substr(0, 1024)) ||
           osm::looksLikeOsmPbf(head.bytes);
}

/// A ZIP archive by its first file, or by its end where it is empty. Formats that are ZIP archives
/// of their own kind are known by their suffix.
bool looksLikeZip(const FileHead& head) {
    return (head.bytes.starts_with("PK\x03\x04") || head.bytes.starts_with("PK\x05\x06")) &&
           foreignFormatByName(head.name) == nullptr;
}

/// Members of a tileset.json, which other JSON does not have together.
bool looksLikeTileset(const FileHead& head) {
    return head.text.starts_with('{') && says(head.text, "\"asset\"") &&
           says(head.text, "\"geometricError\"") && says(head.text, "\"root\"");
}

/// Binary glTF, or that of 3D Tiles 1.0 around one; a .gltf by its name.
bool looksLikeGltf(const FileHead& head) {
    const std::string_view magic = std::string_view(head.bytes).substr(0, 4);
    return magic == "glTF" || magic == "b3dm" || magic == "i3dm" || magic == "cmpt" ||
           (head.name.ends_with(".gltf") && head.text.starts_with('{'));
}

bool looksLikeObj(const FileHead& head) {
    return obj::looksLikeObjText(head.text, head.name.ends_with(".obj"));
}

constexpr std::string_view kRasters = "GeoTIFF and other rasters";

const std::vector<CityFormat>& table() {
    static const std::vector<CityFormat> formats{
        {"CityGML", {".gml", ".citygml", ".xml"}, looksLikeCityGml, importCityGml, inspectCityGml},
        {"CityJSONSeq",
         {".city.jsonl", ".jsonl", ".ndjson"},
         looksLikeCityJsonSeq,
         importCityJsonSeq,
         inspectCityJsonSeq},
        {"GeoJSON", {".geojson"}, looksLikeGeoJson, importFootprints, inspectFootprints},
        {"GeoPackage", {".gpkg"}, looksLikeGeoPackage, importFootprints, inspectFootprints},
        {"Shapefile", {".shp"}, looksLikeShapefile, importFootprints, inspectFootprints},
        {"FlatGeobuf", {".fgb"}, looksLikeFlatGeobuf, importFootprints, inspectFootprints},
        {"CSV", {".csv", ".tsv"}, looksLikeCsv, importFootprints, inspectFootprints},
        {"OpenStreetMap", {".osm", ".pbf"}, looksLikeOsm, importOsm, inspectOsm},
        {"3D Tiles", {"tileset.json"}, looksLikeTileset, importTiles, inspectTiles},
        {"glTF",
         {".glb", ".gltf", ".b3dm", ".i3dm", ".cmpt"},
         looksLikeGltf,
         importGltfCity,
         inspectGltfCity},
        {"OBJ", {".obj"}, looksLikeObj, importObj, inspectObj},
        {"CityJSON", {".city.json", ".json"}, looksLikeCityJson, importCityJson, inspectCityJson},
        {"ZIP archive", {".zip"}, looksLikeZip, importArchive, inspectArchive},
        {kRasters,
         {".tif", ".tiff", ".asc", ".xyz", ".vrt", ".hgt", ".dem", ".dt2", ".img", ".bil", ".jp2"},
         looksLikeRaster,
         importRaster,
         inspectRaster},
    };
    return formats;
}

// ---- the beginning of a file ----

void appendUtf8(std::string& text, std::uint32_t code) {
    const auto put = [&](std::uint32_t bits, std::uint32_t lead) {
        text += static_cast<char>(bits | lead);
    };
    if (code < 0x80) {
        put(code, 0);
    } else if (code < 0x800) {
        put(code >> 6, 0xc0);
        put(code & 0x3f, 0x80);
    } else {
        put(code >> 12, 0xe0);
        put((code >> 6) & 0x3f, 0x80);
        put(code & 0x3f, 0x80);
    }
}

/// Surrogates are decoded one by one: for telling formats apart, only ASCII matters.
std::string fromUtf16(std::string_view bytes, bool bigEndian) {
    std::string text;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        appendUtf8(text, bigEndian ? first * 256U + second : second * 256U + first);
    }
    return text;
}

std::string textOf(std::string_view bytes) {
    std::string text;
    const auto mark = [&](std::string_view start) { return bytes.starts_with(start); };
    if (mark("\xef\xbb\xbf"))
        text = bytes.substr(3);
    else if (mark("\xff\xfe") || mark(std::string_view("<\0", 2)))
        text = fromUtf16(bytes.substr(mark("<") ? 0 : 2), false);
    else if (mark("\xfe\xff") || mark(std::string_view("\0<", 2)))
        text = fromUtf16(bytes.substr(mark("\xfe") ? 2 : 0), true);
    else
        text = bytes;
    text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

Result<FileHead> readHead(const std::filesystem::path& path) {
    constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
    const auto file = importers::openFile(path, kNoLimit);
    if (!file)
        return tl::unexpected(file.error());
    std::string bytes(FileHead::kSize, '\0');
    const auto count = (*file)->read(bytes);
    if (!count)
        return tl::unexpected(count.error());
    bytes.resize(*count);
    std::string text = textOf(bytes);
    return FileHead{plainName(path.filename().string()), std::move(bytes), std::move(text)};
}

bool endsLike(const CityFormat& format, std::string_view lowerCaseName) {
    return std::any_of(format.suffixes.begin(), format.suffixes.end(),
                       [&](std::string_view suffix) { return lowerCaseName.ends_with(suffix); });
}

tl::unexpected<Error> foreign(const ForeignFormat& format, const std::filesystem::path& path) {
    return fail(ErrorCode::Unreadable,
                fmt::format("is a file of the format {}, which Reflet does not read", format.name),
                path.string(), std::string(format.remedy));
}

std::string knownNames() {
    std::string names;
    for (const CityFormat& format : cityFormats())
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", format.name,
                             fmt::join(format.suffixes, ", "));
    return names;
}

}  // namespace

std::span<const CityFormat> cityFormats() {
    return table();
}

Result<const CityFormat*> cityFormatOf(const std::filesystem::path& path) {
    const auto head = readHead(path);
    if (!head)
        return tl::unexpected(head.error());
    for (const CityFormat& format : cityFormats()) {
        if (format.recognises(*head))
            return &format;
    }
    if (const ForeignFormat* known = foreignFormatByContent(*head))
        return foreign(*known, path);
    for (const CityFormat& format : cityFormats()) {
        if (endsLike(format, head->name))
            return &format;
    }
    if (const ForeignFormat* known = foreignFormatByName(head->name))
        return foreign(*known, path);
    return fail(ErrorCode::Unreadable, "is of no format that Reflet knows", path.string(),
                fmt::format("Known are {}. Other city models convert to CityJSON, e.g. with "
                            "citygml-tools or FME.",
                            knownNames()));
}

std::vector<std::string> citySuffixes() {
    std::vector<std::string> suffixes;
    for (const CityFormat& format : cityFormats()) {
        for (const std::string_view suffix : format.suffixes) {
            std::string last(suffix.substr(suffix.rfind('.') + 1));
            if (std::find(suffixes.begin(), suffixes.end(), last) == suffixes.end())
                suffixes.push_back(std::move(last));
        }
    }
    suffixes.emplace_back("gz");
    return suffixes;
}

bool hasCitySuffix(std::string_view fileName) {
    const std::string name = plainName(std::string(fileName));
    return std::any_of(cityFormats().begin(), cityFormats().end(),
                       [&](const CityFormat& format) { return endsLike(format, name); });
}

PlaceInFolder placeInFolder(const std::filesystem::path& path) {
    const std::string name = plainName(path.filename().string());
    if (!hasCitySuffix(name))
        return PlaceInFolder::Other;
    const auto head = readHead(path);
    if (!head)
        return PlaceInFolder::City;  // its reader says what is wrong
    const auto& formats = cityFormats();
    const auto format = std::find_if(formats.begin(), formats.end(), [&](const CityFormat& known) {
        return known.recognises(*head);
    });
    const bool plainJson = name.ends_with(".json") && !name.ends_with(".city.json");
    if (format == formats.end()) {
        const auto named =
            std::find_if(formats.begin(), formats.end(),
                         [&](const CityFormat& known) { return endsLike(known, name); });
        if (named->name == kRasters)
            return PlaceInFolder::Raster;
        return named->recognises == looksLikeGltf || plainJson || name.ends_with(".xml") ||
                       name.ends_with(".zip")
                   ? PlaceInFolder::Other
                   : PlaceInFolder::City;
    }
    if (format->name == kRasters)
        return PlaceInFolder::Raster;
    if (format->recognises == looksLikeTileset)
        return PlaceInFolder::Tileset;
    if (format->recognises == looksLikeGltf)
        return PlaceInFolder::Other;  // a tile or a vehicle
    const bool anyJson = format->recognises == looksLikeCityJson && plainJson;
    return anyJson && !says(head->text, "\"CityJSON") && !says(head->text, "\"CityObjects")
               ? PlaceInFolder::Other
               : PlaceInFolder::City;
}

}  // namespace reflet
