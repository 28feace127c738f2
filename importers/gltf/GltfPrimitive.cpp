// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace reflet::gltf {

using nlohmann::json;

namespace {

enum Mode : std::size_t { Triangles = 4, Strip = 5, Fan = 6 };

/// The corners of triangle i (glTF 2.0, section 3.7.2.1).
glm::uvec3 cornersOf(std::size_t i, std::size_t mode) {
    const auto n = std::uint32_t(i);
    if (mode == Strip)
        return i % 2 == 0 ? glm::uvec3(n, n + 1, n + 2) : glm::uvec3(n + 1, n, n + 2);
    return mode == Fan ? glm::uvec3(0, n + 1, n + 2) : glm::uvec3(3 * n, 3 * n + 1, 3 * n + 2);
}

std::size_t trianglesOf(std::size_t corners, std::size_t mode) {
    if (mode == Triangles)
        return corners / 3;
    return mode == Strip || mode == Fan ? (corners < 3 ? 0 : corners - 2) : 0;
}

std::vector<glm::vec3> asVectors(const std::vector<float>& values) {
    std::vector<glm::vec3> out(values.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return out;
}

/// COLOR_0 of three or four components.
void readColors(const Document& document, const json& attributes, Primitive& out) {
    const auto index = wholeNumber(attributes, "COLOR_0");
    if (!index)
        return;
    const bool alpha = text(document.element("accessors", *index), "type") == "VEC4";
    std::string ignored;
    const auto values = readFloats(document, *index, alpha ? 4 : 3, ignored);
    const std::size_t step = alpha ? 4 : 3;
    if (!values || values->size() / step != out.positions.size())
        return;
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        const float* c = values->data() + i * step;
        out.colors.push_back(glm::clamp(glm::vec3(c[0], c[1], c[2]), 0.0F, 1.0F));
    }
}

std::vector<float> readUv(const Document& document, const json& attributes, const char* key,
                          std::size_t vertices) {
    const auto index = wholeNumber(attributes, key);
    std::string ignored;
    auto values = index ? readFloats(document, *index, 2, ignored) : std::nullopt;
    if (!values || values->size() != 2 * vertices)
        return {};
    return std::move(*values);
}

/// Leaves out triangles whose vertices do not exist, are not finite or are not three.
void addTriangles(const std::vector<std::uint32_t>* indices, std::size_t mode, Primitive& out) {
    const std::size_t corners = indices != nullptr ? indices->size() : out.positions.size();
    for (std::size_t i = 0; i < trianglesOf(corners, mode); ++i) {
        glm::uvec3 t = cornersOf(i, mode);
        if (indices != nullptr)
            t = {(*indices)[t.x], (*indices)[t.y], (*indices)[t.z]};
        const std::uint32_t most = std::max({t.x, t.y, t.z});
        const auto finite = [&](std::uint32_t v) {
            const glm::vec3& p = out.positions[v];
            constexpr float kMost = 1e15F;
            return std::abs(p.x) < kMost && std::abs(p.y) < kMost && std::abs(p.z) < kMost;
        };
        if (most >= out.positions.size() || !finite(t.x) || !finite(t.y) || !finite(t.z)) {
            ++out.outOfRange;
            continue;
        }
        if (t.x != t.y && t.y != t.z && t.z != t.x)
            out.triangles.push_back(t);
    }
}

}  // namespace

std::size_t countTriangles(const Document& document, const json& primitive) {
    const std::size_t mode = wholeNumber(primitive, "mode").value_or(Triangles);
    auto corners = wholeNumber(primitive, "indices");
    if (!corners)
        corners = wholeNumber(member(primitive, "attributes"), "POSITION");
    const auto count =
        wholeNumber(document.element("accessors", corners.value_or(SIZE_MAX)), "count");
    return trianglesOf(count.value_or(0), mode);
}

std::optional<Primitive> readPrimitive(const Document& document, const json& primitive,
                                       std::string& problem) {
    const std::size_t mode = wholeNumber(primitive, "mode").value_or(Triangles);
    if (mode < Triangles || mode > Fan) {
        problem = "lines and points are not shown";
        return std::nullopt;
    }
    std::optional<Primitive> out;
    if (member(member(primitive, "extensions"), "KHR_draco_mesh_compression").is_object()) {
        out = readDraco(document, primitive, problem);
        if (!out)
            return std::nullopt;
    } else {
        const json& attributes = member(primitive, "attributes");
        const auto positions = wholeNumber(attributes, "POSITION");
        problem = "it has no positions";
        const auto values = positions ? readFloats(document, *positions, 3, problem) : std::nullopt;
        if (!values)
            return std::nullopt;
        out.emplace();
        out->positions = asVectors(*values);
        const auto normals = wholeNumber(attributes, "NORMAL");
        std::string ignored;
        const auto given = normals ? readFloats(document, *normals, 3, ignored) : std::nullopt;
        if (given && given->size() == values->size())
            out->normals = asVectors(*given);
        out->uv = readUv(document, attributes, "TEXCOORD_0", out->positions.size());
        out->uv1 = readUv(document, attributes, "TEXCOORD_1", out->positions.size());
        readColors(document, attributes, *out);
        if (const auto index = wholeNumber(primitive, "indices")) {
            const auto indices = readIndices(document, *index, problem);
            if (!indices)
                return std::nullopt;
            addTriangles(&*indices, mode, *out);
        } else {
            addTriangles(nullptr, mode, *out);
        }
    }
    out->material = wholeNumber(primitive, "material");
    return out;
}

}  // namespace reflet::gltf
