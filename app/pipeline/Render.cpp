// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Render.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kEyeHeight = 1.6;  // metres, of somebody on the pavement
constexpr double kReflectorRange =
    400;  // metres from the camera beyond which a map is not worth it

/// The horizontal unit vector from which the sun shines, or from the right of the heading at night.
glm::dvec2 sunSide(const Lighting& light, const glm::dvec2& heading) {
    const glm::dvec2 right(heading.y, -heading.x);
    const glm::dvec2 sun(light.sunDirection);
    return glm::dot(sun, right) < 0.0 ? -right : right;
}

/// The greatest share of the way from `from` to `to` that is free of the heightfield.
double freeShare(const HeightfieldTracer& tracer, const glm::dvec3& from, const glm::dvec3& to) {
    const HeightfieldHit hit = tracer.trace({from, to - from});
    return hit.hit ? std::clamp(hit.t, 0.0, 1.0) : 1.0;
}

std::vector<LocalEnvironmentMap> bodyMaps(const PreparedCity& city,
                                          std::span<const ReferenceEnvironmentMap> rems,
                                          const std::vector<PlacedReflector>& reflectors,
                                          const Camera& camera, Method method,
                                          const JobContext& job, Result<void>& status) {
    std::vector<LocalEnvironmentMap> maps;
    for (const auto& reflector : reflectors) {
        for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
            const glm::dvec3 center = reflector.mapCenter(i);
            const bool far = glm::distance(center, camera.position) > kReflectorRange;
            const Method chosen = far ? Method::Nearest : method;
            auto map = reconstruct(city, rems, nullptr, chosen, center, job);
            if (!map) {
                status = tl::unexpected(map.error());
                return maps;
            }
            maps.push_back(std::move(*map));
        }
    }
    return maps;
}

}  // namespace

Camera streetCamera(const PreparedCity& city, const PlacedReflector& reflector) {
    const glm::dvec3 middle = reflector.middle();
    const glm::dvec2 heading = glm::normalize(glm::dvec2(reflector.heading()));
    const glm::dvec2 side = sunSide(city.lighting(), heading);
    const double length = reflector.vehicle->length();
    const double ahead = 0.5 * length + 2.0;
    const double aside = 5.0 + 0.18 * length;

    double best = 0.0;
    Camera camera;
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec2 place = glm::dvec2(middle) + heading * ahead + side * (sign * aside);
        glm::dvec3 eye(place, 0.0);
        eye.z = std::max(city.groundHeight(place.x, place.y), middle.z - 3.0) + kEyeHeight;
        const glm::dvec3 start = middle + glm::dvec3(0.0, 0.0, 2.0);
        const double share = freeShare(city.tracer(), start, eye);
        if (share > best + 0.05) {
            best = share;
            camera.position = start + (eye - start) * (share < 1.0 ? 0.9 * share : 1.0);
        }
    }
    camera.target = middle + glm::dvec3(heading * (0.12 * length), 0.2);
    camera.verticalFov = 0.85;
    return camera;
}

std::vector<View> viewsOf(const PreparedCity& city, const Traffic& traffic) {
    if (!city.project().views.empty())
        return city.project().views;
    std::vector<View> views;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
        const Reflector& reflector = traffic.reflector(i);
        const double middle = 0.5 * traffic.route(i).length();
        const Camera camera = streetCamera(city, traffic.atStation(i, middle));
        View view;
        view.name = reflector.id;
        view.caption = reflector.id + " on " + reflector.route;
        view.position = camera.position + city.project().frame.origin;
        view.target = camera.target + city.project().frame.origin;
        view.verticalFov = camera.verticalFov;
        view.time = reflector.speed > 0.0
                        ? std::max(0.0, (middle - reflector.start) / reflector.speed)
                        : 0.0;
        views.push_back(std::move(view));
    }
    return views;
}

std::vector<PlacedReflector> placeAll(const Traffic& traffic, double seconds) {
    std::vector<PlacedReflector> placed;
    for (std::size_t i = 0; i < traffic.size(); ++i)
        placed.push_back(traffic.at(i, seconds));
    return placed;
}

Camera cameraOf(const View& view, const ProjectFrame& frame) {
    return {view.position - frame.origin, view.target - frame.origin, view.verticalFov};
}

Result<RenderedView> renderPicture(PreparedCity& city,
                                   std::span<const ReferenceEnvironmentMap> rems,
                                   const std::vector<PlacedReflector>& reflectors,
                                   const Camera& camera, const RenderOptions& options,
                                   const JobContext& job) {
    const BodyGeometry geometry(reflectors);
    std::vector<PlacedBody> bodies = geometry.bodies();
    std::vector<LocalEnvironmentMap> maps;
    if (options.method != Method::RayTrace) {
        Result<void> status;
        maps = bodyMaps(city, rems, reflectors, camera, options.method, job, status);
        if (!status)
            return tl::unexpected(status.error());
        for (std::size_t i = 0; i < bodies.size(); ++i)
            bodies[i].map = &maps[i];
    }
    auto scene = city.sceneWith(geometry.occluders(), job.phase("building the scene", 0.0, 0.2));
    if (!scene)
        return tl::unexpected(scene.error());
    const ViewSettings settings{options.width, options.height, options.samplesPerEdge};
    return renderView(**scene, bodies, camera, settings, job.phase("drawing", 0.2, 1.0));
}

DisplayImage toDisplayImage(const RenderedView& view, float exposure) {
    DisplayImage image{view.width, view.height, {}};
    image.pixels.reserve(view.radiance.size());
    for (const auto& radiance : view.radiance)
        image.pixels.push_back(toDisplay(radiance, exposure));
    return image;
}

}  // namespace reflet
