// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Reconstruct.h"

#include "app/pipeline/GlRender.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/base/Stopwatch.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/BoxMap.h"

#include <cassert>

namespace reflet {

namespace {

constexpr double kMilliseconds = 1e3;

/// Nothing but the sky, as a vehicle shows it in a city without probes.
LocalEnvironmentMap skyMap(const Lighting& lighting, const glm::dvec3& position, int resolution) {
    const Stopwatch watch;
    const Sky sky(lighting);
    LocalEnvironmentMap out;
    out.center = position;
    out.radiance = CubeMap<glm::vec3>(resolution);
    out.distance = CubeMap<float>(resolution, kInfinity);
    out.uncovered = CubeMap<unsigned char>(resolution, 0);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                const glm::dvec3 direction = texelDirection(resolution, face, column, row);
                out.radiance.at(face, column, row) = sky.radiance(glm::normalize(direction));
            }
        }
    }
    out.statistics.milliseconds = kMilliseconds * watch.seconds();
    return out;
}

/// The truth: a map baked at the very place, in the full mesh.
Result<LocalEnvironmentMap> traceTruth(const RadianceScene& scene, const glm::dvec3& position,
                                       const Project& project, const JobContext& job) {
    const Stopwatch watch;
    BakeSettings settings = project.bake;
    settings.resolution = project.tuning.resolution;
    auto map = bakeEnvironmentMap(scene, nullptr, "reference", position, settings, job);
    if (!map)
        return tl::unexpected(map.error());
    LocalEnvironmentMap out;
    out.center = position;
    out.uncovered = CubeMap<unsigned char>(settings.resolution, 0);
    out.radiance = std::move(map->radiance);
    out.distance = std::move(map->distance);
    const auto samples = std::size_t(settings.samplesPerEdge * settings.samplesPerEdge + 1);
    out.statistics.rays = out.distance.texels().size() * samples;
    out.statistics.milliseconds = kMilliseconds * watch.seconds();
    return out;
}

Result<LocalEnvironmentMap> mapBy(const PreparedCity& city, const RemSet& rems,
                                  const RadianceScene* scene, Method method,
                                  const glm::dvec3& position, const JobContext& job,
                                  TexelSources* sources) {
    if (sources)
        *sources = {};
    const auto prepared = city.preparedRems(rems);
    const ReconstructionInput input{&city.tracer(), rems, city.diameter(), prepared.get()};
    const MemSettings& tuning = city.project().tuning;
    switch (method) {
        case Method::Sky:
            return skyMap(city.lighting(), position, tuning.resolution);
        case Method::Nearest:
            return reconstructNearest(input, position, tuning.resolution, sources);
        case Method::Blend:
            return reconstructBlend(input, position, tuning.resolution, sources);
        case Method::Box:
            return reconstructBox(input, position, tuning.resolution, sources);
        case Method::Mem:
            return reconstructMem(input, position, tuning, sources);
        case Method::Dense:
        case Method::PerPixel:
            return reconstructDense(input, position, tuning, sources);
        case Method::Rerender:
            return rerenderMap(city, position, job);
        case Method::RayTrace:
            break;
    }
    assert(scene != nullptr);
    return traceTruth(*scene, position, city.project(), job);
}

}  // namespace

Result<LocalEnvironmentMap> reconstruct(const PreparedCity& city, const RemSet& rems,
                                        const RadianceScene* scene, Method method,
                                        const glm::dvec3& position, const JobContext& job,
                                        TexelSources* sources) {
    auto map = mapBy(city, rems, scene, method, position, job, sources);
    if (map && !city.project().tuning.parallax)
        map->atInfinity = true;
    return map;
}

}  // namespace reflet
