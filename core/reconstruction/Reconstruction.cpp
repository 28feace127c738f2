// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/Reconstruction.h"

#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemMesh.h"
#include "core/reconstruction/MemResampler.h"
#include "core/reconstruction/TexelRays.h"

#include <atomic>
#include <cassert>

namespace reflet {

namespace {

constexpr std::size_t kLeavesPerTask = 128;
constexpr std::size_t kRowsPerTask = 8;
constexpr double kMilliseconds = 1e3;

LocalEnvironmentMap emptyMap(const glm::dvec3& position, int resolution, TexelSources* sources) {
    LocalEnvironmentMap map;
    map.center = position;
    map.radiance = CubeMap<glm::vec3>(resolution);
    map.distance = CubeMap<float>(resolution);
    map.uncovered = CubeMap<unsigned char>(resolution);
    if (sources)
        *sources = TexelSources(resolution);
    return map;
}

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
    const Stopwatch watch;
    LocalEnvironmentMap map = emptyMap(position, settings.resolution, sources);
    map.atInfinity = !settings.parallax;
    const RemCandidates candidates = input.candidates(position, settings);
    const MemResampler resampler(input, candidates, position, settings.interpolation, map, sources);
    const std::vector<MemFace> faces = buildMemFaces(input, candidates, position, settings);
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const std::vector<MemQuad>& quads = faces[face].quads;
        parallelFor(0, quads.size(), kLeavesPerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t k = from; k < to; ++k)
                resampler.writeLeaf(int(face), faces[face], quads[k]);
        });
        addStatistics(faces[face], map.statistics);
    }
    map.statistics.milliseconds = kMilliseconds * watch.seconds();
    return map;
}

LocalEnvironmentMap reconstructDense(const ReconstructionInput& input, const glm::dvec3& position,
                                     const MemSettings& settings, TexelSources* sources) {
    assert(input.tracer && "a reconstruction needs a heightfield");
    const Stopwatch watch;
    const int n = settings.resolution;
    LocalEnvironmentMap map = emptyMap(position, n, sources);
    map.atInfinity = !settings.parallax;
    const RemCandidates candidates = input.candidates(position, settings);
    const MemResampler resampler(input, candidates, position, settings.interpolation, map, sources);
    const MemVertexTracer tracer(input, candidates, position, settings.refineHits);
    const CubeMap<double> t = traceTexels(*input.tracer, position, n);
    std::atomic<std::size_t> uncovered{0};
    parallelFor(0, 6 * std::size_t(n), kRowsPerTask, [&](std::size_t first, std::size_t last) {
        std::size_t blind = 0;
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line / std::size_t(n));
            const int row = int(line % std::size_t(n));
            for (int column = 0; column < n; ++column) {
                const MemVertex vertex =
                    tracer.at(texelDirection(n, face, column, row), t.at(face, column, row));
                resampler.writeTexel(face, vertex, column, row);
                blind += vertex.uncovered ? 1 : 0;
            }
        }
        uncovered += blind;
    });
    map.statistics.rays = map.statistics.vertices = t.texels().size();
    map.statistics.uncovered = uncovered;
    map.statistics.milliseconds = kMilliseconds * watch.seconds();
    return map;
}

}  // namespace reflet
