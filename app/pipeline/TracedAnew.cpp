// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TracedAnew.h"

#include "app/pipeline/Reconstruct.h"
#include "core/gpu/city/CityView.h"
#include "core/gpu/reflection/VisibleBodies.h"
#include "core/traffic/Squeeze.h"

#include <algorithm>

namespace reflet {

std::vector<BodyInView> bodiesInView(const std::vector<PlacedReflector>& reflectors,
                                     const Camera& camera, int width, int height) {
    constexpr double kFade = 1.0;  // metres by which maps of neighbouring bodies reach over
    const CityView view = cityView(camera, width, height);
    std::vector<BodyInView> found;
    for (const PlacedReflector& reflector : reflectors) {
        for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
            const VehicleBody& body = reflector.vehicle->bodies[i];
            Box bounds;
            for (const glm::vec3& p : body.vertices)
                bounds.add(glm::dvec3(p));
            const glm::dvec3 size = bounds.size();
            bounds.min.x -= kFade;
            bounds.max.x += kFade;
            if (!columnsOf(bounds, reflector.poses[i], view))
                continue;
            const glm::dvec3 center = reflector.mapCenter(i);
            const double away = std::max(glm::distance(center, camera.position), double(view.near));
            found.push_back(
                {reflector.id, i, center, squeezeOf(*reflector.vehicle, body),
                 double(view.pixelsPerRadian()) * std::max({size.x, size.y, size.z}) / away});
        }
    }
    return found;
}

Result<void> TracedAnew::bring(Kept& kept, const BodyInView& body, const JobContext& job) {
    MemSettings settings = m_city.project().tuning;
    std::optional<Detail> detail;
    if (m_levelOfDetail) {
        detail =
            chooseDetail({body.pixels, body.squeeze, 1.0, kept.nearest}, settings, 0, kept.detail);
        if (detail->blend)
            detail->resolution = kSmallestMap;
        const bool serves = kept.map && kept.detail && kept.detail->atLeast(*detail) &&
                            glm::distance(kept.center, body.center) <= detail->reuse;
        if (serves)
            return {};
        settings = settingsOf(*detail, settings);
    }
    auto map =
        reconstruct(m_city.withTuning(settings), {}, &m_scene, Method::RayTrace, body.center, job);
    if (!map)
        return tl::unexpected(map.error());
    const auto& distances = map->distance.texels();
    const auto nearest = std::min_element(distances.begin(), distances.end());
    kept = {detail, body.center, nearest == distances.end() ? kept.nearest : double(*nearest),
            std::make_shared<const LocalEnvironmentMap>(std::move(*map))};
    ++m_traced;
    return {};
}

Result<GivenMaps> TracedAnew::maps(const std::vector<BodyInView>& bodies, const JobContext& job) {
    GivenMaps given;
    m_traced = 0;
    for (const BodyInView& body : bodies) {
        Kept& kept = m_kept[{body.reflector, body.body}];
        if (auto brought = bring(kept, body, job);
            !brought && (brought.error().code != ErrorCode::Refused || !kept.map)) {
            return tl::unexpected(brought.error());
        }
        auto& maps = given[body.reflector];
        maps.resize(std::max(maps.size(), body.body + 1));
        maps[body.body] = kept.map;
    }
    return given;
}

}  // namespace reflet
