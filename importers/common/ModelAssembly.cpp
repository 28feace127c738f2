// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ModelAssembly.h"

#include "importers/common/LodChoice.h"

namespace reflet::importers {

namespace {

class Assembler {
public:
    explicit Assembler(const ModelParts& parts) : m_parts(parts) {}

    CityModel assemble() {
        m_model.materials = m_parts.file.materials;
        addObjects();
        m_hasUv = !m_parts.triangles.uv.empty();
        for (const TemplateMesh& mesh : m_parts.meshes)
            m_hasUv = m_hasUv || !mesh.uv.empty();
        addVertices();
        addTriangles();
        for (const PlacedInstance& instance : m_parts.instances)
            addInstance(instance);
        return std::move(m_model);
    }

private:
    void addObjects() {
        const auto& outlines = m_parts.file.objects;
        m_objectOf.assign(outlines.size(), kNone);
        for (std::uint32_t i = 0; i < outlines.size(); ++i) {
            const Fate fate = m_parts.report.fate(i);
            if (fate == Fate::Skipped || fate == Fate::LeftOut)
                continue;
            m_objectOf[i] = static_cast<std::uint32_t>(m_model.objects.size());
            m_model.objects.push_back({outlines[i].id,
                                       outlines[i].type,
                                       outlines[i].typeName,
                                       lodOfObject(m_parts.file, m_parts.chosen, i),
                                       {}});
        }
        for (std::uint32_t i = 0; i < outlines.size(); ++i) {
            const std::uint32_t parent = m_parts.tree.parent[i];
            if (m_objectOf[i] != kNone && parent != kNone && m_objectOf[parent] != kNone)
                m_model.objects[m_objectOf[i]].parent = m_objectOf[parent];
        }
    }

    [[nodiscard]] bool isKept(const SoupTriangles::Triangle& triangle) const {
        return m_objectOf[m_parts.geometry.surfaces.surfaces[triangle.surface].owner] != kNone;
    }

    void addVertices() {
        const SoupTriangles& source = m_parts.triangles;
        m_vertexOf.assign(source.vertexCount + source.born.size(), kNone);
        for (const auto& triangle : source.triangles) {
            if (!isKept(triangle))
                continue;
            for (const std::uint32_t vertex : triangle.vertex)
                m_vertexOf[vertex] = 0;
        }
        for (std::uint32_t v = 0; v < m_vertexOf.size(); ++v) {
            if (m_vertexOf[v] == kNone)
                continue;
            m_vertexOf[v] = static_cast<std::uint32_t>(m_model.vertices.size());
            m_model.vertices.emplace_back(
                v < source.vertexCount ? m_parts.local[v] : source.born[v - source.vertexCount]);
        }
    }

    void addSurface(const SurfaceSoup::Surface& surface, std::uint32_t object, bool instance) {
        m_model.surfaces.push_back(
            {object, surface.type, surface.material, surface.texture, instance});
    }

    void addTriangles() {
        const SoupTriangles& source = m_parts.triangles;
        std::uint32_t last = kNone;
        for (std::size_t t = 0; t < source.triangles.size(); ++t) {
            const auto& triangle = source.triangles[t];
            if (!isKept(triangle))
                continue;
            if (triangle.surface != last) {
                const auto& surface = m_parts.geometry.surfaces.surfaces[triangle.surface];
                addSurface(surface, m_objectOf[surface.owner], false);
                last = triangle.surface;
            }
            CityTriangle made;
            for (std::size_t k = 0; k < 3; ++k)
                made.vertex[k] = m_vertexOf[triangle.vertex[k]];
            made.surface = static_cast<std::uint32_t>(m_model.surfaces.size() - 1);
            m_model.triangles.push_back(made);
            if (m_hasUv)
                m_model.uv.push_back(source.uv.empty() ? kNoUv : source.uv[t]);
        }
    }

    void addInstance(const PlacedInstance& instance) {
        const std::uint32_t object = m_objectOf[instance.object];
        if (object == kNone)
            return;
        const TemplateMesh& mesh = m_parts.meshes[instance.templateIndex];
        const auto base = static_cast<std::uint32_t>(m_model.vertices.size());
        for (const glm::dvec3& point : instance.points)
            m_model.vertices.emplace_back(point);
        std::uint32_t last = kNone;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (mesh.surfaces[t] != last) {
                last = mesh.surfaces[t];
                addSurface(m_parts.geometry.templates.surfaces[last], object, true);
            }
            std::array<std::uint32_t, 3> corner = mesh.triangles[t];
            std::array<glm::vec2, 3> uv = mesh.uv.empty() ? kNoUv : mesh.uv[t];
            if (instance.mirrored) {
                std::swap(corner[1], corner[2]);
                std::swap(uv[1], uv[2]);
            }
            m_model.triangles.push_back({{base + corner[0], base + corner[1], base + corner[2]},
                                         static_cast<std::uint32_t>(m_model.surfaces.size() - 1)});
            if (m_hasUv)
                m_model.uv.push_back(uv);
        }
    }

    static constexpr std::array<glm::vec2, 3> kNoUv{glm::vec2(0.0F), glm::vec2(0.0F),
                                                    glm::vec2(0.0F)};
    const ModelParts& m_parts;
    CityModel m_model;
    std::vector<std::uint32_t> m_objectOf;
    std::vector<std::uint32_t> m_vertexOf;
    bool m_hasUv = false;
};

}  // namespace

CityModel assembleModel(const ModelParts& parts) {
    return Assembler(parts).assemble();
}

}  // namespace reflet::importers
