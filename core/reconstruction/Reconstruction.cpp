// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/Reconstruction.h"

#include "core/base/ParallelFor.h"
#include "core/reconstruction/MemMesh.h"
#include "core/reconstruction/MemResampler.h"

#include <cassert>
#include <chrono>

namespace reflet {

namespace {

constexpr std::size_t kLeavesPerTask = 128;

void addStatistics(const MemFace& face, ReconstructionStatistics& statistics) {
    statistics.quads += face.quads.size();
    statistics.vertices += face.vertices.size();
    statistics.rays += face.vertices.size();
    for (const MemVertex& vertex : face.vertices)
        statistics.uncovered += vertex.uncovered ? 1 : 0;
}

}  // namespace

LocalEnvironmentMap reconstructMem(const ReconstructionInput& input, const glm::dvec3& position,
                                   const MemSettings& settings, TexelSources* sources) {
    assert(input.tracer && "a reconstruction needs a heightfield");
    const auto start = std::chrono::steady_clock::now();
    LocalEnvironmentMap map;
    map.center = position;
    map.radiance = CubeMap<glm::vec3>(settings.resolution);
    map.distance = CubeMap<float>(settings.resolution);
    map.uncovered = CubeMap<unsigned char>(settings.resolution);

    if (sources)
        *sources = TexelSources(settings.resolution);

    const RemCandidates candidates = candidateRems(input.rems, position, settings);
    const MemVertexTracer tracer(input, candidates, position, settings.refineHits);
    const MemResampler resampler(input, candidates, position, settings.interpolation, map, sources);
    std::array<MemFace, 6> faces;
    parallelFor(0, faces.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t face = first; face < last; ++face) {
            faces[face] = MemMeshBuilder(tracer, int(face), settings).build();
            const std::vector<MemQuad>& quads = faces[face].quads;
            parallelFor(0, quads.size(), kLeavesPerTask, [&](std::size_t from, std::size_t to) {
                for (std::size_t k = from; k < to; ++k)
                    resampler.writeLeaf(int(face), faces[face], quads[k]);
            });
        }
    });
    for (const MemFace& face : faces)
        addStatistics(face, map.statistics);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    map.statistics.milliseconds = elapsed.count();
    return map;
}

}  // namespace reflet
