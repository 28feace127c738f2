// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/footprints/FieldChoice.h"

#include "importers/common/FieldNames.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace reflet::footprints {

namespace {

using importers::Fields;
using importers::firstField;
using importers::namedField;
using importers::Names;

// Names as plainName() writes them, the surest first.
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

void chooseElevations(const Fields& fields, FieldChoice& choice) {
    for (const Elevations& pair : kElevations) {
        const auto top = firstField(fields, Names(&pair.top, 1)),
                   ground = firstField(fields, Names(&pair.ground, 1));
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
    const auto height = namedField(fields, options.heightField, "--height-field", subject);
    if (!height)
        return tl::unexpected(height.error());
    const auto base = namedField(fields, options.baseField, "--base-field", subject);
    if (!base)
        return tl::unexpected(base.error());
    choice.height = *height ? *height : firstField(fields, kHeights);
    if (!*height)
        chooseElevations(fields, choice);
    if (*base)
        choice.base = *base;
    else if (!choice.base)
        choice.base = firstField(fields, kBases);
    choice.storeys = firstField(fields, kStoreys);
    choice.lifted = firstField(fields, kLifted);
    choice.roofShape = firstField(fields, kRoofShapes);
    choice.roofHeight = firstField(fields, kRoofHeights);
    choice.id = firstField(fields, kIds);
    choice.described = describe(fields, choice);
    return choice;
}

}  // namespace reflet::footprints
