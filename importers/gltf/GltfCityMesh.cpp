// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfCityMesh.h"

#include "importers/common/Identifiers.h"
#include "importers/gltf/GltfCityTextures.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace reflet::gltf {

namespace {

constexpr std::size_t kMostBytes = std::size_t(2) << 30;  // of all buffers together
constexpr std::size_t kMostNames = 10'000'000;
constexpr std::size_t kLongestName = 200;
constexpr float kShades = 31.0F;  // of a colour channel

/// The numbers of a buffer view as unsigned integers of `bytes` bytes.
std::vector<std::uint64_t> unsignedNumbers(std::string_view view, std::size_t bytes) {
    std::vector<std::uint64_t> numbers(view.size() / bytes);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        std::memcpy(&numbers[i], view.data() + i * bytes, bytes);
    return numbers;
}

/// A column of strings of a property table (EXT_structural_metadata).
std::vector<std::string> strings(const Document& document, const tinygltf::Value& property,
                                 std::size_t count) {
    const auto values = document.view(indexIn(property, "values"));
    const auto offsetBytes = document.view(indexIn(property, "stringOffsets"));
    if (!values || !offsetBytes)
        return {};
    const tinygltf::Value& type = member(property, "stringOffsetType");
    const std::string name = type.IsString() ? type.Get<std::string>() : "UINT32";
    const std::size_t size =
        name == "UINT8" ? 1 : (name == "UINT16" ? 2 : (name == "UINT64" ? 8 : 4));
    const auto offsets = unsignedNumbers(*offsetBytes, size);
    std::vector<std::string> out;
    for (std::size_t i = 0; i < std::min(count, kMostNames) && i + 1 < offsets.size(); ++i) {
        const bool sound = offsets[i] <= offsets[i + 1] && offsets[i + 1] <= values->size();
        out.emplace_back(
            sound ? values->substr(offsets[i],
                                   std::min<std::size_t>(offsets[i + 1] - offsets[i], kLongestName))
                  : std::string_view());
    }
    return out;
}

/// The property that names the features, if the table of the first primitive that has one does.
std::vector<std::string> featureNames(const Document& document) {
    const tinygltf::Value& tables = member(
        extensionOf(document.model().extensions, "EXT_structural_metadata"), "propertyTables");
    if (!tables.IsArray() || tables.ArrayLen() == 0)
        return {};
    const tinygltf::Value& table = tables.Get(0);
    const tinygltf::Value& properties = member(table, "properties");
    const int count = indexIn(table, "count");
    if (!properties.IsObject() || count < 0)
        return {};
    const std::string key = importers::bestIdentifier(properties.Keys());
    if (!key.empty())
        return strings(document, properties.Get(key), std::size_t(count));
    for (const std::string& name : properties.Keys()) {
        auto values = strings(document, properties.Get(name), std::size_t(count));
        if (!values.empty())
            return values;
    }
    return {};
}

CityMaterial cityMaterial(const Look& look, const glm::vec3& colour) {
    CityMaterial material;
    material.name = look.material.name;
    material.diffuse = colour;
    // What is seen where the image is missing: most are white, which means the image alone.
    constexpr float kPhotographed = 0.6F;
    material.tint = colour;
    if (look.base.texture >= 0)
        material.diffuse = kPhotographed * colour;
    // An image that glows here and there would light up all of the surface.
    if (look.emissive.texture < 0)
        material.emission = look.material.emission;
    material.shininess = 1.0F - look.material.roughness;
    material.transparency = 1.0F - look.material.alpha;
    return material;
}

/// Gathers nodes in one mesh.
class Reader {
public:
    Reader(const Document& document, ImagePlaces& places, std::size_t maxTriangles)
        : m_document(document), m_maxTriangles(maxTriangles), m_textures(document, places, m_out) {}

    Result<void> addMesh(const Placed& placed) {
        const tinygltf::Mesh& mesh = m_document.model().meshes[std::size_t(placed.mesh)];
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (m_out.triangles.size() + countTriangles(m_document, primitive) > m_maxTriangles)
                return fail(ErrorCode::ResourceLimit,
                            fmt::format("has more than {} triangles", m_maxTriangles),
                            m_document.path().string(), "Choose a part of the city.");
            std::string problem;
            const auto read = readPrimitive(m_document, primitive, problem);
            if (read)
                addPrimitive(*read, placed, mesh.name);
            else
                remark(m_out.remarks, Severity::Warning, "primitive-skipped", placed.name,
                       problem + "; it was left out");
        }
        return {};
    }

    CityMesh result() && {
        m_textures.tell();
        return std::move(m_out);
    }

private:
    void addPrimitive(const Primitive& primitive, const Placed& placed,
                      const std::string& meshName) {
        const auto first = std::uint32_t(m_out.vertices.size());
        for (const glm::vec3& p : primitive.positions)
            m_out.vertices.emplace_back(
                glm::dvec3(placed.file_from_mesh * glm::dvec4(glm::dvec3(p), 1.0)));
        CityMesh::Part part;
        const std::string node = placed.name.substr(placed.name.rfind('/') + 1);
        part.name = node.empty() ? meshName : node;
        part.firstTriangle = std::uint32_t(m_out.triangles.size());
        part.triangleCount = std::uint32_t(primitive.triangles.size());
        const Look& look = lookOf(primitive.material);
        const std::uint32_t texture = m_textures.of(primitive.material, look);
        // A mirrored node turns its triangles round.
        const bool mirrored = glm::determinant(glm::dmat3(placed.file_from_mesh)) < 0.0;
        for (const glm::uvec3& t : primitive.triangles) {
            CityMesh::Triangle triangle;
            triangle.vertex = {first + t.x, first + (mirrored ? t.z : t.y),
                               first + (mirrored ? t.y : t.z)};
            const auto uv =
                texture == kNone ? std::nullopt : m_textures.corners(primitive, t, look.base);
            triangle.texture = uv ? texture : kNone;
            triangle.material = materialOf(primitive, t, look);
            if (primitive.features.size() == primitive.positions.size())
                triangle.feature = featureOf(primitive.features[t.x]);
            m_out.triangles.push_back(triangle);
            if (uv) {
                m_out.uv.resize(m_out.triangles.size());
                m_out.uv.back() = *uv;
                if (mirrored)
                    std::swap(m_out.uv.back()[1], m_out.uv.back()[2]);
            }
        }
        if (!m_out.uv.empty())
            m_out.uv.resize(m_out.triangles.size());
        m_out.outOfRange += primitive.outOfRange;
        m_out.parts.push_back(std::move(part));
    }

    static std::uint32_t featureOf(float number) {
        constexpr float kMost = 16'777'216.0F;  // that float counts exactly
        return number >= 0.0F && number < kMost ? std::uint32_t(number) : CityMesh::kNoFeature;
    }

    const Look& lookOf(int material) {
        const auto known = m_looks.find(material);
        if (known != m_looks.end())
            return known->second;
        static const tinygltf::Material plain;
        const tinygltf::Material* source = elementAt(m_document.model().materials, material);
        Look look = readLook(source != nullptr ? *source : plain, material, nullptr);
        if (source == nullptr)
            look.material.color = glm::vec3(0.6F);  // nothing is said of it
        return m_looks.emplace(material, std::move(look)).first->second;
    }

    /// Colours of vertices are one for each triangle, and rounded as they are seen, so that a city
    /// has thousands of materials and not millions.
    std::uint32_t materialOf(const Primitive& primitive, const glm::uvec3& t, const Look& look) {
        glm::vec3 colour = look.material.color;
        const bool exact = primitive.colors.empty();
        if (!exact)
            colour *=
                (primitive.colors[t.x] + primitive.colors[t.y] + primitive.colors[t.z]) / 3.0F;
        const glm::vec3 shade = glm::round(glm::sqrt(glm::clamp(colour, 0.0F, 1.0F)) * kShades);
        const std::array<int, 4> key{primitive.material, exact ? -1 : int(shade.x), int(shade.y),
                                     int(shade.z)};
        const auto next = std::uint32_t(m_out.materials.size());
        const auto [known, isNew] = m_materials.try_emplace(key, next);
        if (isNew) {
            const glm::vec3 root = shade / kShades;
            m_out.materials.push_back(cityMaterial(look, exact ? colour : root * root));
        }
        return known->second;
    }

    const Document& m_document;
    std::size_t m_maxTriangles;
    CityMesh m_out;
    CityTextures m_textures;
    std::map<int, Look> m_looks;
    std::map<std::array<int, 4>, std::uint32_t> m_materials;
};

/// Where some nodes are placed on the Earth (EXT_georeference), others lie at its centre, unless
/// the whole file has a reference system.
void leaveOutStrays(const Document& document, std::vector<Placed>& placed,
                    std::vector<Diagnostic>& remarks) {
    const auto onEarth = [](const Placed& p) { return p.onEarth; };
    if (std::none_of(placed.begin(), placed.end(), onEarth) ||
        extensionOf(document.model().extensions, "EXT_geospatial_crs").IsObject())
        return;
    const std::size_t strays = std::erase_if(placed, [](const Placed& p) { return !p.onEarth; });
    if (strays > 0)
        remark(
            remarks, Severity::Warning, "node-elsewhere", "",
            fmt::format("{} meshes have no place on the Earth, which others have; they were left "
                        "out",
                        strays),
            "Place them too (EXT_georeference).");
}

/// The nodes that stand once as one mesh, then each that is instanced.
Result<std::vector<CityMesh>> meshesOf(const Document& document, std::size_t maxTriangles,
                                       const JobContext& job) {
    std::vector<CityMesh> meshes;
    std::vector<Diagnostic> remarks = document.remarks();
    ImagePlaces places;
    Reader whole(document, places, maxTriangles);
    std::size_t instanced = 0;
    std::vector<Placed> all = placedMeshes(document, remarks, Earth::Used);
    leaveOutStrays(document, all, remarks);
    for (Placed& placed : all) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        if (!placed.instanced) {
            if (auto added = whole.addMesh(placed); !added)
                return tl::unexpected(added.error());
            continue;
        }
        const glm::dmat4 file_from_node = std::exchange(placed.file_from_mesh, glm::dmat4(1.0));
        Reader own(document, places, (maxTriangles - instanced) / placed.instances.size());
        if (auto added = own.addMesh(placed); !added)
            return tl::unexpected(added.error());
        CityMesh mesh = std::move(own).result();
        mesh.instanced = true;
        mesh.file_from_mesh = std::move(placed.instances);
        for (glm::dmat4& place : mesh.file_from_mesh)
            place = file_from_node * place;
        instanced += mesh.triangles.size() * mesh.file_from_mesh.size();
        meshes.push_back(std::move(mesh));
    }
    meshes.insert(meshes.begin(), std::move(whole).result());
    auto& first = meshes.front().remarks;
    first.insert(first.begin(), remarks.begin(), remarks.end());
    return meshes;
}

}  // namespace

Result<std::vector<CityMesh>> readCityMeshes(std::string_view bytes,
                                             const std::filesystem::path& path,
                                             std::size_t maxTriangles, const JobContext& job) {
    const auto document = Document::read(bytes, path, kMostBytes);
    if (!document)
        return tl::unexpected(document.error());
    auto meshes = meshesOf(*document, maxTriangles, job);
    if (!meshes)
        return meshes;
    const auto names = featureNames(*document);
    const auto georeference = georeferenceOf(*document, meshes->front().remarks);
    const auto center = numbers(extensionOf(document->model().extensions, "CESIUM_RTC"), "center");
    for (CityMesh& mesh : *meshes) {
        mesh.featureNames = names;
        mesh.georeference = georeference;
        if (center.size() == 3)
            mesh.rtcCenter = glm::dvec3(center[0], center[1], center[2]);
    }
    return meshes;
}

}  // namespace reflet::gltf
