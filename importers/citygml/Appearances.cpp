// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/Appearances.h"

#include "importers/citygml/GmlNames.h"
#include "importers/citygml/GmlPoints.h"
#include "importers/common/Colours.h"

#include <algorithm>

namespace reflet::citygml {

namespace {

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos)
        return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

void readColour(pugi::xml_node node, glm::vec3& into) {
    std::vector<double> rgb;
    if (node && readNumbers(node.child_value(), rgb) && rgb.size() >= 3)
        into = importers::linearFromSrgb({rgb[0], rgb[1], rgb[2]});
}

void readShare(pugi::xml_node node, float& into) {
    std::vector<double> value;
    if (node && readNumbers(node.child_value(), value) && value.size() == 1)
        into = static_cast<float>(std::clamp(value[0], 0.0, 1.0));
}

std::vector<glm::vec2> pairsOf(const std::vector<double>& values) {
    std::vector<glm::vec2> pairs;
    pairs.reserve(values.size() / 2);
    for (std::size_t i = 0; i + 1 < values.size(); i += 2)
        pairs.emplace_back(static_cast<float>(values[i]), static_cast<float>(values[i + 1]));
    return pairs;
}

bool isBack(pugi::xml_node node) {
    const std::string_view front = trimmed(childOf(node, "isFront").child_value());
    return front == "false" || front == "0";
}

}  // namespace

std::string_view idOfReference(std::string_view reference) {
    reference = trimmed(reference);
    return reference.starts_with('#') ? reference.substr(1) : std::string_view();
}

void Appearances::addAllOf(pugi::xml_node node) {
    // Without recursion: how deep a member is has been checked, but this costs nothing.
    std::vector<pugi::xml_node> open{node};
    while (!open.empty()) {
        const pugi::xml_node next = open.back();
        open.pop_back();
        if (localNameOf(next) == "Appearance") {
            addAppearance(next);
            continue;
        }
        const std::size_t first = open.size();
        for (const pugi::xml_node child : next.children()) {
            if (child.type() == pugi::node_element)
                open.push_back(child);
        }
        std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
    }
}

void Appearances::addAppearance(pugi::xml_node appearance) {
    for (const pugi::xml_node member : appearance.children()) {
        const pugi::xml_node data = firstElement(member);
        if (!data || isBack(data))
            continue;
        if (localNameOf(data) == "X3DMaterial")
            addMaterialOfTargets(data);
        else if (localNameOf(data) == "ParameterizedTexture")
            addTexture(data);
        else if (localNameOf(data) == "GeoreferencedTexture")
            addGeoreferenced(data);
    }
}

std::uint32_t Appearances::addMaterial(pugi::xml_node node) {
    CityMaterial material;
    material.name = trimmed(childOf(node, "name").child_value());
    readColour(childOf(node, "diffuseColor"), material.diffuse);
    readColour(childOf(node, "emissiveColor"), material.emission);
    readShare(childOf(node, "shininess"), material.shininess);
    readShare(childOf(node, "transparency"), material.transparency);
    m_materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(m_materials.size() - 1);
}

/// To the surfaces that the node's targets name, unless they have one.
void Appearances::giveTargets(pugi::xml_node node, std::uint32_t number,
                              std::uint32_t Look::*member) {
    for (const pugi::xml_node target : node.children()) {
        if (localNameOf(target) != "target")
            continue;
        const std::string_view id = idOfReference(target.child_value());
        if (id.empty())
            continue;
        Look& look = m_looks[std::string(id)];
        if (look.*member == kNone)
            look.*member = number;
    }
}

void Appearances::addMaterialOfTargets(pugi::xml_node node) {
    const std::uint32_t number = addMaterial(node);
    giveTargets(node, number, &Look::material);
}

void Appearances::addTexture(pugi::xml_node node) {
    importers::TextureEntry entry;
    entry.image = trimmed(childOf(node, "imageURI").child_value());
    // "wrap" and "mirror" repeat; "none", "clamp" and "border" end at the edge.
    const std::string_view mode = trimmed(childOf(node, "wrapMode").child_value());
    entry.repeat = mode.empty() || mode == "wrap" || mode == "mirror";
    const auto number = static_cast<std::uint32_t>(m_textures.size());
    m_textures.push_back(std::move(entry));
    for (const pugi::xml_node child : node.children()) {
        const std::string_view name = localNameOf(child);
        if (name == "target") {  // CityGML 1 and 2
            addTarget(idOfReference(attributeOf(child, "uri")), firstElement(child), number);
        } else if (name == "textureParameterization") {  // 3
            const pugi::xml_node association = firstElement(child);
            addTarget(idOfReference(childOf(association, "target").child_value()),
                      firstElement(childOf(association, "textureParameterization")), number);
        }
    }
}

/// A texture seen from above, by where its image lies (CityGML 2.0, 9.3).
void Appearances::addGeoreferenced(pugi::xml_node node) {
    importers::TextureEntry entry;
    entry.image = trimmed(childOf(node, "imageURI").child_value());
    entry.repeat = false;
    const auto number = static_cast<std::uint32_t>(m_textures.size());
    m_textures.push_back(std::move(entry));
    Georeference& georeference = m_georeferences[number];
    std::vector<double> matrix;
    std::vector<glm::dvec3> point;
    if (readNumbers(childOf(node, "orientation").child_value(), matrix) && matrix.size() == 4 &&
        readPoints(firstElement(childOf(node, "referencePoint")), 2, point).empty() &&
        point.size() == 1) {
        georeference.orientation = {matrix[0], matrix[1], matrix[2], matrix[3]};
        georeference.referencePoint = {point[0].x, point[0].y};
    }
    giveTargets(node, number, &Look::texture);
}

const Appearances::Look& Appearances::addTexturedSurface(pugi::xml_node node) {
    Look& look = m_inline.emplace_back();
    for (const pugi::xml_node property : node.children()) {
        const pugi::xml_node data = firstElement(property);
        if (localNameOf(property) != "appearance" || !data)
            continue;
        const std::string_view name = localNameOf(data);
        if (name == "Material" && look.material == kNone)
            look.material = addMaterial(data);
        if (name != "SimpleTexture" || look.texture != kNone)
            continue;
        importers::TextureEntry entry;
        entry.image = trimmed(childOf(data, "textureMap").child_value());
        const std::string_view repeat = trimmed(childOf(data, "repeat").child_value());
        entry.repeat = repeat == "true" || repeat == "1";
        look.texture = static_cast<std::uint32_t>(m_textures.size());
        m_textures.push_back(std::move(entry));
        std::vector<double> values;
        if (readNumbers(childOf(data, "textureCoordinates").child_value(), values))
            look.uv = pairsOf(values);
    }
    return look;
}

const Georeference* Appearances::georeference(std::uint32_t texture) const {
    const auto known = m_georeferences.find(texture);
    return known == m_georeferences.end() ? nullptr : &known->second;
}

void Appearances::addTarget(std::string_view id, pugi::xml_node mapping, std::uint32_t texture) {
    if (id.empty() || !mapping)
        return;
    Look& look = m_looks[std::string(id)];
    if (look.texture != kNone)
        return;
    look.texture = texture;
    if (localNameOf(mapping) == "TexCoordList") {
        addRings(mapping, texture);
        return;
    }
    std::vector<double> matrix;
    if (readNumbers(childOf(mapping, "worldToTexture").child_value(), matrix) &&
        matrix.size() == 12) {
        look.worldToTexture.emplace();
        std::copy(matrix.begin(), matrix.end(), look.worldToTexture->begin());
    }
}

/// Coordinates with the ring as an attribute (1, 2), or as an element of its own behind them (3).
void Appearances::addRings(pugi::xml_node list, std::uint32_t texture) {
    std::vector<const char*> without;
    std::size_t next = 0;
    for (const pugi::xml_node child : list.children()) {
        const std::string_view name = localNameOf(child);
        const std::string_view ring = attributeOf(child, "ring");
        if (name == "textureCoordinates" && !ring.empty())
            addRing(idOfReference(ring), child.child_value(), texture);
        else if (name == "textureCoordinates")
            without.push_back(child.child_value());
    }
    for (const pugi::xml_node child : list.children()) {
        if (localNameOf(child) == "ring" && next < without.size())
            addRing(idOfReference(child.child_value()), without[next++], texture);
    }
}

void Appearances::addRing(std::string_view id, const char* numbers, std::uint32_t texture) {
    std::vector<double> values;
    if (id.empty() || !readNumbers(numbers, values) || values.size() % 2 != 0)
        return;  // the surface will miss them
    m_rings.try_emplace(std::string(id), RingUv{texture, pairsOf(values)});
}

const Appearances::Look* Appearances::find(std::string_view surfaceId) const {
    const auto known = m_looks.find(surfaceId);
    return known == m_looks.end() ? nullptr : &known->second;
}

const std::vector<glm::vec2>* Appearances::ring(std::string_view ringId,
                                                std::uint32_t texture) const {
    const auto known = m_rings.find(ringId);
    return known == m_rings.end() || known->second.texture != texture ? nullptr : &known->second.uv;
}

}  // namespace reflet::citygml
