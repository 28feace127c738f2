// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ObjectNames.h"

#include <array>
#include <utility>

namespace reflet::importers {

namespace {

template <class Value, std::size_t N>
const Value* find(const std::array<std::pair<std::string_view, Value>, N>& table,
                  std::string_view name) {
    for (const auto& [key, value] : table) {
        if (key == name)
            return &value;
    }
    return nullptr;
}

using T = CityObjectType;
constexpr std::array<std::pair<std::string_view, T>, 36> kObjectTypes{{
    {"Building", T::Building},
    {"BuildingPart", T::BuildingPart},
    {"BuildingInstallation", T::BuildingInstallation},
    {"BuildingConstructiveElement", T::BuildingInstallation},
    {"BuildingFurniture", T::Other},
    {"BuildingRoom", T::Other},
    {"BuildingStorey", T::Other},
    {"BuildingUnit", T::Other},
    {"Bridge", T::Bridge},
    {"BridgePart", T::BridgePart},
    {"BridgeInstallation", T::BridgePart},
    {"BridgeConstructionElement", T::BridgePart},  // 1.0
    {"BridgeConstructiveElement", T::BridgePart},
    {"BridgeFurniture", T::Other},
    {"BridgeRoom", T::Other},
    {"Tunnel", T::Tunnel},
    {"TunnelPart", T::Tunnel},
    {"TunnelInstallation", T::Tunnel},
    {"TunnelConstructiveElement", T::Tunnel},
    {"TunnelFurniture", T::Other},
    {"TunnelHollowSpace", T::Other},
    {"Road", T::Road},
    {"Railway", T::Railway},
    {"TransportSquare", T::TransportSquare},
    {"Waterway", T::WaterBody},
    {"LandUse", T::LandUse},
    {"TINRelief", T::TinRelief},
    {"WaterBody", T::WaterBody},
    {"PlantCover", T::PlantCover},
    {"SolitaryVegetationObject", T::SolitaryVegetation},
    {"CityFurniture", T::CityFurniture},
    {"OtherConstruction", T::OtherConstruction},
    {"GenericCityObject", T::Generic},
    {"+GenericCityObject", T::Generic},
    {"CityObjectGroup", T::Group},
    {"ReliefFeature", T::TinRelief},
}};

using S = SurfaceType;
constexpr std::array<std::pair<std::string_view, S>, 18> kSurfaceTypes{{
    {"GroundSurface", S::Ground},
    {"WallSurface", S::Wall},
    {"RoofSurface", S::Roof},
    {"Window", S::Window},
    {"Door", S::Door},
    {"WindowSurface", S::Window},
    {"DoorSurface", S::Door},
    {"ClosureSurface", S::Closure},
    {"OuterCeilingSurface", S::OuterCeiling},
    {"OuterFloorSurface", S::OuterFloor},
    {"InteriorWallSurface", S::InteriorWall},
    {"TrafficArea", S::TrafficArea},
    {"AuxiliaryTrafficArea", S::AuxiliaryTrafficArea},
    {"WaterSurface", S::Water},
    {"WaterGroundSurface", S::Ground},
    {"WaterClosureSurface", S::Closure},
    {"TransportationMarking", S::TrafficArea},
    {"TransportationHole", S::Other},
}};

using G = GeometryType;
constexpr std::array<std::pair<std::string_view, G>, 8> kGeometryTypes{{
    {"MultiPoint", G::MultiPoint},
    {"MultiLineString", G::MultiLineString},
    {"MultiSurface", G::MultiSurface},
    {"CompositeSurface", G::CompositeSurface},
    {"Solid", G::Solid},
    {"MultiSolid", G::MultiSolid},
    {"CompositeSolid", G::CompositeSolid},
    {"GeometryInstance", G::Instance},
}};

}  // namespace

CityObjectType cityObjectType(std::string_view name) {
    const T* type = find(kObjectTypes, name);
    return type != nullptr ? *type : T::Other;
}

bool isKnownCityObjectType(std::string_view name) {
    return find(kObjectTypes, name) != nullptr || (name.size() > 1 && name.front() == '+');
}

bool isPart(std::string_view typeName) {
    return typeName.ends_with("Part");
}

SurfaceType surfaceType(std::string_view name) {
    const S* type = find(kSurfaceTypes, name);
    if (type != nullptr)
        return *type;
    return name.empty() ? S::Unknown : S::Other;
}

GeometryType geometryType(std::string_view name) {
    const G* type = find(kGeometryTypes, name);
    return type != nullptr ? *type : G::Unknown;
}

int boundaryDepth(GeometryType type) {
    switch (type) {
        case G::MultiSurface:
        case G::CompositeSurface:
            return 3;
        case G::Solid:
            return 4;
        case G::MultiSolid:
        case G::CompositeSolid:
            return 5;
        default:
            return 0;
    }
}

const char* toString(GeometryType type) {
    for (const auto& [name, value] : kGeometryTypes) {
        if (value == type)
            return name.data();
    }
    return "unknown";
}

}  // namespace reflet::importers
