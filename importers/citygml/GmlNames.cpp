// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/GmlNames.h"

#include "importers/common/ObjectNames.h"

#include <algorithm>
#include <array>

namespace reflet::citygml {

namespace {

constexpr std::string_view kCityGml = "http://www.opengis.net/citygml";

std::string_view withoutPrefix(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string_view prefixOf(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? std::string_view() : name.substr(0, colon);
}

Vocabulary vocabularyOfUri(std::string_view uri) {
    if (uri.starts_with(kCityGml))
        return Vocabulary::CityGml;
    if (uri == "http://www.opengis.net/gml" || uri.starts_with("http://www.opengis.net/gml/"))
        return Vocabulary::Gml;
    return Vocabulary::Other;
}

/// The prefix that an attribute "xmlns" or "xmlns:p" declares.
std::optional<std::string_view> declaredPrefix(std::string_view attribute) {
    if (attribute == "xmlns")
        return std::string_view();
    if (attribute.starts_with("xmlns:"))
        return attribute.substr(6);
    return std::nullopt;
}

using T = CityObjectType;
/// Features of CityGML 1, 2 and 3 that CityJSON names otherwise or not at all.
constexpr std::array<std::pair<std::string_view, T>, 26> kMoreFeatures{{
    {"IntBuildingInstallation", T::BuildingInstallation},
    {"Room", T::Other},
    {"Storey", T::Other},
    {"IntBridgeInstallation", T::BridgePart},
    {"HollowSpace", T::Other},
    {"IntTunnelInstallation", T::Tunnel},
    {"Track", T::Road},
    {"Square", T::TransportSquare},
    {"TransportationComplex", T::Road},
    {"Section", T::Road},
    {"Intersection", T::Road},
    {"TrafficSpace", T::Road},
    {"AuxiliaryTrafficSpace", T::Road},
    {"ClearanceSpace", T::Other},
    {"Marking", T::Road},
    {"Hole", T::Road},
    {"MassPointRelief", T::TinRelief},
    {"BreaklineRelief", T::TinRelief},
    {"RasterRelief", T::TinRelief},
    {"PointCloud", T::Other},
    {"GenericLogicalSpace", T::Generic},
    {"GenericOccupiedSpace", T::Generic},
    {"GenericUnoccupiedSpace", T::Generic},
    {"GenericThematicSurface", T::Generic},
    {"TransportationSpace", T::Road},
    {"VersionTransition", T::Other},
}};

/// Surfaces that bound features. CityJSON knows most of them as semantics.
constexpr std::array<std::pair<std::string_view, SurfaceType>, 23> kBoundaries{{
    {"GroundSurface", SurfaceType::Ground},
    {"WallSurface", SurfaceType::Wall},
    {"RoofSurface", SurfaceType::Roof},
    {"Window", SurfaceType::Window},
    {"WindowSurface", SurfaceType::Window},
    {"Door", SurfaceType::Door},
    {"DoorSurface", SurfaceType::Door},
    {"ClosureSurface", SurfaceType::Closure},
    {"OuterCeilingSurface", SurfaceType::OuterCeiling},
    {"OuterFloorSurface", SurfaceType::OuterFloor},
    {"InteriorWallSurface", SurfaceType::InteriorWall},
    {"CeilingSurface", SurfaceType::Other},
    {"FloorSurface", SurfaceType::Other},
    {"TrafficArea", SurfaceType::TrafficArea},
    {"AuxiliaryTrafficArea", SurfaceType::AuxiliaryTrafficArea},
    {"HoleSurface", SurfaceType::Other},
    {"WaterSurface", SurfaceType::Water},
    {"WaterGroundSurface", SurfaceType::Ground},
    {"WaterClosureSurface", SurfaceType::Closure},
    {"ThematicSurface", SurfaceType::Other},
    {"RoofEdge", SurfaceType::Other},
    {"_BoundarySurface", SurfaceType::Other},
    {"BoundarySurface", SurfaceType::Other},
}};

template <class Table>
auto find(const Table& table, std::string_view name) {
    return std::find_if(table.begin(), table.end(),
                        [&](const auto& entry) { return entry.first == name; });
}

}  // namespace

Namespaces::Namespaces(const std::string& root) {
    pugi::xml_document document;
    // The tag alone is no whole document; what pugixml read of it is kept all the same.
    document.load_buffer(root.data(), root.size(), pugi::parse_default, pugi::encoding_utf8);
    for (const pugi::xml_attribute attribute : firstElement(document).attributes()) {
        const std::string_view uri = attribute.value();
        if (const auto prefix = declaredPrefix(attribute.name()))
            m_prefixes.emplace_back(*prefix, vocabularyOfUri(uri));
        for (const char* version : {"1.0", "2.0", "3.0"}) {
            // The core decides; modules may be of the profile's version.
            if (uri == std::string(kCityGml) + "/" + version)
                m_version = version;
            else if (m_version.empty() && uri.starts_with(kCityGml) && uri.ends_with(version))
                m_version = version;
        }
    }
}

Vocabulary Namespaces::vocabularyOf(std::string_view prefix, pugi::xml_node node) const {
    for (; m_inside && node; node = node.parent()) {
        for (const pugi::xml_attribute attribute : node.attributes()) {
            const auto declared = declaredPrefix(attribute.name());
            if (declared && *declared == prefix)
                return vocabularyOfUri(attribute.value());
        }
    }
    const auto known = std::find_if(m_prefixes.begin(), m_prefixes.end(),
                                    [&](const auto& entry) { return entry.first == prefix; });
    return known == m_prefixes.end() ? Vocabulary::Other : known->second;
}

Name Namespaces::nameOf(pugi::xml_node node) const {
    const std::string_view name = node.name();
    return {vocabularyOf(prefixOf(name), node), withoutPrefix(name)};
}

std::optional<FeatureKind> featureKind(std::string_view localName) {
    if (const auto known = find(kBoundaries, localName); known != kBoundaries.end())
        return FeatureKind{CityObjectType::Other, true, known->second};
    if (const auto known = find(kMoreFeatures, localName); known != kMoreFeatures.end())
        return FeatureKind{known->second, false, SurfaceType::Unknown};
    if (importers::isKnownCityObjectType(localName))
        return FeatureKind{importers::cityObjectType(localName), false, SurfaceType::Unknown};
    return std::nullopt;
}

std::string_view attributeOf(pugi::xml_node node, std::string_view localName) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
        if (withoutPrefix(attribute.name()) == localName)
            return attribute.value();
    }
    return {};
}

std::string_view localNameOf(pugi::xml_node node) {
    return withoutPrefix(node.name());
}

pugi::xml_node firstElement(pugi::xml_node node) {
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element)
            return child;
    }
    return {};
}

pugi::xml_node childOf(pugi::xml_node node, std::string_view localName) {
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element && withoutPrefix(child.name()) == localName)
            return child;
    }
    return {};
}

}  // namespace reflet::citygml
