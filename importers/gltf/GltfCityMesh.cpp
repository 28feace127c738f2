// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfCityMesh.h"

#include "core/base/Files.h"
#include "importers/common/Identifiers.h"
#include "importers/gltf/GltfPaint.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace reflet::gltf {

using nlohmann::json;

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

std::string textIn(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// {"crs": "EPSG:25832", "vertical": "EPSG:7837", "origin": [east, north, up], "upAxis": "Y"}
std::optional<Georeference> georeferenceIn(const json& object) {
    Georeference out;
    if (!object.is_object() || (out.crs = textIn(object, "crs")).empty())
        return std::nullopt;
    if (const std::string vertical = textIn(object, "vertical"); vertical.starts_with("EPSG:"))
        out.crs += "+" + vertical.substr(5);
    const std::string up = textIn(object, "upAxis");
    out.zUp = up == "Z" || up == "z";
    const auto origin = object.find("origin");
    if (origin == object.end() || !origin->is_array() || origin->size() != 3)
        return out;
    for (int i = 0; i < 3; ++i) {
        const json& value = (*origin)[std::size_t(i)];
        out.origin[i] = value.is_number() ? value.get<double>() : 0.0;
    }
    return out;
}

std::optional<Georeference> georeferenceOf(const Document& document) {
    if (const auto& said = member(document.model().asset.extras, "georeference"); said.IsObject()) {
        json own{{"origin", numbers(said, "origin")}};
        for (const char* key : {"crs", "vertical", "upAxis"}) {
            if (member(said, key).IsString())
                own[key] = member(said, key).Get<std::string>();
        }
        return georeferenceIn(own);
    }
    constexpr std::size_t kLongest = std::size_t(64) << 10;
    std::filesystem::path beside = document.path();
    beside += ".geo.json";
    const auto text = readFile(beside, kLongest);
    return text ? georeferenceIn(json::parse(*text, nullptr, false)) : std::nullopt;
}

CityMaterial cityMaterial(const Look& look, const glm::vec3& colour) {
    CityMaterial material;
    material.name = look.material.name;
    material.diffuse = colour;
    material.emission = look.material.emission;
    material.shininess = 1.0F - look.material.roughness;
    material.transparency = 1.0F - look.material.alpha;
    return material;
}

class Reader {
public:
    Reader(const Document& document, std::size_t maxTriangles, const JobContext& job)
        : m_document(document),
          m_maxTriangles(maxTriangles),
          m_job(job),
          m_images(document, m_out.remarks) {}

    Result<CityMesh> run() {
        m_out.remarks = m_document.remarks();
        m_out.featureNames = featureNames(m_document);
        m_out.georeference = georeferenceOf(m_document);
        const auto center =
            numbers(extensionOf(m_document.model().extensions, "CESIUM_RTC"), "center");
        if (center.size() == 3)
            m_out.rtcCenter = glm::dvec3(center[0], center[1], center[2]);
        for (const Placed& placed : placedMeshes(m_document, m_out.remarks)) {
            if (m_job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            if (auto added = addMesh(placed); !added)
                return tl::unexpected(added.error());
        }
        return std::move(m_out);
    }

private:
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
        // A mirrored node turns its triangles round.
        const bool mirrored = glm::determinant(glm::dmat3(placed.file_from_mesh)) < 0.0;
        for (const glm::uvec3& t : primitive.triangles) {
            CityMesh::Triangle triangle;
            triangle.vertex = {first + t.x, first + (mirrored ? t.z : t.y),
                               first + (mirrored ? t.y : t.z)};
            triangle.material = materialOf(primitive, t, look);
            if (primitive.features.size() == primitive.positions.size())
                triangle.feature = featureOf(primitive.features[t.x]);
            m_out.triangles.push_back(triangle);
        }
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
        Look look = readLook(source != nullptr ? *source : plain, material, m_images);
        if (source == nullptr)
            look.material.color = glm::vec3(0.6F);  // nothing is said of it
        return m_looks.emplace(material, std::move(look)).first->second;
    }

    /// The colour in the middle of a triangle and half way to its corners.
    glm::vec3 colourOf(const Primitive& primitive, const glm::uvec3& t, const Look& look) {
        glm::vec3 colour = look.material.color;
        if (!primitive.colors.empty())
            colour *=
                (primitive.colors[t.x] + primitive.colors[t.y] + primitive.colors[t.z]) / 3.0F;
        const std::vector<float>& uv = look.base.set == 1 ? primitive.uv1 : primitive.uv;
        if (look.base.image == nullptr || uv.size() != 2 * primitive.positions.size())
            return colour;
        m_out.textures = true;
        const auto corner = [&](std::uint32_t v) {
            return glm::vec2(uv[2 * std::size_t(v)], uv[2 * std::size_t(v) + 1]);
        };
        const std::array<glm::vec2, 3> corners{corner(t.x), corner(t.y), corner(t.z)};
        const glm::vec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0F;
        const auto sample = [&](const glm::vec2& at) {
            const glm::vec2 place = look.base.at(at);
            const bool sound = std::abs(place.x) < 1e6F && std::abs(place.y) < 1e6F;
            return sound ? look.base.image->sample(place.x, place.y) : glm::vec3(0.6F);
        };
        glm::vec3 sum = sample(middle);
        for (const glm::vec2& c : corners)
            sum += sample(0.5F * (middle + c));
        return colour * sum / 4.0F;
    }

    /// Colours of textures are rounded, as they are seen, so that a city has thousands of
    /// materials and not millions.
    std::uint32_t materialOf(const Primitive& primitive, const glm::uvec3& t, const Look& look) {
        const glm::vec3 colour = glm::clamp(colourOf(primitive, t, look), 0.0F, 1.0F);
        const glm::vec3 shade = glm::round(glm::sqrt(colour) * kShades);
        const bool exact = look.base.image == nullptr && primitive.colors.empty();
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
    const JobContext& m_job;
    CityMesh m_out;
    Images m_images;
    std::map<int, Look> m_looks;
    std::map<std::array<int, 4>, std::uint32_t> m_materials;
};

}  // namespace

Result<CityMesh> readCityMesh(std::string_view bytes, const std::filesystem::path& path,
                              std::size_t maxTriangles, const JobContext& job) {
    const auto document = Document::read(bytes, path, kMostBytes);
    if (!document)
        return tl::unexpected(document.error());
    return Reader(*document, maxTriangles, job).run();
}

}  // namespace reflet::gltf
