// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <algorithm>
#include <draco/compression/decode.h>

namespace reflet::gltf {

using nlohmann::json;

namespace {

/// An attribute of the compressed mesh by its id in the extension, point by point.
std::vector<float> attributeOf(const draco::Mesh& mesh, const json& ids, const char* key,
                               int components) {
    const auto id = wholeNumber(ids, key);
    if (!id)
        return {};
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(std::uint32_t(*id));
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

}  // namespace

std::optional<Primitive> readDraco(const Document& document, const json& primitive,
                                   std::string& problem) {
    const json& extension = member(member(primitive, "extensions"), "KHR_draco_mesh_compression");
    const auto bytes = document.view(wholeNumber(extension, "bufferView").value_or(SIZE_MAX));
    problem = "its compressed mesh cannot be read";
    if (!bytes)
        return std::nullopt;
    draco::DecoderBuffer buffer;
    buffer.Init(bytes->data(), bytes->size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    // A mesh of more than its file said would have passed by the limit on triangles.
    if (!decoded.ok() || decoded.value()->num_faces() > countTriangles(document, primitive)) {
        return std::nullopt;
    }
    const draco::Mesh& mesh = *decoded.value();
    const json& ids = member(extension, "attributes");
    const std::vector<float> positions = attributeOf(mesh, ids, "POSITION", 3);
    if (positions.empty())
        return std::nullopt;
    Primitive out;
    const auto vectors = [](const std::vector<float>& values) {
        std::vector<glm::vec3> list(values.size() / 3);
        for (std::size_t i = 0; i < list.size(); ++i)
            list[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        return list;
    };
    out.positions = vectors(positions);
    out.normals = vectors(attributeOf(mesh, ids, "NORMAL", 3));
    out.uv = attributeOf(mesh, ids, "TEXCOORD_0", 2);
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh.face(f);
        const glm::uvec3 t(face[0].value(), face[1].value(), face[2].value());
        if (std::max({t.x, t.y, t.z}) >= out.positions.size()) {
            ++out.outOfRange;
        } else if (t.x != t.y && t.y != t.z && t.z != t.x) {
            out.triangles.push_back(t);
        }
    }
    return out;
}

}  // namespace reflet::gltf
