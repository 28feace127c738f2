// SPDX-License-Identifier: GPL-3.0-or-later
// What is done without geometry: maps looked up as if all were infinitely far.
#include "core/base/ParallelFor.h"
#include "core/environment/CubeSampler.h"
#include "core/reconstruction/Reconstruction.h"

#include <chrono>
#include <utility>

namespace reflet {

namespace {

/// Two REMs that are looked up in the same direction, with their weights.
using SharedLook = std::array<TexelSource, 2>;

/// radiance(direction) for every texel; the distances are those of `rem`, from its own centre.
template <class Radiance>
LocalEnvironmentMap mapAtInfinity(const ReferenceEnvironmentMap* rem, const glm::dvec3& position,
                                  int resolution, const SharedLook& look, TexelSources* sources,
                                  const Radiance& radiance) {
    const auto start = std::chrono::steady_clock::now();
    LocalEnvironmentMap map;
    map.center = position;
    map.atInfinity = true;
    map.radiance = CubeMap<glm::vec3>(resolution);
    map.distance = CubeMap<float>(resolution, kInfinity);
    map.uncovered = CubeMap<unsigned char>(resolution, rem ? 0 : 1);
    const auto rows = std::size_t(resolution);
    if (sources)
        *sources = TexelSources(resolution);
    parallelFor(0, rem ? 6 * rows : 0, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line / rows);
            const int row = int(line % rows);
            for (int column = 0; column < resolution; ++column) {
                const glm::dvec3 direction = texelDirection(resolution, face, column, row);
                const Texel texel = texelAt(rem->distance.resolution(), direction);
                map.radiance.at(face, column, row) = toVec3(radiance(glm::vec3(direction)));
                map.distance.at(face, column, row) =
                    rem->distance.at(texel.face, texel.column, texel.row);
                if (!sources)
                    continue;
                auto& texelSources = sources->at(face, column, row);
                texelSources = look;
                for (TexelSource& source : texelSources)
                    source.lookup = glm::vec3(direction);
            }
        }
    });
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    map.statistics.milliseconds = elapsed.count();
    return map;
}

}  // namespace

LocalEnvironmentMap reconstructNearest(const ReconstructionInput& input, const glm::dvec3& position,
                                       int resolution, TexelSources* sources) {
    const RemChoice choice = chooseRems(input.rems, position);
    const ReferenceEnvironmentMap* a = choice.a ? &input.rems[*choice.a] : nullptr;
    if (!a) {
        return mapAtInfinity(a, position, resolution, {}, sources,
                             [](const glm::vec3&) { return Float4{}; });
    }
    const CubeSampler sampler(a->radiance);
    const SharedLook look{TexelSource{std::int32_t(*choice.a), 1.0F, {}}, {}};
    return mapAtInfinity(a, position, resolution, look, sources,
                         [&](const glm::vec3& direction) { return sampler.sample(direction); });
}

LocalEnvironmentMap reconstructBlend(const ReconstructionInput& input, const glm::dvec3& position,
                                     int resolution, TexelSources* sources) {
    const RemChoice choice = chooseRems(input.rems, position);
    if (!choice.b)
        return reconstructNearest(input, position, resolution, sources);
    const ReferenceEnvironmentMap& a = input.rems[*choice.a];
    const ReferenceEnvironmentMap& b = input.rems[*choice.b];
    const auto s = float(blendParameter(a.center, b.center, position));
    const CubeSampler samplerA(a.radiance);
    const CubeSampler samplerB(b.radiance);
    SharedLook look{TexelSource{std::int32_t(*choice.a), 1.0F - s, {}},
                    TexelSource{std::int32_t(*choice.b), s, {}}};
    if (s > 0.5F)
        std::swap(look[0], look[1]);
    return mapAtInfinity(&a, position, resolution, look, sources, [&](const glm::vec3& direction) {
        return (1.0f - s) * samplerA.sample(direction) + s * samplerB.sample(direction);
    });
}

}  // namespace reflet
