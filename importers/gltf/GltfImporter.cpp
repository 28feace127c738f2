// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfImporter.h"

#include "core/base/Files.h"
#include "importers/gltf/GltfPaint.h"

#include <fmt/format.h>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

using namespace gltf;

namespace {

constexpr std::size_t kMostBytes = std::size_t(2) << 30;  // of all buffers together
constexpr float kCrease = 0.7F;  // radians: sharper edges stay sharp where normals are made
constexpr double kFinestShare = 1.0 / 300.0;  // of the model's size: finest piece of a texture
constexpr std::size_t kFewestTriangles = 12;  // that a primitive is simplified to
constexpr std::size_t kFewTriangles = 64;     // of a primitive: not worth simplifying
constexpr std::size_t kMostMaterials = 60'000;

class Importer {
public:
    Importer(const Document& document, const GltfOptions& options, const JobContext& job)
        : m_document(document),
          m_options(options),
          m_job(job),
          m_images(document, m_out.diagnostics) {}

    Result<Imported<GltfModel>> run() {
        GltfModel& model = m_out.value;
        model.name = m_document.path().stem().string();
        model.fileMaterials = m_document.model().materials.size();
        model.nodes = m_document.model().nodes.size();
        model.images = m_document.imageCount();
        m_out.diagnostics = m_document.remarks();
        m_placed = oneByOne(placedMeshes(m_document, m_out.diagnostics, Earth::Ignored));
        for (const Placed& placed : m_placed) {
            for (const tinygltf::Primitive& primitive : primitivesOf(placed.mesh))
                model.fileTriangles += countTriangles(m_document, primitive);
        }
        if (model.fileTriangles > m_options.maxTriangles)
            return tooMany("has", model.fileTriangles, m_options.maxTriangles);
        if (!measure())
            return fail(ErrorCode::Cancelled, "cancelled", m_document.path().string());
        for (const Placed& placed : m_placed) {
            if (m_job.cancelled())
                return fail(ErrorCode::Cancelled, "cancelled", m_document.path().string());
            addNode(placed);
            if (model.triangles.size() > m_options.mostLeft)
                return tooMany("keeps, in many small parts,", model.triangles.size(),
                               m_options.mostLeft);
        }
        if (model.triangles.empty())
            return nothing();
        closePalettes();
        model.imagesRead = m_images.readCount();
        for (const glm::vec3& p : model.positions)
            model.bounds.add(glm::dvec3(p));
        if (!(glm::length(model.bounds.size()) > 0.0))
            return nothing();
        return std::move(m_out);
    }

private:
    [[nodiscard]] tl::unexpected<Error> tooMany(const char* verb, std::size_t triangles,
                                                std::size_t most) const {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("{} {} triangles, more than {}", verb, triangles, most),
                    m_document.path().string(),
                    "Reduce it in a modelling program (in Blender: the Decimate modifier, on "
                    "objects that are joined); 100000 are plenty for a vehicle.");
    }

    [[nodiscard]] Result<Imported<GltfModel>> nothing() const {
        std::string why;
        for (const Diagnostic& d : m_out.diagnostics) {
            if (d.code != "image-unreadable") {
                why = fmt::format(" ({}: {})", d.object, d.text);
                break;
            }
        }
        return fail(ErrorCode::Refused, "holds no triangle that can be shown" + why,
                    m_document.path().string(), "Export the vehicle with its meshes, as .glb.");
    }

    /// Instances as meshes of their own.
    static std::vector<Placed> oneByOne(std::vector<Placed> placed) {
        std::vector<Placed> out;
        for (const Placed& node : placed) {
            if (!node.instanced)
                out.push_back(node);
            for (const glm::dmat4& instance : node.instances)
                out.push_back({node.mesh, node.file_from_mesh * instance, node.name});
        }
        return out;
    }

    [[nodiscard]] const std::vector<tinygltf::Primitive>& primitivesOf(int mesh) const {
        return m_document.model().meshes[std::size_t(mesh)].primitives;
    }

    /// A primitive read once; null when it cannot be shown, which is told once.
    const Primitive* primitiveOf(int mesh, std::size_t index) {
        const auto [known, isNew] = m_primitives.try_emplace({mesh, index});
        if (!isNew)
            return known->second ? &*known->second : nullptr;
        std::string problem;
        const std::string object = fmt::format("mesh {} primitive {}", mesh, index);
        known->second = readPrimitive(m_document, primitivesOf(mesh)[index], problem);
        if (!known->second) {
            ++m_out.counts.skipped;
            remark(m_out.diagnostics, Severity::Warning, "primitive-skipped", object,
                   problem + "; left out");
            return nullptr;
        }
        if (known->second->outOfRange > 0) {
            ++m_out.counts.repaired;
            remark(m_out.diagnostics, Severity::Warning, "index-out-of-range", object,
                   fmt::format("{} triangles have a vertex that does not exist; left out",
                               known->second->outOfRange));
        } else {
            ++m_out.counts.loaded;
        }
        reduce(*known->second);
        return &*known->second;
    }

    void reduce(Primitive& primitive) {
        const std::size_t all = m_out.value.fileTriangles;
        if (all <= m_options.mostKept || primitive.triangles.size() < kFewTriangles)
            return;
        if (!m_told) {
            m_told = true;
            remark(m_out.diagnostics, Severity::Info, "simplified", "",
                   fmt::format("its {} triangles were simplified to about {}", all,
                               m_options.mostKept),
                   "100000 are plenty for a vehicle.");
        }
        const double share = double(m_options.mostKept) / double(all);
        simplify(primitive, std::max(kFewestTriangles,
                                     std::size_t(double(primitive.triangles.size()) * share)));
    }

    /// The size of the whole, which tells how fine textures are cut. Reads what there is to read;
    /// false when cancelled.
    bool measure() {
        Box box;
        for (const Placed& placed : m_placed) {
            for (std::size_t i = 0; i < primitivesOf(placed.mesh).size(); ++i) {
                if (m_job.cancelled())
                    return false;
                const Primitive* primitive = primitiveOf(placed.mesh, i);
                for (std::size_t t = 0; primitive != nullptr && t < primitive->triangles.size();
                     ++t) {
                    box.add(glm::dvec3(
                        placed.file_from_mesh *
                        glm::dvec4(glm::dvec3(primitive->positions[primitive->triangles[t].x]),
                                   1.0)));
                }
            }
        }
        m_finest = float(glm::length(box.size()) * kFinestShare);
        return true;
    }

    void addNode(const Placed& placed) {
        GltfModel& model = m_out.value;
        for (std::size_t i = 0; i < primitivesOf(placed.mesh).size(); ++i) {
            const Primitive* primitive = primitiveOf(placed.mesh, i);
            if (primitive == nullptr || primitive->triangles.empty())
                continue;
            const Look& look = lookOf(primitive->material);
            std::vector<glm::vec3> tint = primitive->colors;
            PartMesh mesh = instance(*primitive, placed.file_from_mesh, look, tint);
            const std::size_t left =
                m_options.mostKept - std::min(m_options.mostKept, model.triangles.size());
            addPainted(paintTriangles(std::move(mesh), tint, look, m_finest, left), look, placed,
                       primitive->material);
        }
    }

    /// A primitive in the file's frame; normals made where there are none.
    static PartMesh instance(const Primitive& primitive, const glm::dmat4& transform,
                             const Look& look, std::vector<glm::vec3>& tint) {
        PartMesh mesh;
        const glm::dmat3 linear(transform);
        const double determinant = glm::determinant(linear);
        const bool given = primitive.normals.size() == primitive.positions.size();
        const glm::dmat3 normalMatrix =
            std::abs(determinant) > 1e-30 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
        const auto& uv = look.base.set == 1 ? primitive.uv1 : primitive.uv;
        for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
            mesh.positions.emplace_back(
                glm::vec3(transform * glm::dvec4(glm::dvec3(primitive.positions[v]), 1.0)));
            const glm::dvec3 n =
                given ? normalMatrix * glm::dvec3(primitive.normals[v]) : glm::dvec3(0.0);
            const double length = glm::length(n);
            mesh.normals.push_back(length > 1e-12 && length < 1e30 ? glm::vec3(n / length)
                                                                   : glm::vec3(0.0F));
            mesh.surface.emplace_back(uv.empty() ? glm::vec2(0.0F)
                                                 : glm::vec2(uv[2 * v], uv[2 * v + 1]));
        }
        mesh.triangles = primitive.triangles;
        mesh.material.assign(mesh.triangles.size(), 0);
        if (determinant < 0.0) {
            for (glm::uvec3& t : mesh.triangles)
                std::swap(t.y, t.z);
        }
        if (!given) {
            // Vertices are merged and split: colours of vertices become one of the whole.
            glm::vec3 mean(0.0F);
            for (const glm::vec3& c : tint)
                mean += c / float(tint.size());
            smoothNormals(mesh, kCrease);
            if (!tint.empty())
                tint.assign(mesh.positions.size(), mean);
        }
        mend(mesh);
        if (uv.empty())
            mesh.surface.clear();
        return mesh;
    }

    /// Normals that are missing get their triangle's; triangles that face away from their normals
    /// are turned.
    static void mend(PartMesh& mesh) {
        for (glm::uvec3& t : mesh.triangles) {
            const glm::vec3 cross = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                               mesh.positions[t.z] - mesh.positions[t.x]);
            const float length = glm::length(cross);
            const glm::vec3 facing = length > 0.0F ? cross / length : glm::vec3(0, 1, 0);
            for (int k = 0; k < 3; ++k) {
                if (glm::length(mesh.normals[t[k]]) < 0.5F)
                    mesh.normals[t[k]] = facing;
            }
            if (glm::dot(mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z], cross) < 0.0F)
                std::swap(t.y, t.z);
        }
    }

    const Look& lookOf(int index) {
        const auto [known, isNew] = m_looks.try_emplace(index);
        if (!isNew)
            return known->second;
        if (const auto* material = elementAt(m_document.model().materials, index)) {
            known->second = readLook(*material, index, &m_images);
            return known->second;
        }
        known->second.material.name = "no material";
        known->second.material.metallic = 0.0F;
        if (index != -1)
            remark(m_out.diagnostics, Severity::Warning, "material-missing",
                   fmt::format("material {}", index), "it does not exist; shown grey");
        return known->second;
    }

    void addPainted(PaintedMesh painted, const Look& look, const Placed& placed, int material) {
        GltfModel& model = m_out.value;
        const auto base = std::uint32_t(model.positions.size());
        GltfPart part;
        part.name = placed.name + " " + look.material.name;
        part.firstTriangle = model.triangles.size();
        Palette& palette = m_palettes[material];
        for (std::size_t i = 0; i < painted.mesh.triangles.size(); ++i) {
            const glm::uvec3& t = painted.mesh.triangles[i];
            const glm::vec3& a = painted.mesh.positions[t.x];
            const glm::vec3& b = painted.mesh.positions[t.y];
            const glm::vec3& c = painted.mesh.positions[t.z];
            palette.add(painted.color[i],
                        0.5 * double(glm::length(glm::cross(b - a, c - a))) + 1e-12);
            part.bounds.add(glm::dvec3(a));
            part.bounds.add(glm::dvec3(b));
            part.bounds.add(glm::dvec3(c));
            model.triangles.push_back(t + base);
            m_color.push_back(painted.color[i]);
            m_source.push_back(material);
        }
        model.positions.insert(model.positions.end(), painted.mesh.positions.begin(),
                               painted.mesh.positions.end());
        model.normals.insert(model.normals.end(), painted.mesh.normals.begin(),
                             painted.mesh.normals.end());
        part.triangleCount = model.triangles.size() - part.firstTriangle;
        model.parts.push_back(std::move(part));
    }

    /// One material for each colour of each material of the file.
    void closePalettes() {
        GltfModel& model = m_out.value;
        std::map<int, std::size_t> first;
        for (auto& [material, palette] : m_palettes) {
            palette.close();
            first[material] = model.materials.size();
            for (const glm::vec3& c : palette.colors()) {
                if (model.materials.size() < kMostMaterials)
                    model.materials.push_back(m_looks.at(material).material);
                model.materials.back().color = c;
            }
            weigh(m_looks.at(material), first[material]);
        }
        for (std::size_t i = 0; i < model.triangles.size(); ++i) {
            const std::size_t index =
                first.at(m_source[i]) + m_palettes.at(m_source[i]).nearest(m_color[i]);
            model.triangleMaterial.push_back(
                std::uint16_t(std::min(index, model.materials.size() - 1)));
        }
    }

    /// Textures of roughness, metal and light become their mean over the image.
    void weigh(const Look& look, std::size_t from) {
        constexpr int kSteps = 24;
        glm::vec3 pbr(0.0F);
        glm::vec3 light(0.0F);
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const float u = (float(i % kSteps) + 0.5F) / float(kSteps);
            const float v = (float(i / kSteps) + 0.5F) / float(kSteps);
            if (look.metallicRoughness.image != nullptr)
                pbr += look.metallicRoughness.image->data(u, v) / float(kSteps * kSteps);
            if (look.emissive.image != nullptr)
                light += look.emissive.image->sample(u, v) / float(kSteps * kSteps);
        }
        for (std::size_t i = from; i < m_out.value.materials.size(); ++i) {
            GltfMaterial& m = m_out.value.materials[i];
            if (look.metallicRoughness.image != nullptr) {
                m.roughness *= pbr.y;
                m.metallic *= pbr.z;
            }
            if (look.emissive.image != nullptr)
                m.emission *= light;
        }
    }

    const Document& m_document;
    const GltfOptions& m_options;
    const JobContext& m_job;
    Imported<GltfModel> m_out;
    Images m_images;
    std::vector<Placed> m_placed;
    std::map<std::pair<int, std::size_t>, std::optional<Primitive>> m_primitives;
    std::map<int, Look> m_looks;
    std::map<int, Palette> m_palettes;
    std::vector<glm::vec3> m_color;  // per triangle of the model
    std::vector<int> m_source;       // material of the file, per triangle
    float m_finest = 0.0F;
    bool m_told = false;
};

}  // namespace

Result<Imported<GltfModel>> importVehicleBytes(std::string_view bytes,
                                               const std::filesystem::path& path,
                                               const GltfOptions& options, const JobContext& job) {
    const auto document = Document::read(bytes, path, kMostBytes);
    if (!document)
        return tl::unexpected(document.error());
    return Importer(*document, options, job).run();
}

Result<Imported<GltfModel>> importVehicle(const std::filesystem::path& path,
                                          const GltfOptions& options, const JobContext& job) {
    const auto bytes = readFile(path, options.maxFileBytes);
    if (!bytes)
        return tl::unexpected(bytes.error());
    return importVehicleBytes(*bytes, path, options, job);
}

}  // namespace reflet
