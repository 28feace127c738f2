// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/footprints/FieldChoice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string_view>

namespace reflet::footprints {

namespace {

using Fields = std::vector<std::string>;
using Names = std::span<const std::string_view>;

/// In lower case and without what separates words: building:levels is building_levels is
/// buildingLevels. Letters beyond ASCII stay as they are.
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte) != 0)
            out += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    }
    return out;
}

/// The first of the names that a field has.
std::optional<std::size_t> firstOf(const Fields& fields, Names names) {
    for (const std::string_view name : names) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (plain(fields[i]) == name)
                return i;
        }
    }
    return std::nullopt;
}

// Names as plain() writes them, the surest first.
constexpr auto kIds =
    std::to_array<std::string_view>({"identificatie", "gmlid", "osmid", "buildingid", "globalid",
                                     "objectid", "uuid", "id", "cleabs"});
constexpr auto kHeights = std::to_array<std::string_view>(
    {"height",          "buildingheight", "bldgheight",   "bldheight",  "heightm",
     "buildingheightm", "measuredheight", "renderheight", "relhmax",    "relh2",
     "hauteur",         "hoehe",          "höhe",         "gebhoehe",   "gebaeudehoehe",
     "altezza",         "altura",         "hoogte",       "heightmean", "hgt"});
constexpr auto kStoreys = std::to_array<std::string_view>({"buildinglevels",
                                                           "levels",
                                                           "numfloors",
                                                           "numberoffloors",
                                                           "numberoffloorsaboveground",
                                                           "numberofstoriesaboveground",
                                                           "numberofstoreysaboveground",
                                                           "numberofstories",
                                                           "numberofstoreys",
                                                           "storeysaboveground",
                                                           "floors",
                                                           "storeys",
                                                           "stories",
                                                           "nombredetages",
                                                           "nbetages",
                                                           "geschosse",
                                                           "geschosszahl",
                                                           "anzahlgeschosse",
                                                           "anzahlderoberirdischengeschosse",
                                                           "bouwlagen"});
constexpr auto kBases =
    std::to_array<std::string_view>({"groundelevation", "baseelevation", "groundelev", "baseelev",
                                     "gndelev", "groundheight", "zground", "zmin", "basez"});
constexpr auto kLifted =
    std::to_array<std::string_view>({"minheight", "buildingminheight", "renderminheight"});
constexpr auto kRoofShapes = std::to_array<std::string_view>({"roofshape", "buildingroofshape"});
constexpr auto kRoofHeights = std::to_array<std::string_view>({"roofheight", "buildingroofheight"});

/// Elevations of top and ground that belong together.
struct Elevations {
    std::string_view top, ground;
};
constexpr std::array<Elevations, 7> kElevations{{
    {"b3hdak70p", "b3hmaaiveld"},                     // 3DBAG: RD New, NAP
    {"b3hdak50p", "b3hmaaiveld"},                     //
    {"b3hdakmax", "b3hmaaiveld"},                     //
    {"abshmax", "abshmin"},                           // OS MasterMap
    {"altitudemaximaletoit", "altitudeminimalesol"},  // BD TOPO
    {"zmaxtoit", "zminsol"},                          // BD TOPO, short names of the shapefile
    {"roofelevation", "groundelevation"},             //
}};

Result<std::optional<std::size_t>> named(const Fields& fields, const std::string& name,
                                         const char* option, const std::string& subject) {
    if (name.empty())
        return std::optional<std::size_t>();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i] == name)
            return std::optional(i);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (plain(fields[i]) == plain(name))
            return std::optional(i);
    }
    return fail(ErrorCode::Usage, fmt::format("has no attribute \"{}\" ({})", name, option),
                subject, fmt::format("It has {:.400}.", fmt::to_string(fmt::join(fields, ", "))));
}

void chooseElevations(const Fields& fields, FieldChoice& choice) {
    for (const Elevations& pair : kElevations) {
        const auto top = firstOf(fields, Names(&pair.top, 1)),
                   ground = firstOf(fields, Names(&pair.ground, 1));
        if (top && ground) {
            choice.top = top;
            choice.base = ground;
            return;
        }
    }
}

std::string describe(const Fields& fields, const FieldChoice& choice) {
    std::vector<std::string> parts;
    if (choice.height)
        parts.push_back(fields[*choice.height]);
    if (choice.top && choice.base)
        parts.push_back(fmt::format("{} above {}", fields[*choice.top], fields[*choice.base]));
    if (choice.storeys)
        parts.push_back(fmt::format("{} storeys", fields[*choice.storeys]));
    return fmt::to_string(fmt::join(parts, ", else "));
}

}  // namespace

Result<FieldChoice> chooseFields(const Fields& fields, const ImportOptions& options,
                                 const std::string& subject) {
    FieldChoice choice;
    const auto height = named(fields, options.heightField, "--height-field", subject);
    if (!height)
        return tl::unexpected(height.error());
    const auto base = named(fields, options.baseField, "--base-field", subject);
    if (!base)
        return tl::unexpected(base.error());
    choice.height = *height ? *height : firstOf(fields, kHeights);
    if (!*height)
        chooseElevations(fields, choice);
    if (*base)
        choice.base = *base;
    else if (!choice.base)
        choice.base = firstOf(fields, kBases);
    choice.storeys = firstOf(fields, kStoreys);
    choice.lifted = firstOf(fields, kLifted);
    choice.roofShape = firstOf(fields, kRoofShapes);
    choice.roofHeight = firstOf(fields, kRoofHeights);
    choice.id = firstOf(fields, kIds);
    choice.described = describe(fields, choice);
    return choice;
}

}  // namespace reflet::footprints
