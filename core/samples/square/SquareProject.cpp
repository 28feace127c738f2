// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/ProjectParts.h"
#include "core/samples/square/Square.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

namespace reflet::square {

namespace {

constexpr double kProbeHeight = 1.65;  ///< above the rails: where a tram's side windows begin

glm::dvec3 absolute(double x, double y, double z) {
    return {kPlaceEast + x, kPlaceNorth + y, kPlaceHeight + z};
}

RouteSpec route(const char* id, const char* name, const std::vector<glm::dvec2>& line, double z,
                double radius) {
    RouteSpec spec;
    spec.id = id;
    spec.name = name;
    spec.cornerRadius = radius;
    for (const glm::dvec2& p : line) {
        spec.points.push_back(absolute(p.x, p.y, z));
    }
    return spec;
}

View view(const char* name, const char* caption, const glm::dvec3& eye, const glm::dvec3& target,
          double fov, double time) {
    return samples::viewOf(name, caption, absolute(eye.x, eye.y, eye.z),
                           absolute(target.x, target.y, target.z), fov, time);
}

std::vector<View> views() {
    return {
        view("arcades", "The tram before the arcades", {52, 24.4, 1.7}, {10, 21.4, 5.2}, 48, 29.5),
        view("avenue", "Down the avenue", {-88, 10.9, 1.7}, {-125, 7.4, 4.4}, 50, 11.2),
        view("park", "Along the park", {127, 12.4, 1.7}, {92, 16.4, 4.0}, 50, 38.7),
        view("close", "Arcades in the tram's side", {30.5, 24.2, 1.65}, {23.0, 18.4, 2.3}, 46,
             29.0),
        view("balcony", "From a balcony over the square", {58, 32.4, 12.0}, {-20, -10, 3.4}, 50,
             28.6),
    };
}

}  // namespace

Project makeProject(const std::string& modelFileName) {
    Project project;
    project.name = "A city square";
    project.frame.crs = "EPSG:2154";
    project.frame.vertical = "EPSG:5720";
    project.frame.origin = frameOrigin({kPlaceEast, kPlaceNorth, kPlaceHeight});
    ModelReference model;
    model.path = modelFileName;
    project.models.push_back(model);
    project.heightfield.cellSize = 0.5;
    project.routes.push_back(route("tram-east", "Tram towards the park", tramRoute(), kRail, 0.0));
    project.routes.push_back(route("park-lane", "Street along the park", parkLane(), 0.0, 7.0));
    project.routes.push_back(route("avenue-lane", "Avenue", avenueLane(), 0.0, 7.0));
    // The tram's 33 m fit on the route from the first second on.
    project.reflectors.push_back({"tram", "tram", "tram-east", 8.0, 18.0});
    project.reflectors.push_back({"car", "car", "park-lane", 7.0, 20.0});
    project.reflectors.push_back({"bus", "bus", "avenue-lane", 6.0, 30.0});
    int number = 0;
    for (const glm::dvec2& at : stationsAlong(tramRoute(), 7.5, 15.0)) {
        Probe probe;
        probe.id = fmt::format("rem-{:02}", ++number);
        probe.position = absolute(at.x, at.y, kRail + kProbeHeight);
        project.probes.push_back(probe);
    }
    project.views = views();
    project.exposure = 1.15F;
    project.bake.resolution = 256;  // as for stills: windows show their balconies
    project.tuning.resolution = 256;
    project.date = DateTime{2026, 5, 15, 10, 0, 0.0, 2.0};
    return project;
}

}  // namespace reflet::square
