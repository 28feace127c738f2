// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Instances.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace reflet::importers {

namespace {

/// Row-major 4 x 4 with column vectors, as in CityJSON.
struct Matrix {
    const std::array<double, 16>& m;

    /// False when the point goes to infinity or out of all proportion.
    bool apply(glm::dvec3& p) const {
        constexpr double kFarthest = 1e7;
        const auto row = [&](std::size_t r) {
            return m[4 * r] * p.x + m[4 * r + 1] * p.y + m[4 * r + 2] * p.z + m[4 * r + 3];
        };
        const double w = row(3);
        if (!(std::abs(w) > 1e-12))
            return false;
        p = glm::dvec3(row(0), row(1), row(2)) / w;
        return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
    }
    [[nodiscard]] bool mirrors() const {
        const glm::dvec3 x(m[0], m[4], m[8]);
        const glm::dvec3 y(m[1], m[5], m[9]);
        const glm::dvec3 z(m[2], m[6], m[10]);
        return glm::dot(glm::cross(x, y), z) < 0.0;
    }
};

/// Numbers the vertices of one template from 0, in the order of their first use.
class Numbering {
public:
    Numbering(const SourceCity& file, const SoupTriangles& triangles, TemplateMesh& mesh)
        : m_file(file), m_triangles(triangles), m_mesh(mesh) {}

    std::uint32_t operator()(std::uint32_t vertex) {
        const auto next = static_cast<std::uint32_t>(m_mesh.points.size());
        const auto [entry, isNew] = m_number.try_emplace(vertex, next);
        if (isNew) {
            m_mesh.points.push_back(vertex < m_triangles.vertexCount
                                        ? m_file.templateVertices[vertex]
                                        : m_triangles.born[vertex - m_triangles.vertexCount]);
        }
        return entry->second;
    }

private:
    const SourceCity& m_file;
    const SoupTriangles& m_triangles;
    TemplateMesh& m_mesh;
    std::unordered_map<std::uint32_t, std::uint32_t> m_number;
};

}  // namespace

std::vector<TemplateMesh> templateMeshes(const SourceCity& file, const CityGeometry& geometry,
                                         const SoupTriangles& triangles) {
    std::vector<TemplateMesh> meshes(geometry.templateBegin.size() - 1);
    const auto& surfaces = geometry.templates.surfaces;
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < meshes.size(); ++t) {
        TemplateMesh& mesh = meshes[t];
        for (std::uint32_t s = geometry.templateBegin[t]; s < geometry.templateBegin[t + 1]; ++s)
            mesh.nominalTriangles +=
                nominalTriangles(geometry.templates.pointCount(surfaces[s]), surfaces[s].ringCount);
        Numbering number(file, triangles, mesh);
        for (; next < triangles.triangles.size() &&
               surfaces[triangles.triangles[next].surface].owner == t;
             ++next) {
            const SoupTriangles::Triangle& triangle = triangles.triangles[next];
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = number(triangle.vertex[k]);
            mesh.triangles.push_back(corners);
            mesh.surfaces.push_back(triangle.surface);
            if (!triangles.uv.empty())
                mesh.uv.push_back(triangles.uv[next]);
        }
    }
    return meshes;
}

Result<std::optional<PlacedInstance>> placeInstance(
    const InstanceRecord& instance, const TemplateMesh& mesh, const Placement& placement,
    const glm::dvec3& sourceAnchor, const glm::dvec3& localAnchor, ImportReport& report) {
    if (std::isnan(localAnchor.x)) {
        report.note(instance.object, Issue::BadVertex, fmt::format("vertex {}", instance.anchor));
        return std::nullopt;
    }
    const Matrix matrix{instance.matrix};
    PlacedInstance placed{instance.object, instance.templateIndex, matrix.mirrors(), mesh.points};
    for (glm::dvec3& p : placed.points) {
        if (!matrix.apply(p)) {
            report.note(instance.object, Issue::BadInstance,
                        "the matrix takes the template out of the world");
            return std::nullopt;
        }
    }
    if (auto done = placement.placeAround(sourceAnchor, localAnchor, placed.points); !done)
        return tl::unexpected<Error>(done.error());
    const bool whole =
        std::all_of(placed.points.begin(), placed.points.end(),
                    [](const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); });
    if (!whole) {
        report.note(instance.object, Issue::BadInstance,
                    "its place has no image in the project's CRS");
        return std::nullopt;
    }
    return placed;
}

Result<void> checkInstanceLimit(const std::vector<InstanceRecord>& instances,
                                const std::vector<TemplateMesh>& meshes,
                                const std::vector<bool>& leftOut, std::size_t fileBytes,
                                const std::string& subject, std::size_t& total) {
    constexpr std::size_t kAlways = 4'000'000;
    constexpr std::size_t kAtMost = 64'000'000;
    constexpr std::size_t kPerByte = 32;
    const std::size_t limit = std::min(kAtMost, std::max(kAlways, kPerByte * fileBytes));
    for (const InstanceRecord& instance : instances) {
        if (!leftOut[instance.object])
            total += meshes[instance.templateIndex].triangles.size();
    }
    if (total <= limit)
        return {};
    return fail(ErrorCode::ResourceLimit,
                fmt::format("places templates with {} triangles in all, more than the {} that a "
                            "file of its size may",
                            total, limit),
                subject, "Import a part with --bbox or --types, or use simpler templates.");
}

}  // namespace reflet::importers
