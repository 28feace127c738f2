// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GlRender.h"

#include "app/pipeline/GlStage.h"
#include "app/pipeline/TrafficMaps.h"

#include <chrono>

namespace reflet {

namespace {

/// Ray traced maps of all bodies, as Method::RayTrace wants them.
Result<GivenMaps> givenMaps(const PreparedCity& city,
                            const std::vector<PlacedReflector>& reflectors, const JobContext& job) {
    auto maps = tracedMaps(city, reflectors, job);
    if (!maps)
        return tl::unexpected(maps.error());
    GivenMaps given;
    for (std::size_t i = 0; i < reflectors.size(); ++i)
        given[reflectors[i].id] = std::move((*maps)[i]);
    return given;
}

}  // namespace

Result<DisplayImage> drawFrame(const PreparedCity& city, const RemSet& rems,
                               const FrameRequest& frame, const JobContext& job) {
    const auto renderer = glStage(city, job);
    if (!renderer)
        return tl::unexpected(renderer.error());
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    (*renderer)->setRems(rems);
    return (*renderer)->drawImage(frame);
}

Result<DisplayImage> renderPictureGl(const PreparedCity& city, const RemSet& rems,
                                     const std::vector<PlacedReflector>& reflectors,
                                     const Camera& camera, const RenderOptions& options,
                                     const JobContext& job) {
    FrameRequest request;
    request.width = options.width;
    request.height = options.height;
    request.samplesPerEdge = options.samplesPerEdge;
    request.camera = camera;
    request.exposure = city.project().exposure;
    request.reflectors = reflectors;
    request.tuning = city.project().tuning;
    request.method = options.method;
    request.right = options.right;
    request.wipe = options.wipe;
    if (options.method == Method::RayTrace || options.right == Method::RayTrace) {
        auto given = givenMaps(city, reflectors, job);
        if (!given)
            return tl::unexpected(given.error());
        request.given = std::move(*given);
    }
    return drawFrame(city, rems, request, job);
}

Result<LocalEnvironmentMap> rerenderMap(const PreparedCity& city, const glm::dvec3& position,
                                        const JobContext& job) {
    const auto renderer = glStage(city, job);
    if (!renderer)
        return tl::unexpected(renderer.error());
    const auto start = std::chrono::steady_clock::now();
    LocalEnvironmentMap map =
        (*renderer)->localMap(Method::Rerender, position, city.project().tuning);
    map.statistics.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return map;
}

Result<ReferenceEnvironmentMap> drawReferenceMap(const PreparedCity& city, const std::string& id,
                                                 const glm::dvec3& position,
                                                 const BakeSettings& settings,
                                                 const JobContext& job) {
    const auto renderer = glStage(city, job);
    if (!renderer)
        return tl::unexpected(renderer.error());
    return (*renderer)->bake(id, position, settings);
}

}  // namespace reflet
