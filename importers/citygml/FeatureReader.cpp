// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/FeatureReader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace reflet::citygml {

using namespace importers;

namespace {

constexpr int kDeepest = 32;  // a window in a wall in a room in a part in a building is 5

/// "lod2Solid": the level, and what the property holds. nullopt for properties without geometry.
struct GeometryProperty {
    std::string lod;
    GeometryType type = GeometryType::MultiSurface;
};

std::optional<GeometryProperty> geometryProperty(std::string_view name) {
    if (name == "tin")
        return GeometryProperty{"", GeometryType::MultiSurface};
    const bool levelled = name.size() > 4 && name.starts_with("lod") &&
                          std::isdigit(static_cast<unsigned char>(name[3])) != 0;
    if (!levelled || name.find("TerrainIntersection") != std::string_view::npos)
        return std::nullopt;
    const auto has = [&](std::string_view part) {
        return name.find(part) != std::string_view::npos;
    };
    GeometryType type = GeometryType::MultiSurface;
    if (has("ImplicitRepresentation"))
        type = GeometryType::Instance;
    else if (has("Curve") || has("Network"))
        type = GeometryType::MultiLineString;
    else if (has("Point"))
        type = GeometryType::MultiPoint;
    else if (has("Solid"))
        type = GeometryType::Solid;
    return GeometryProperty{std::string(name.substr(3, 1)), type};
}

}  // namespace

std::uint32_t FeatureReader::level(const std::string& name, SourceCity& file) const {
    const auto known = std::find(file.lodNames.begin(), file.lodNames.end(), name);
    const auto number = static_cast<std::uint32_t>(known - file.lodNames.begin());
    if (known == file.lodNames.end())
        file.lodNames.push_back(name);
    return number;
}

/// Its gml:id, or one that is made up; objects are told apart by it. `known`: it was there before.
std::string FeatureReader::idOf(pugi::xml_node node, std::string_view type, bool& known) {
    std::string id(attributeOf(node, "id"));
    known = false;
    if (id.empty())
        id = fmt::format("{} {}", type, ++m_unnamed);
    else
        known = !m_ids.insert(id).second;
    return id;
}

void FeatureReader::readGeometries(pugi::xml_node node, Member& member) {
    for (const pugi::xml_node child : node.children()) {
        if (child.type() != pugi::node_element)
            continue;
        const Name name = m_namespaces.nameOf(child);
        if (name.vocabulary != Vocabulary::CityGml)
            continue;
        const auto property = geometryProperty(name.local);
        if (!property)
            continue;
        GeometryOutline outline;
        outline.type = property->type;
        outline.lod = level(property->lod, member.file);
        member.file.geometries.push_back(std::move(outline));
        member.properties.push_back(child);
    }
}

void FeatureReader::readFeature(pugi::xml_node node, const Place& place, Member& member) {
    const std::string_view type = localNameOf(node);
    const auto kind = featureKind(type);
    auto& objects = member.file.objects;
    const auto index = static_cast<std::uint32_t>(objects.size());
    bool known = false;
    ObjectOutline object;
    object.id = idOf(node, type, known);
    object.duplicate = place.parent == kNone ? known : objects.front().duplicate;
    if (known && place.parent != kNone && !object.duplicate)
        object.id += fmt::format(" ({})", ++m_unnamed);  // two walls of one id are still two walls
    object.typeName = type;
    object.isBoundary = kind->isBoundary && place.parent != kNone;
    object.type = object.isBoundary ? place.hostType : kind->type;
    if (place.parent != kNone) {
        object.parentIds.push_back(objects[place.parent].id);
        objects[place.parent].hasChildren = true;
    }
    object.firstGeometry = static_cast<std::uint32_t>(member.file.geometries.size());
    readGeometries(node, member);
    object.geometryCount =
        static_cast<std::uint32_t>(member.file.geometries.size()) - object.firstGeometry;
    const CityObjectType own = object.type;
    objects.push_back(std::move(object));
    member.surfaceTypes.push_back(kind->surface);
    readInside(node, {index, own, place.depth + 1}, member);
}

/// The features that the properties of a node hold.
void FeatureReader::readInside(pugi::xml_node node, const Place& place, Member& member) {
    for (const pugi::xml_node property : node.children()) {
        if (property.type() != pugi::node_element)
            continue;
        const Name name = m_namespaces.nameOf(property);
        if (name.vocabulary == Vocabulary::Other) {
            ++m_foreign;
            continue;
        }
        if (geometryProperty(name.local))
            continue;
        for (const pugi::xml_node child : property.children()) {
            if (child.type() != pugi::node_element)
                continue;
            const Name inner = m_namespaces.nameOf(child);
            if (inner.vocabulary == Vocabulary::CityGml && featureKind(inner.local) &&
                place.depth < kDeepest)
                readFeature(child, place, member);
            else if (inner.vocabulary == Vocabulary::Other)
                ++m_foreign;
        }
    }
}

Member FeatureReader::read(pugi::xml_node root) {
    Member member;
    for (const pugi::xml_node child : root.children()) {
        if (child.type() != pugi::node_element)
            continue;
        const Name name = m_namespaces.nameOf(child);
        if (name.vocabulary == Vocabulary::CityGml && featureKind(name.local))
            readFeature(child, {}, member);
        else if (name.vocabulary == Vocabulary::Other)
            ++m_foreign;
    }
    return member;
}

}  // namespace reflet::citygml
