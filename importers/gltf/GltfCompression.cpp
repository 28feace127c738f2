// SPDX-License-Identifier: GPL-3.0-or-later
// KHR_draco_mesh_compression and EXT_meshopt_compression.
#include "importers/gltf/GltfDocument.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <draco/compression/decode.h>
#include <meshoptimizer.h>

namespace reflet::gltf {

namespace {

// The best that meshopt's encodings reach is 64 bytes from one (a vertex plane of zeros); beyond
// twice that a count is a lie, and nothing is allocated for it.
constexpr std::size_t kMostFromAByte = 128;

/// An attribute of the compressed mesh by its id in the extension, point by point.
std::vector<float> attributeOf(const draco::Mesh& mesh, const tinygltf::Value& ids, const char* key,
                               int components) {
    const int id = indexIn(ids, key);
    if (id < 0)
        return {};
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(std::uint32_t(id));
    if (attribute == nullptr || attribute->num_components() != components)
        return {};
    std::vector<float> values(std::size_t(mesh.num_points()) * std::size_t(components), 0.0F);
    for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
        attribute->ConvertValue<float>(
            attribute->mapped_index(p), std::int8_t(components),
            values.data() + std::size_t(p.value()) * std::size_t(components));
    }
    return values;
}

std::vector<glm::vec3> asVectors(const std::vector<float>& values, std::size_t components) {
    std::vector<glm::vec3> list(values.size() / components);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const float* v = values.data() + i * components;
        list[i] = {v[0], v[1], v[2]};
    }
    return list;
}

std::vector<glm::vec3> colorsOf(const draco::Mesh& mesh, const tinygltf::Value& ids) {
    std::vector<glm::vec3> colors = asVectors(attributeOf(mesh, ids, "COLOR_0", 3), 3);
    if (colors.empty())
        colors = asVectors(attributeOf(mesh, ids, "COLOR_0", 4), 4);
    for (glm::vec3& c : colors)
        c = glm::clamp(c, 0.0F, 1.0F);
    return colors;
}

bool applyFilter(const std::string& filter, std::string& bytes, std::size_t count,
                 std::size_t stride) {
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (filter == "QUATERNION" && stride == 8) {
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (filter == "EXPONENTIAL" && stride % 4 == 0) {
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    } else {
        return filter.empty() || filter == "NONE";
    }
    return true;
}

std::string textIn(const tinygltf::Value& object, const char* key) {
    const tinygltf::Value& value = member(object, key);
    return value.IsString() ? value.Get<std::string>() : std::string();
}

}  // namespace

std::optional<Primitive> readDraco(const Document& document, const tinygltf::Primitive& primitive,
                                   std::string& problem) {
    const tinygltf::Value& extension =
        extensionOf(primitive.extensions, "KHR_draco_mesh_compression");
    const auto bytes = document.view(indexIn(extension, "bufferView"));
    problem = "its compressed mesh cannot be read";
    if (!bytes)
        return std::nullopt;
    draco::DecoderBuffer buffer;
    buffer.Init(bytes->data(), bytes->size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    // A mesh of more than its file said would have passed by the limit on triangles.
    if (!decoded.ok() || decoded.value()->num_faces() > countTriangles(document, primitive))
        return std::nullopt;
    const draco::Mesh& mesh = *decoded.value();
    const tinygltf::Value& ids = member(extension, "attributes");
    Primitive out;
    out.positions = asVectors(attributeOf(mesh, ids, "POSITION", 3), 3);
    if (out.positions.empty())
        return std::nullopt;
    out.normals = asVectors(attributeOf(mesh, ids, "NORMAL", 3), 3);
    out.uv = attributeOf(mesh, ids, "TEXCOORD_0", 2);
    out.uv1 = attributeOf(mesh, ids, "TEXCOORD_1", 2);
    out.colors = colorsOf(mesh, ids);
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh.face(f);
        addTriangle({face[0].value(), face[1].value(), face[2].value()}, out);
    }
    return out;
}

/// The bytes that a compressed view stands for; nullopt when they cannot be unpacked.
std::optional<std::string> Document::unpackView(const tinygltf::Value& extension,
                                                std::size_t maxBytes) const {
    const int count = indexIn(extension, "count");
    const int stride = indexIn(extension, "byteStride");
    const auto packed = range(indexIn(extension, "buffer"),
                              std::size_t(std::max(indexIn(extension, "byteOffset"), 0)),
                              std::size_t(std::max(indexIn(extension, "byteLength"), 0)));
    if (!packed || count < 1 || stride < 1 || stride > 256)
        return std::nullopt;
    const std::size_t n = std::size_t(count);
    const std::size_t size = std::size_t(stride);
    if (n * size > maxBytes || n * size > packed->size() * kMostFromAByte)
        return std::nullopt;
    std::string out(n * size, '\0');
    const auto* data = reinterpret_cast<const unsigned char*>(packed->data());
    const std::string mode = textIn(extension, "mode");
    const bool indices = size == 2 || size == 4;
    int failed = 1;
    if (mode == "ATTRIBUTES" && size % 4 == 0) {
        failed = meshopt_decodeVertexBuffer(out.data(), n, size, data, packed->size());
    } else if (mode == "TRIANGLES" && indices && n % 3 == 0) {
        failed = meshopt_decodeIndexBuffer(out.data(), n, size, data, packed->size());
    } else if (mode == "INDICES" && indices) {
        failed = meshopt_decodeIndexSequence(out.data(), n, size, data, packed->size());
    }
    if (failed != 0 || !applyFilter(textIn(extension, "filter"), out, n, size))
        return std::nullopt;
    return out;
}

void Document::unpackViews(std::size_t maxBytes) {
    std::size_t left = maxBytes;
    for (std::size_t i = 0; i < m_model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = m_model.bufferViews[i];
        const tinygltf::Value& extension = extensionOf(view.extensions, "EXT_meshopt_compression");
        if (!extension.IsObject())
            continue;
        auto bytes = unpackView(extension, left);
        view.buffer = -1;
        if (!bytes) {
            remark(m_remarks, Severity::Warning, "view-unreadable", fmt::format("bufferView {}", i),
                   "its EXT_meshopt_compression cannot be unpacked; left out",
                   "Export the vehicle without meshopt compression.");
            continue;
        }
        left -= bytes->size();
        view.buffer = int(m_buffers.size());
        view.byteOffset = 0;
        view.byteLength = bytes->size();
        view.byteStride = view.byteStride == 0 ? 0 : std::size_t(indexIn(extension, "byteStride"));
        m_buffers.push_back({std::move(*bytes), false});
    }
}

}  // namespace reflet::gltf
