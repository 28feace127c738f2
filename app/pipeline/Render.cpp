// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Render.h"

#include "app/pipeline/TrafficMaps.h"
#include "core/math/Geometry.h"
#include "core/rendering/MapBodies.h"

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

/// Points along one flank of the vehicle that a good picture shows.
std::vector<glm::dvec3> flank(const PlacedReflector& reflector, const glm::dvec2& side) {
    std::vector<glm::dvec3> points;
    const glm::dvec3 out(side * 1.6, 0.0);
    for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
        const glm::dvec3 center = reflector.mapCenter(i);
        const double half = center.z - reflector.poses[i].translation.z;  // of the body's height
        for (const double share : {-0.6, 0.0, 0.6})
            points.push_back(center + out + glm::dvec3(0.0, 0.0, share * half));
    }
    return points;
}

/// The share of the points that the heightfield does not hide from the eye.
double visibleShare(const HeightfieldTracer& tracer, const glm::dvec3& eye,
                    const std::vector<glm::dvec3>& points) {
    std::size_t seen = 0;
    for (const auto& point : points) {
        const HeightfieldHit hit = tracer.trace({eye, point - eye});
        seen += !hit.hit || hit.t >= 1.0 ? 1 : 0;
    }
    return double(seen) / double(points.size());
}

/// The share of directions well above the horizon in which the sky is seen.
double skyShare(const HeightfieldTracer& tracer, const glm::dvec3& eye) {
    constexpr int kAround = 16;
    const double elevations[] = {25.0 / 180.0 * kPi, 55.0 / 180.0 * kPi};
    int free = 0;
    for (const double elevation : elevations) {
        for (int i = 0; i < kAround; ++i) {
            const double azimuth = 2.0 * kPi * i / kAround;
            const glm::dvec3 direction(std::cos(elevation) * std::cos(azimuth),
                                       std::cos(elevation) * std::sin(azimuth),
                                       std::sin(elevation));
            free += tracer.trace({eye, direction}).hit ? 0 : 1;
        }
    }
    return double(free) / double(2 * kAround);
}

/// Gives each body its map, those of far ones by the nearest probe.
Result<std::vector<LocalEnvironmentMap>> bodyMaps(TrafficMaps& traffic, const Camera& camera,
                                                  Method method, const JobContext& job) {
    std::vector<LocalEnvironmentMap> maps(traffic.bodies().size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (!reflectsAnything(*traffic.bodies()[i].vehicle))
            continue;
        const bool far = glm::distance(traffic.center(i), camera.position) > kReflectorRange;
        auto map = traffic.map(i, far && method != Method::Sky ? Method::Nearest : method, job);
        if (!map)
            return tl::unexpected(map.error());
        maps[i] = std::move(*map);
    }
    return maps;
}

Result<RenderedView> drawnBy(Method method, const PreparedCity& city, const RemSet& rems,
                             const std::vector<PlacedReflector>& reflectors, const Camera& camera,
                             const RenderOptions& options, const JobContext& job) {
    auto traffic =
        TrafficMaps::create(city, rems, reflectors, job.phase("building the scene", 0.0, 0.2));
    if (!traffic)
        return tl::unexpected(traffic.error());
    std::vector<PlacedBody> bodies = traffic->bodies();
    std::vector<LocalEnvironmentMap> maps;
    if (method == Method::PerPixel) {
        traffic->lookUpPixels(bodies);
    } else if (method != Method::RayTrace) {
        auto made = bodyMaps(*traffic, camera, method, job);
        if (!made)
            return tl::unexpected(made.error());
        maps = std::move(*made);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            bodies[i].map = maps[i].radiance.empty() ? nullptr : &maps[i];
    }
    const ViewSettings settings{options.width, options.height, options.samplesPerEdge};
    return renderView(traffic->scene(), bodies, camera, settings, job.phase("drawing", 0.2, 1.0));
}

/// Left of the wipe from one view, right of it from the other; the border as SceneRenderer has it.
RenderedView joined(RenderedView left, const RenderedView& right, float wipe) {
    const auto border = std::lround(std::clamp(wipe, 0.0F, 1.0F) * float(left.width));
    for (int y = 0; y < left.height; ++y) {
        const std::ptrdiff_t from = std::ptrdiff_t(y) * left.width + border;
        const std::ptrdiff_t to = std::ptrdiff_t(y + 1) * left.width;
        std::copy(right.radiance.begin() + from, right.radiance.begin() + to,
                  left.radiance.begin() + from);
        std::copy(right.reflector.begin() + from, right.reflector.begin() + to,
                  left.reflector.begin() + from);
    }
    return left;
}

/// Turns and zooms a camera so that the vehicle fills a 16 : 9 picture with some street around it.
void frame(Camera& camera, const PlacedReflector& reflector) {
    const double half = 0.5 * reflector.vehicle->length();
    const glm::dvec3 middle = reflector.middle();
    const glm::dvec2 heading = glm::normalize(glm::dvec2(reflector.heading()));
    const auto towards = [&](double along) {
        const glm::dvec2 place = glm::dvec2(middle) + heading * along;
        return glm::normalize(place - glm::dvec2(camera.position));
    };
    const glm::dvec2 nose = towards(half);
    const glm::dvec2 tail = towards(-half);
    const glm::dvec2 between = glm::normalize(nose + tail);
    const double angle = std::acos(std::clamp(glm::dot(nose, between), -1.0, 1.0));
    const double distance = glm::distance(glm::dvec2(middle), glm::dvec2(camera.position));
    camera.target = glm::dvec3(glm::dvec2(camera.position) + between * distance, middle.z + 0.4);
    const double horizontal = std::clamp(2.0 * angle + 0.35, 0.7, 1.6);
    camera.verticalFov = 2.0 * std::atan(std::tan(0.5 * horizontal) * 9.0 / 16.0);
}

}  // namespace

double streetSight(const PreparedCity& city, const PlacedReflector& reflector,
                   const glm::dvec3& eye) {
    constexpr double kEnoughSky = 0.2;  // a narrow street's; a yard between houses has less
    const glm::dvec2 heading = glm::normalize(glm::dvec2(reflector.heading()));
    const glm::dvec2 right(heading.y, -heading.x);
    const bool fromRight = glm::dot(glm::dvec2(eye - reflector.middle()), right) >= 0.0;
    const double share =
        visibleShare(city.tracer(), eye, flank(reflector, fromRight ? right : -right));
    const double sky = std::min(1.0, skyShare(city.tracer(), eye) / kEnoughSky);
    return share * (0.1 + 0.9 * sky);
}

Camera streetCamera(const PreparedCity& city, const PlacedReflector& reflector) {
    const glm::dvec3 middle = reflector.middle();
    const glm::dvec2 heading = glm::normalize(glm::dvec2(reflector.heading()));
    const glm::dvec2 side = sunSide(city.lighting(), heading);
    const double length = reflector.vehicle->length();
    double best = -1.0;
    Camera camera;
    // The first of equally good places wins: the sunny side, then near by, then further away.
    for (const double sign : {1.0, -1.0}) {
        for (const double aside : {4.0 + 0.15 * length, 3.2, 6.5 + 0.2 * length, 12.0}) {
            for (const double ahead :
                 {0.5 * length + 5.0, 0.5 * length + 2.0, 0.5 * length + 9.0}) {
                const glm::dvec2 place =
                    glm::dvec2(middle) + heading * ahead + side * (sign * aside);
                const double ground = std::max(city.groundHeight(place.x, place.y), middle.z - 3.0);
                const glm::dvec3 eye(place, ground + kEyeHeight);
                const double sight = streetSight(city, reflector, eye);
                if (sight > best + 0.01) {
                    best = sight;
                    camera.position = eye;
                }
            }
        }
    }
    frame(camera, reflector);
    return camera;
}

View streetView(const PreparedCity& city, const Traffic& traffic, std::size_t reflector) {
    const Drive& drive = traffic.drive(reflector);
    double best = -1.0;
    double station = 0.0;
    Camera camera;
    // From the middle outwards; a place further away must be clearly better.
    for (const double share : {0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82}) {
        const double there = share * traffic.route(reflector).length();
        const PlacedReflector placed = traffic.atStation(reflector, there);
        const Camera from = streetCamera(city, placed);
        const double sight = streetSight(city, placed, from.position);
        if (sight > best + 0.1) {
            best = sight;
            station = there;
            camera = from;
        }
    }
    View view;
    view.name = drive.id;
    view.caption = drive.id + " on " + drive.routeId;
    view.position = camera.position + city.project().frame.origin;
    view.target = camera.target + city.project().frame.origin;
    view.verticalFov = camera.verticalFov;
    view.time = traffic.secondsAt(reflector, station);
    return view;
}

std::vector<View> viewsOf(const PreparedCity& city, const Traffic& traffic) {
    if (!city.project().views.empty())
        return city.project().views;
    std::vector<View> views;
    for (std::size_t i = 0; i < traffic.size(); ++i)
        views.push_back(streetView(city, traffic, i));
    return views;
}

Camera cameraOf(const View& view, const ProjectFrame& frame) {
    return {frameFromAbsolute(frame, view.position), frameFromAbsolute(frame, view.target),
            view.verticalFov};
}

Result<RenderedView> renderPicture(const PreparedCity& city, const RemSet& rems,
                                   const std::vector<PlacedReflector>& reflectors,
                                   const Camera& camera, const RenderOptions& options,
                                   const JobContext& job) {
    if (!options.right)
        return drawnBy(options.method, city, rems, reflectors, camera, options, job);
    auto left = drawnBy(options.method, city, rems, reflectors, camera, options,
                        job.phase("left of the bar", 0.0, 0.5));
    if (!left)
        return left;
    const auto right = drawnBy(*options.right, city, rems, reflectors, camera, options,
                               job.phase("right of the bar", 0.5, 1.0));
    if (!right)
        return tl::unexpected(right.error());
    return joined(std::move(*left), *right, options.wipe);
}

DisplayImage toDisplayImage(const RenderedView& view, float exposure) {
    DisplayImage image{view.width, view.height, {}};
    image.pixels.reserve(view.radiance.size());
    for (const auto& radiance : view.radiance)
        image.pixels.push_back(toDisplay(radiance, exposure));
    return image;
}

}  // namespace reflet
