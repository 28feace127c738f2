// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/PngText.h"
#include "tests/unit/importers/files/TileText.h"

// A square of ground with an image on it.
namespace reflet::test {

/// 4 x 4 pixels, each of a colour of its own; row 0 is the top.
inline std::array<std::uint8_t, 4> pixelOf(int column, int row) {
    return {std::uint8_t(30 + 60 * column), std::uint8_t(40 + 50 * row),
            std::uint8_t(10 + 9 * (4 * row + column)), 255};
}
inline std::string chequered() {
    std::vector<std::array<std::uint8_t, 4>> pixels;
    for (int i = 0; i < 16; ++i)
        pixels.push_back(pixelOf(i % 4, i / 4));
    return png(4, 4, pixels);
}

/// A level square of 4 m from (east, north) on, with coordinates that lay an image on it as on a
/// map: its left edge is west, its top edge north (v counts down from the top).
inline GltfText mapSquare(float east = 0.0F, float north = 0.0F) {
    GltfText gltf;
    json& primitive = gltf.mesh(
        {east, 0, -north, east + 4, 0, -north, east + 4, 0, -north - 4, east, 0, -north - 4},
        {0, 1, 2, 0, 2, 3});
    primitive["attributes"]["TEXCOORD_0"] =
        gltf.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, 5126, "VEC2", 2);
    primitive["material"] = 0;
    gltf.root["materials"] = {
        {{"name", "photo"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    gltf.root["textures"] = {{{"source", 0}}};
    return gltf;
}

/// The same with its image in the file.
inline GltfText photoSquare(float east = 0.0F, float north = 0.0F) {
    GltfText gltf = mapSquare(east, north);
    gltf.root["images"] = {{{"bufferView", gltf.view(chequered())}, {"mimeType", "image/png"}}};
    return gltf;
}

}  // namespace reflet::test
