// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/NamedTypes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace reflet::importers {

namespace {

template <class Type>
struct Word {
    std::string_view word;
    Type type;
};

// In the order in which they are looked for: a "BuildingWall" is of a building, a "RoadBridge" is a
// bridge.
constexpr std::array<Word<CityObjectType>, 42> kTypes{{
    {"bridge", CityObjectType::Bridge},
    {"bruecke", CityObjectType::Bridge},
    {"brug", CityObjectType::Bridge},
    {"tunnel", CityObjectType::Tunnel},
    {"building", CityObjectType::Building},
    {"gebaeude", CityObjectType::Building},
    {"gebäude", CityObjectType::Building},
    {"gebouw", CityObjectType::Building},
    {"batiment", CityObjectType::Building},
    {"house", CityObjectType::Building},
    {"facade", CityObjectType::Building},
    {"fassade", CityObjectType::Building},
    {"roof", CityObjectType::Building},
    {"terrain", CityObjectType::TinRelief},
    {"ground", CityObjectType::TinRelief},
    {"gelaende", CityObjectType::TinRelief},
    {"gelände", CityObjectType::TinRelief},
    {"relief", CityObjectType::TinRelief},
    {"landuse", CityObjectType::LandUse},
    {"road", CityObjectType::Road},
    {"street", CityObjectType::Road},
    {"strasse", CityObjectType::Road},
    {"straße", CityObjectType::Road},
    {"sidewalk", CityObjectType::Road},
    {"pavement", CityObjectType::Road},
    {"asphalt", CityObjectType::Road},
    {"railway", CityObjectType::Railway},
    {"water", CityObjectType::WaterBody},
    {"river", CityObjectType::WaterBody},
    {"gewaesser", CityObjectType::WaterBody},
    {"forest", CityObjectType::PlantCover},
    {"vegetation", CityObjectType::PlantCover},
    {"grass", CityObjectType::PlantCover},
    {"hedge", CityObjectType::PlantCover},
    {"tree", CityObjectType::SolitaryVegetation},
    {"baum", CityObjectType::SolitaryVegetation},
    {"boom", CityObjectType::SolitaryVegetation},
    {"lamp", CityObjectType::CityFurniture},
    {"bench", CityObjectType::CityFurniture},
    {"furniture", CityObjectType::CityFurniture},
    {"separation", CityObjectType::OtherConstruction},
    {"fence", CityObjectType::OtherConstruction},
}};

constexpr std::array<Word<SurfaceType>, 8> kSurfaces{{
    {"wall", SurfaceType::Wall},
    {"facade", SurfaceType::Wall},
    {"fassade", SurfaceType::Wall},
    {"roof", SurfaceType::Roof},
    {"dach", SurfaceType::Roof},
    {"window", SurfaceType::Window},
    {"fenster", SurfaceType::Window},
    {"door", SurfaceType::Door},
}};

std::string lowerCase(std::string_view name) {
    std::string lower(name.substr(0, 256));
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

template <class Type, std::size_t N>
const Word<Type>* find(const std::array<Word<Type>, N>& words, std::string_view name) {
    const std::string lower = lowerCase(name);
    const auto found = std::find_if(words.begin(), words.end(), [&](const Word<Type>& word) {
        return lower.find(word.word) != std::string::npos;
    });
    return found == words.end() ? nullptr : &*found;
}

}  // namespace

std::optional<CityObjectType> typeByName(std::string_view name) {
    const auto* found = find(kTypes, name);
    return found == nullptr ? std::nullopt : std::optional(found->type);
}

SurfaceType surfaceByName(std::string_view name) {
    const auto* found = find(kSurfaces, name);
    return found == nullptr ? SurfaceType::Unknown : found->type;
}

}  // namespace reflet::importers
