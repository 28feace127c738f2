// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/AppearanceReader.h"

#include "importers/common/Colours.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace reflet::cityjson {

namespace {

std::optional<glm::vec3> readColour(JsonValue value) {
    const auto rgb = value.numbers<3>();
    if (!rgb)
        return std::nullopt;
    return linearFromSrgb({(*rgb)[0], (*rgb)[1], (*rgb)[2]});
}

void readShare(JsonValue value, float& into) {
    if (const auto number = value.number())
        into = static_cast<float>(std::clamp(*number, 0.0, 1.0));
}

CityMaterial readMaterial(JsonValue value) {
    CityMaterial material;
    value.forEachMember([&](std::string_view key, JsonValue member) {
        if (key == "name")
            material.name = member.string().value_or("");
        else if (key == "diffuseColor")
            material.diffuse = readColour(member).value_or(material.diffuse);
        else if (key == "emissiveColor")
            material.emission = readColour(member).value_or(material.emission);
        else if (key == "shininess")
            readShare(member, material.shininess);
        else if (key == "transparency")
            readShare(member, material.transparency);
    });
    return material;
}

TextureEntry readTexture(JsonValue value) {
    TextureEntry texture;
    value.forEachMember([&](std::string_view key, JsonValue member) {
        if (key == "image") {
            texture.image = member.string().value_or("");
        } else if (key == "wrapMode") {
            // "wrap" and "mirror" repeat; "none", "clamp" and "border" end at the edge.
            const std::string mode = member.string().value_or("wrap");
            texture.repeat = mode == "wrap" || mode == "mirror" || mode == "unknown";
        }
    });
    return texture;
}

}  // namespace

void readAppearance(JsonValue value, SourceCity& file, const JobContext& job) {
    value.forEachMember([&](std::string_view key, JsonValue member) {
        if (key == "materials")
            member.forEachElement(
                [&](JsonValue entry) { file.materials.push_back(readMaterial(entry)); });
        else if (key == "textures")
            member.forEachElement(
                [&](JsonValue entry) { file.textures.push_back(readTexture(entry)); });
        else if (key == "vertices-texture")
            member.points(file.textureVertices, job);
        else if (key == "default-theme-material")
            file.defaultMaterialTheme = member.string().value_or("");
        else if (key == "default-theme-texture")
            file.defaultTextureTheme = member.string().value_or("");
    });
}

}  // namespace reflet::cityjson
