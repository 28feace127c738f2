// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/unit/importers/GltfText.h"

#include <string>
#include <utility>
#include <vector>

// Tiles and tilesets made in memory.
namespace reflet::test {

inline std::string word(std::size_t value) {
    const auto number = std::uint32_t(value);
    return {reinterpret_cast<const char*>(&number), 4};
}

inline std::string padded(std::string text, std::size_t to = 8) {
    text.resize((text.size() + to - 1) / to * to, ' ');
    return text;
}

/// A .glb of the file; its buffer stays in the JSON.
inline std::string glb(const GltfText& gltf) {
    const std::string text = padded(gltf.text());
    return "glTF" + word(2) + word(20 + text.size()) + word(text.size()) + "JSON" + text;
}

inline std::string floats(const std::vector<float>& values) {
    return {reinterpret_cast<const char*>(values.data()), 4 * values.size()};
}

inline std::string b3dm(const std::string& payload, const json& features = {{"BATCH_LENGTH", 0}},
                        const json& batches = nullptr) {
    const std::string table = padded(features.dump());
    const std::string batch = batches.is_null() ? "" : padded(batches.dump());
    return "b3dm" + word(1) + word(28 + table.size() + batch.size() + payload.size()) +
           word(table.size()) + word(0) + word(batch.size()) + word(0) + table + batch + payload;
}

inline std::string i3dm(const std::string& payload, const json& features,
                        const std::string& binary) {
    const std::string table = padded(features.dump());
    return "i3dm" + word(1) + word(32 + table.size() + binary.size() + payload.size()) +
           word(table.size()) + word(binary.size()) + word(0) + word(0) + word(1) + table + binary +
           payload;
}

inline std::string cmpt(const std::vector<std::string>& tiles) {
    std::string inner;
    for (const std::string& tile : tiles)
        inner += tile;
    return "cmpt" + word(1) + word(16 + inner.size()) + word(tiles.size()) + inner;
}

/// A box of 4 m east, 3 m north and 2 m up, at a place, as a tile has it: with y up.
inline GltfText boxAt(float east, float north, float up = 0.0F) {
    GltfText gltf;
    gltf.box({east, up, -north - 3.0F}, {east + 4.0F, up + 2.0F, -north});
    return gltf;
}

inline json tile(const std::string& uri, json children = json::array(),
                 const char* refine = nullptr) {
    json out{{"geometricError", 1}, {"boundingVolume", {{"sphere", {0, 0, 0, 1}}}}};
    if (!uri.empty())
        out["content"] = {{"uri", uri}};
    if (!children.empty())
        out["children"] = std::move(children);
    if (refine != nullptr)
        out["refine"] = refine;
    return out;
}

inline std::string tileset(const json& root) {
    return json{{"asset", {{"version", "1.0"}}}, {"geometricError", 10}, {"root", root}}.dump();
}

inline json translation(double x, double y, double z) {
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

/// A .glb of the file with its buffer in a chunk of its own.
inline std::string binaryGlb(const GltfText& gltf) {
    json root = json::parse(gltf.text());
    root["buffers"][0].erase("uri");
    const std::string text = padded(root.dump(), 4);
    std::string bytes = gltf.bytes();
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return "glTF" + word(2) + word(28 + text.size() + bytes.size()) + word(text.size()) + "JSON" +
           text + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

}  // namespace reflet::test
