// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace reflet::gltf {

namespace {

/// The corners of triangle i (glTF 2.0, section 3.7.2.1).
glm::uvec3 cornersOf(std::size_t i, int mode) {
    const auto n = std::uint32_t(i);
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        return i % 2 == 0 ? glm::uvec3(n, n + 1, n + 2) : glm::uvec3(n + 1, n, n + 2);
    return mode == TINYGLTF_MODE_TRIANGLE_FAN ? glm::uvec3(0, n + 1, n + 2)
                                              : glm::uvec3(3 * n, 3 * n + 1, 3 * n + 2);
}

std::size_t trianglesOf(std::size_t corners, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return corners / 3;
    const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN;
    return strip && corners > 2 ? corners - 2 : 0;
}

/// The accessor of an attribute, or -1.
int attributeOf(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

std::vector<glm::vec3> asVectors(const std::vector<float>& values) {
    std::vector<glm::vec3> out(values.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return out;
}

/// COLOR_0 of three or four components.
void readColors(const Document& document, const tinygltf::Primitive& primitive, Primitive& out) {
    const int index = attributeOf(primitive, "COLOR_0");
    const tinygltf::Accessor* accessor = elementAt(document.model().accessors, index);
    if (accessor == nullptr)
        return;
    const int step = accessor->type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    std::string ignored;
    const auto values = readFloats(document, index, step, ignored);
    if (!values || values->size() != std::size_t(step) * out.positions.size())
        return;
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        const float* c = values->data() + i * std::size_t(step);
        out.colors.push_back(glm::clamp(glm::vec3(c[0], c[1], c[2]), 0.0F, 1.0F));
    }
}

/// Values of an attribute, as many as there are vertices; empty when it has none such.
std::vector<float> readAttribute(const Document& document, const tinygltf::Primitive& primitive,
                                 const char* name, int components, std::size_t vertices) {
    const int index = attributeOf(primitive, name);
    std::string ignored;
    auto values = index >= 0 ? readFloats(document, index, components, ignored) : std::nullopt;
    if (!values || values->size() != std::size_t(components) * vertices)
        return {};
    return std::move(*values);
}

/// The attribute that tells the feature of a vertex.
std::string featureAttribute(const tinygltf::Primitive& primitive) {
    const tinygltf::Value& sets =
        member(extensionOf(primitive.extensions, "EXT_mesh_features"), "featureIds");
    if (sets.IsArray() && sets.ArrayLen() > 0) {
        if (const int set = indexIn(sets.Get(0), "attribute"); set >= 0)
            return "_FEATURE_ID_" + std::to_string(set);
    }
    return attributeOf(primitive, "_BATCHID") >= 0 ? "_BATCHID" : "BATCHID";
}

bool readTriangles(const Document& document, const tinygltf::Primitive& primitive, Primitive& out,
                   std::string& problem) {
    const int index = attributeOf(primitive, Document::kIndices);
    const auto indices = index != -1 ? readIndices(document, index, problem) : std::nullopt;
    if (index != -1 && !indices)
        return false;
    const std::size_t count =
        trianglesOf(indices ? indices->size() : out.positions.size(), primitive.mode);
    out.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::uvec3 t = cornersOf(i, primitive.mode);
        addTriangle(indices ? glm::uvec3((*indices)[t.x], (*indices)[t.y], (*indices)[t.z]) : t,
                    out);
    }
    return true;
}

std::optional<Primitive> readPlain(const Document& document, const tinygltf::Primitive& primitive,
                                   std::string& problem) {
    const int positions = attributeOf(primitive, "POSITION");
    problem = "it has no positions";
    auto values = positions >= 0 ? readFloats(document, positions, 3, problem) : std::nullopt;
    if (!values)
        return std::nullopt;
    Primitive out;
    out.positions = asVectors(*values);
    values.reset();  // a third of a gigabyte where a file has ten million triangles
    const std::size_t vertices = out.positions.size();
    out.normals = asVectors(readAttribute(document, primitive, "NORMAL", 3, vertices));
    out.uv = readAttribute(document, primitive, "TEXCOORD_0", 2, vertices);
    out.uv1 = readAttribute(document, primitive, "TEXCOORD_1", 2, vertices);
    out.features =
        readAttribute(document, primitive, featureAttribute(primitive).c_str(), 1, vertices);
    readColors(document, primitive, out);
    if (!readTriangles(document, primitive, out, problem))
        return std::nullopt;
    return out;
}

}  // namespace

void addTriangle(const glm::uvec3& t, Primitive& out) {
    const auto isFinite = [&](std::uint32_t v) {
        constexpr float kMost = 1e15F;
        const glm::vec3& p = out.positions[v];
        return std::abs(p.x) < kMost && std::abs(p.y) < kMost && std::abs(p.z) < kMost;
    };
    if (std::max({t.x, t.y, t.z}) >= out.positions.size() || !isFinite(t.x) || !isFinite(t.y) ||
        !isFinite(t.z)) {
        ++out.outOfRange;
    } else if (t.x != t.y && t.y != t.z && t.z != t.x) {
        out.triangles.push_back(t);
    }
}

std::size_t countTriangles(const Document& document, const tinygltf::Primitive& primitive) {
    int corners = attributeOf(primitive, Document::kIndices);
    if (corners == -1)
        corners = attributeOf(primitive, "POSITION");
    const tinygltf::Accessor* accessor = elementAt(document.model().accessors, corners);
    return trianglesOf(accessor != nullptr ? accessor->count : 0, primitive.mode);
}

std::optional<Primitive> readPrimitive(const Document& document,
                                       const tinygltf::Primitive& primitive, std::string& problem) {
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        problem = "lines and points are not shown";
        return std::nullopt;
    }
    const bool packed = extensionOf(primitive.extensions, "KHR_draco_mesh_compression").IsObject();
    auto out =
        packed ? readDraco(document, primitive, problem) : readPlain(document, primitive, problem);
    if (!out)
        return std::nullopt;
    out->material = primitive.material;
    // Primitives may share an accessor that is far larger than what each of them shows.
    if (out->positions.size() > 3 * out->triangles.size())
        compact(*out);
    return out;
}

}  // namespace reflet::gltf
