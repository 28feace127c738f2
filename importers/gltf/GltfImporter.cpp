// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfImporter.h"

#include "core/base/Files.h"
#include "importers/gltf/GltfPaint.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <meshoptimizer.h>
#include <set>

namespace reflet {

using namespace gltf;
using nlohmann::json;

namespace {

constexpr std::size_t kMostBytes = std::size_t(2) << 30;  // of all buffers together
constexpr float kCrease = 0.7F;  // radians: sharper edges stay sharp where normals are made
constexpr double kFinestShare = 1.0 / 300.0;  // of the model's size: finest piece of a texture
constexpr std::size_t kMostDiagnostics = 100;
constexpr std::size_t kMostMaterials = 60'000;

/// A node that has a mesh, where it stands.
struct Placed {
    std::size_t mesh = 0;
    glm::dmat4 file_from_mesh{1.0};
    std::string name;
};

/// Local transform of a node (glTF 2.0, section 3.5.3).
glm::dmat4 transformOf(const json& node) {
    if (const auto m = numbers(node, "matrix", 16)) {
        glm::dmat4 out(1.0);
        for (std::size_t i = 0; i < 16; ++i)
            out[int(i / 4)][int(i % 4)] = (*m)[i];
        return out;
    }
    glm::dmat4 out(1.0);
    const auto scale = numbers(node, "scale", 3);
    if (const auto r = numbers(node, "rotation", 4)) {
        const glm::dquat q((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
        if (glm::length(q) > 1e-9)
            out = glm::mat4_cast(glm::normalize(q));
    }
    for (int i = 0; scale && i < 3; ++i)
        out[i] *= (*scale)[std::size_t(i)];
    if (const auto t = numbers(node, "translation", 3))
        out[3] = glm::dvec4((*t)[0], (*t)[1], (*t)[2], 1.0);
    return out;
}

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
        model.fileMaterials = m_document.count("materials");
        model.nodes = m_document.count("nodes");
        model.images = m_document.count("images");
        collectNodes();
        for (const Placed& placed : m_placed) {
            for (const json& primitive : primitivesOf(placed.mesh))
                model.fileTriangles += countTriangles(m_document, primitive);
        }
        if (model.fileTriangles > m_options.maxTriangles) {
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("has {} triangles, more than {}", model.fileTriangles,
                                    m_options.maxTriangles),
                        m_document.path().string(),
                        "Reduce it in a modelling program (in Blender: the Decimate modifier); "
                        "100000 are plenty for a vehicle.");
        }
        measure();
        for (const Placed& placed : m_placed) {
            if (m_job.cancelled())
                return fail(ErrorCode::Cancelled, "cancelled", m_document.path().string());
            addNode(placed);
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
    void remark(Severity severity, const char* code, std::string object, std::string text,
                std::string remedy = {}) {
        if (m_out.diagnostics.size() < kMostDiagnostics) {
            m_out.diagnostics.push_back(
                {severity, code, std::move(object), std::move(text), std::move(remedy)});
        }
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

    [[nodiscard]] const json& primitivesOf(std::size_t mesh) const {
        static const json none = json::array();
        const json& list = member(m_document.element("meshes", mesh), "primitives");
        return list.is_array() ? list : none;
    }

    [[nodiscard]] std::vector<std::size_t> roots() const {
        std::vector<std::size_t> out;
        const std::size_t scene = wholeNumber(m_document.root(), "scene").value_or(0);
        const json& listed = member(m_document.element("scenes", scene), "nodes");
        if (listed.is_array()) {
            for (const json& node : listed) {
                if (node.is_number_unsigned())
                    out.push_back(node.get<std::size_t>());
            }
            return out;
        }
        // Without a scene: every node that is nobody's child.
        std::set<std::size_t> children;
        for (std::size_t i = 0; i < m_document.count("nodes"); ++i) {
            for (const json& child : member(m_document.element("nodes", i), "children")) {
                if (child.is_number_unsigned())
                    children.insert(child.get<std::size_t>());
            }
        }
        for (std::size_t i = 0; i < m_document.count("nodes"); ++i) {
            if (children.count(i) == 0)
                out.push_back(i);
        }
        if (out.empty() && m_document.count("nodes") > 0)
            out.push_back(0);
        return out;
    }

    /// The scene is a tree: a node that is met twice makes a loop or is shared, and stays out.
    void collectNodes() {
        struct Open {
            std::size_t node;
            glm::dmat4 file_from_parent;
            std::string name;
        };
        std::vector<Open> open;
        const std::vector<std::size_t> first = roots();
        for (std::size_t i = first.size(); i-- > 0;)
            open.push_back({first[i], glm::dmat4(1.0), ""});
        std::set<std::size_t> met;
        while (!open.empty()) {
            const Open next = std::move(open.back());
            open.pop_back();
            const json& node = m_document.element("nodes", next.node);
            const std::string object = fmt::format("node {}", next.node);
            if (!node.is_object()) {
                remark(Severity::Warning, "node-missing", object, "it does not exist; left out");
                continue;
            }
            if (!met.insert(next.node).second) {
                remark(Severity::Warning, "node-loop", object,
                       "it is its own ancestor, or has two parents; shown once");
                continue;
            }
            const glm::dmat4 transform = next.file_from_parent * transformOf(node);
            std::string name = next.name + "/" + text(node, "name");
            if (name.size() > 200)
                name.erase(0, name.size() - 200);
            if (!member(node, "mesh").is_null()) {
                const auto mesh = wholeNumber(node, "mesh");
                if (mesh && m_document.element("meshes", *mesh).is_object()) {
                    m_placed.push_back({*mesh, transform, name});
                } else {
                    remark(Severity::Warning, "mesh-missing", object,
                           fmt::format("mesh {} does not exist", member(node, "mesh").dump()));
                }
            }
            const json& children = member(node, "children");
            for (std::size_t i = children.is_array() ? children.size() : 0; i-- > 0;) {
                if (children[i].is_number_unsigned())
                    open.push_back({children[i].get<std::size_t>(), transform, name});
            }
        }
    }

    /// A primitive read once; null when it cannot be shown, which is told once.
    const Primitive* primitiveOf(std::size_t mesh, std::size_t index) {
        const auto [known, isNew] = m_primitives.try_emplace({mesh, index});
        if (!isNew)
            return known->second ? &*known->second : nullptr;
        std::string problem;
        const std::string object = fmt::format("mesh {} primitive {}", mesh, index);
        known->second = readPrimitive(m_document, primitivesOf(mesh)[index], problem);
        if (!known->second) {
            ++m_out.counts.skipped;
            remark(Severity::Warning, "primitive-skipped", object, problem + "; left out");
            return nullptr;
        }
        if (known->second->outOfRange > 0) {
            ++m_out.counts.repaired;
            remark(Severity::Warning, "index-out-of-range", object,
                   fmt::format("{} triangles have a vertex that does not exist; left out",
                               known->second->outOfRange));
        } else {
            ++m_out.counts.loaded;
        }
        simplify(*known->second);
        return &*known->second;
    }

    void simplify(Primitive& primitive) {
        const std::size_t all = m_out.value.fileTriangles;
        if (all <= m_options.mostKept || primitive.triangles.size() < 64)
            return;
        if (!m_told) {
            m_told = true;
            remark(Severity::Info, "simplified", "",
                   fmt::format("its {} triangles were simplified to about {}", all,
                               m_options.mostKept),
                   "100000 are plenty for a vehicle.");
        }
        const std::size_t count = primitive.triangles.size() * 3;
        const std::size_t wanted =
            std::size_t(double(count / 3) * double(m_options.mostKept) / double(all)) * 3;
        std::vector<unsigned int> indices(count);
        indices.resize(meshopt_simplify(indices.data(), &primitive.triangles.front().x, count,
                                        &primitive.positions.front().x, primitive.positions.size(),
                                        sizeof(glm::vec3), wanted, 0.02F, 0, nullptr));
        primitive.triangles.clear();
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            primitive.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }

    /// The size of the whole, which tells how fine textures are cut.
    void measure() {
        Box box;
        for (const Placed& placed : m_placed) {
            for (std::size_t i = 0; i < primitivesOf(placed.mesh).size(); ++i) {
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
                       primitive->material.value_or(SIZE_MAX));
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

    const Look& lookOf(std::optional<std::size_t> material) {
        const std::size_t index = material.value_or(SIZE_MAX);
        const auto [known, isNew] = m_looks.try_emplace(index);
        if (isNew) {
            if (m_document.element("materials", index).is_object()) {
                known->second = readLook(m_document, index, m_images);
            } else {
                known->second.material.name = "no material";
                known->second.material.metallic = 0.0F;
                if (material)
                    remark(Severity::Warning, "material-missing", fmt::format("material {}", index),
                           "it does not exist; shown grey");
            }
        }
        return known->second;
    }

    void addPainted(PaintedMesh painted, const Look& look, const Placed& placed,
                    std::size_t material) {
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
        std::map<std::size_t, std::size_t> first;
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
    std::map<std::pair<std::size_t, std::size_t>, std::optional<Primitive>> m_primitives;
    std::map<std::size_t, Look> m_looks;
    std::map<std::size_t, Palette> m_palettes;
    std::vector<glm::vec3> m_color;     // per triangle of the model
    std::vector<std::size_t> m_source;  // material of the file, per triangle
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
