// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/QuadTable.h"

#include "core/base/ParallelFor.h"
#include "core/reconstruction/MemMesh.h"

#include <chrono>

namespace reflet {

namespace {

void appendLeaf(const MemFace& face, const MemQuad& quad, int resolution,
                std::vector<glm::vec4>& rows) {
    const TexelRange columns = texelsWithin(resolution, quad.s0, quad.s1);
    const TexelRange lines = texelsWithin(resolution, quad.t0, quad.t1);
    if (columns.empty() || lines.empty())
        return;
    glm::vec4 inverseDepth, weightB;
    bool uncovered = false;
    for (int k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[std::size_t(k)]];
        inverseDepth[k] = float(vertex.inverseDepth);
        weightB[k] = float(vertex.weightB);
        uncovered = uncovered || vertex.uncovered;
    }
    const bool ownRay = quad.vertex[0] == quad.vertex[3];
    const int flags = (uncovered ? 1 : 0) + (ownRay ? 2 : 0);
    rows.emplace_back(columns.first + flags * QuadTable::kFlag, lines.first, columns.last,
                      lines.last);
    rows.emplace_back(quad.s0, quad.t0, 1.0 / (quad.s1 - quad.s0), 1.0 / (quad.t1 - quad.t0));
    rows.push_back(inverseDepth);
    rows.push_back(weightB);
}

}  // namespace

QuadTable buildQuadTable(const ReconstructionInput& input, const RemChoice& choice,
                         const glm::dvec3& position, const MemSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    std::array<std::vector<glm::vec4>, 6> rows;
    std::array<ReconstructionStatistics, 6> counts;
    parallelFor(0, rows.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            const MemFace face = buildMemFace(input, choice, position, int(f), settings);
            rows[f].reserve(face.quads.size() * QuadTable::kVectors);
            for (const MemQuad& quad : face.quads)
                appendLeaf(face, quad, settings.resolution, rows[f]);
            counts[f].quads = face.quads.size();
            counts[f].vertices = face.vertices.size();
            for (const MemVertex& vertex : face.vertices)
                counts[f].uncovered += vertex.uncovered ? 1 : 0;
        }
    });
    QuadTable table;
    for (std::size_t f = 0; f < rows.size(); ++f) {
        table.rows.insert(table.rows.end(), rows[f].begin(), rows[f].end());
        table.firstOfFace[f + 1] = int(table.rows.size()) / QuadTable::kVectors;
        table.statistics.quads += counts[f].quads;
        table.statistics.vertices += counts[f].vertices;
        table.statistics.rays += counts[f].vertices;
        table.statistics.uncovered += counts[f].uncovered;
    }
    table.statistics.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return table;
}

}  // namespace reflet
