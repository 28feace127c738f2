// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfOutline.h"

#include "core/base/Files.h"
#include "importers/gltf/GltfDocument.h"
#include "importers/gltf/GltfGeoreference.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>

namespace reflet::gltf {

namespace {

constexpr std::size_t kLargestText = std::size_t(256) << 20;

std::size_t word(const char* at) {
    std::uint32_t value = 0;
    std::memcpy(&value, at, sizeof(value));
    return value;
}

/// The JSON of a file: all of a .gltf, the first chunk of a .glb, also within a .b3dm.
Result<std::string> descriptionOf(const std::filesystem::path& file) {
    constexpr std::size_t kGlbHead = 20, kTableHead = 28;
    std::ifstream stream(file, std::ios::binary);
    std::array<char, kTableHead> head{};
    stream.read(head.data(), kTableHead);
    const std::string_view magic(head.data(), 4);
    std::size_t begin = 0;
    if (magic == "b3dm") {
        begin = kTableHead;
        for (int i = 0; i < 4; ++i)
            begin += word(head.data() + 12 + 4 * i);
        stream.clear();
        stream.seekg(std::streamoff(begin));
        stream.read(head.data(), kGlbHead);
    } else if (magic != "glTF") {
        const std::size_t text = std::string_view(head.data(), head.size()).find('{');
        if (text == std::string_view::npos || magic == "i3dm" || magic == "cmpt")
            return fail(ErrorCode::Refused, "is no glTF file", file.string());
        return readFile(file, kLargestText);
    }
    const std::size_t length = word(head.data() + 12);
    std::string out(std::min(length, kLargestText), '\0');
    stream.clear();
    stream.seekg(std::streamoff(begin + kGlbHead));
    if (std::string_view(head.data(), 4) != "glTF" || length > kLargestText ||
        !stream.read(out.data(), std::streamsize(length)))
        return fail(ErrorCode::Unreadable, "is cut off within its description", file.string(),
                    "Ask for the file again.");
    return out;
}

/// Places of a mesh: of an instanced node as many as an attribute counts.
std::size_t countPlaces(const tinygltf::Model& model, const tinygltf::Node& node) {
    const auto& attributes =
        member(extensionOf(node.extensions, "EXT_mesh_gpu_instancing"), "attributes");
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (const auto* accessor = elementAt(model.accessors, indexIn(attributes, name)))
            return accessor->count;
    }
    return 1;
}

void addBounds(const Document& document, const Placed& placed, Box& bounds) {
    const tinygltf::Model& model = document.model();
    for (const auto& primitive : model.meshes[std::size_t(placed.mesh)].primitives) {
        const auto positions = primitive.attributes.find("POSITION");
        const tinygltf::Accessor* accessor = positions == primitive.attributes.end()
                                                 ? nullptr
                                                 : elementAt(model.accessors, positions->second);
        if (accessor == nullptr || accessor->minValues.size() != 3 ||
            accessor->maxValues.size() != 3)
            continue;
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec4 p(1.0);
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = ((corner >> axis) & 1) != 0 ? accessor->maxValues[std::size_t(axis)]
                                                      : accessor->minValues[std::size_t(axis)];
            bounds.add(glm::dvec3(placed.file_from_mesh * p));
        }
    }
}

}  // namespace

Result<Outline> readOutline(const std::filesystem::path& file) {
    const auto text = descriptionOf(file);
    if (!text)
        return tl::unexpected(text.error());
    const auto document = Document::readDescription(*text, file);
    if (!document)
        return tl::unexpected(document.error());
    const tinygltf::Model& model = document->model();
    Outline out;
    for (const tinygltf::Node& node : model.nodes) {
        const tinygltf::Mesh* mesh = elementAt(model.meshes, node.mesh);
        std::size_t triangles = 0;
        for (std::size_t i = 0; mesh != nullptr && i < mesh->primitives.size(); ++i)
            triangles += countTriangles(*document, mesh->primitives[i]);
        out.triangles += triangles * countPlaces(model, node);
    }
    std::vector<Diagnostic> ignored;
    for (const Placed& placed : placedMeshes(*document, ignored, Earth::Ignored))
        addBounds(*document, placed, out.bounds);
    out.georeferenced = georeferenceOf(*document, ignored).has_value() ||
                        extensionOf(model.extensions, "CESIUM_RTC").IsObject() ||
                        hasGeoreferenceBeside(file);
    return out;
}

}  // namespace reflet::gltf
