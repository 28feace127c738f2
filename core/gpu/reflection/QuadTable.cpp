// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/QuadTable.h"

#include "core/base/ParallelFor.h"
#include "core/reconstruction/MemMesh.h"

#include <array>
#include <chrono>

namespace reflet {

namespace {

/// Looks of one face: in front those of leaves that no REM serves, then those of each candidate.
using Looks = std::array<std::vector<glm::vec4>, 1 + kMostCandidates>;

void appendLeaf(const MemFace& face, const MemQuad& quad, int resolution, Looks& looks) {
    const TexelRange columns = texelsWithin(resolution, quad.s0, quad.s1);
    const TexelRange lines = texelsWithin(resolution, quad.t0, quad.t1);
    if (columns.empty() || lines.empty())
        return;
    glm::vec4 inverseDepth;
    std::array<glm::vec4, kMostCandidates> weights{};
    bool uncovered = false;
    for (int k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[std::size_t(k)]];
        inverseDepth[k] = float(vertex.inverseDepth);
        uncovered = uncovered || vertex.uncovered;
        if (vertex.a >= 0)
            weights[std::size_t(vertex.a)][k] += float(vertex.weightA);
        if (vertex.b >= 0)
            weights[std::size_t(vertex.b)][k] += float(vertex.weightB);
    }
    const bool ownRay = quad.vertex[0] == quad.vertex[3];
    const int flags = (uncovered ? 1 : 0) + (ownRay ? 2 : 0);
    const auto append = [&](std::vector<glm::vec4>& rows, const glm::vec4& weight) {
        rows.emplace_back(columns.first + flags * QuadTable::kFlag, lines.first, columns.last,
                          lines.last);
        rows.emplace_back(quad.s0, quad.t0, 1.0 / (quad.s1 - quad.s0), 1.0 / (quad.t1 - quad.t0));
        rows.push_back(inverseDepth);
        rows.push_back(weight);
    };
    bool served = false;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == glm::vec4(0.0F))
            continue;
        append(looks[i + 1], weights[i]);
        served = true;
    }
    if (!served)
        append(looks[0], glm::vec4(0.0F));
}

}  // namespace

QuadTable buildQuadTable(const ReconstructionInput& input, const RemCandidates& candidates,
                         const glm::dvec3& position, const MemSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    std::array<Looks, 6> looks;
    std::array<ReconstructionStatistics, 6> counts;
    const std::vector<MemFace> faces = buildMemFaces(input, candidates, position, settings);
    parallelFor(0, looks.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            const MemFace& face = faces[f];
            for (const MemQuad& quad : face.quads)
                appendLeaf(face, quad, settings.resolution, looks[f]);
            counts[f].quads = face.quads.size();
            counts[f].vertices = face.vertices.size();
            for (const MemVertex& vertex : face.vertices)
                counts[f].uncovered += vertex.uncovered ? 1 : 0;
        }
    });
    QuadTable table;
    for (std::size_t f = 0; f < looks.size(); ++f) {
        for (std::size_t i = 0; i < looks[f].size(); ++i) {
            const std::vector<glm::vec4>& rows = looks[f][i];
            if (rows.empty())
                continue;
            table.stretches.push_back({int(f), int(i) - 1,
                                       int(table.rows.size()) / QuadTable::kVectors,
                                       int(rows.size()) / QuadTable::kVectors});
            table.rows.insert(table.rows.end(), rows.begin(), rows.end());
        }
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
