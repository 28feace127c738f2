// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Reconstruct.h"

#include "core/baking/EnvironmentBaker.h"

#include <array>
#include <cassert>
#include <chrono>

namespace reflet {

namespace {

struct NamedMethod {
    Method method;
    const char* name;
};
constexpr std::array<NamedMethod, 4> kMethods{{{Method::Nearest, "nearest"},
                                               {Method::Blend, "blend"},
                                               {Method::Mem, "mem"},
                                               {Method::RayTrace, "raytrace"}}};

/// The truth: a map baked at the very place, in the full mesh.
Result<LocalEnvironmentMap> traceTruth(const RadianceScene& scene, const glm::dvec3& position,
                                       const Project& project, const JobContext& job) {
    const auto start = std::chrono::steady_clock::now();
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
    out.statistics.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return out;
}

}  // namespace

const char* toString(Method method) {
    for (const auto& known : kMethods) {
        if (known.method == method)
            return known.name;
    }
    return "";
}

Result<Method> methodFromString(std::string_view name) {
    for (const auto& known : kMethods) {
        if (name == known.name)
            return known.method;
    }
    return fail(ErrorCode::Usage, "there is no method of that name", std::string(name),
                "Choose among nearest, blend, mem, raytrace.");
}

const std::vector<Method>& allMethods() {
    static const std::vector<Method> methods{Method::Nearest, Method::Blend, Method::Mem,
                                             Method::RayTrace};
    return methods;
}

Result<LocalEnvironmentMap> reconstruct(const PreparedCity& city,
                                        std::span<const ReferenceEnvironmentMap> rems,
                                        const RadianceScene* scene, Method method,
                                        const glm::dvec3& position, const JobContext& job) {
    const ReconstructionInput input{&city.tracer(), rems, city.diameter()};
    const MemSettings& tuning = city.project().tuning;
    switch (method) {
        case Method::Nearest:
            return reconstructNearest(input, position, tuning.resolution);
        case Method::Blend:
            return reconstructBlend(input, position, tuning.resolution);
        case Method::Mem:
            return reconstructMem(input, position, tuning);
        case Method::RayTrace:
            break;
    }
    assert(scene != nullptr);
    return traceTruth(*scene, position, city.project(), job);
}

}  // namespace reflet
