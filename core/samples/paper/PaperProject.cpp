// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/ProjectParts.h"
#include "core/samples/paper/Paper.h"
#include "core/samples/paper/PaperPlan.h"

#include <fmt/format.h>

namespace reflet::paper {

namespace {

constexpr double kProbeHeight = 1.6;
constexpr double kStretchRoad = kRoads[1];  ///< y of the road that the measured stretch lies on
constexpr double kStretch = 142.5;          ///< half its length: 20 REMs 15 m apart

/// The paper's figure 8 shows REMs along the roads, close together where the vehicles drive: 20 on
/// the measured stretch, one at each other crossing (14), one halfway between crossings (20 of 23).
std::vector<glm::dvec2> probePlaces() {
    std::vector<glm::dvec2> places;
    for (int i = 0; i < 20; ++i) {
        places.emplace_back(-kStretch + 15.0 * i, kStretchRoad);
    }
    for (const double y : kRoads) {
        for (const double x : kRoads) {
            if (y != kStretchRoad || (x != kRoads[1] && x != kRoads[2])) {
                places.emplace_back(x, y);
            }
        }
    }
    for (const double at : {-200.0, 0.0, 200.0}) {
        for (const double road : kRoads) {
            if (road != kRoads[3] && !(road == kStretchRoad && at == 0.0)) {
                places.emplace_back(at, road);
            }
            places.emplace_back(road, at);
        }
    }
    return places;
}

}  // namespace

Project makeProject(const std::string& modelFileName) {
    Project project;
    project.name = "The test scene of 2003";
    ModelReference model;
    model.path = modelFileName;
    model.crs = "local";
    project.models.push_back(model);
    project.heightfield.cellSize = 0.5;
    project.bake.resolution = 128;
    int number = 0;
    for (const glm::dvec2& at : probePlaces()) {
        Probe probe;
        probe.id = fmt::format("rem-{:02}", ++number);
        probe.position = {at, kProbeHeight};
        project.probes.push_back(probe);
    }
    const double y = kStretchRoad;
    project.routes = {
        samples::routeOf("stretch-east", "Measured stretch, eastwards",
                         {{-135, y - kLane, 0}, {135, y - kLane, 0}}),
        samples::routeOf("stretch-west", "Measured stretch, westwards",
                         {{135, y + kLane, 0}, {-135, y + kLane, 0}}),
        samples::routeOf("north", "Northwards",
                         {{kRoads[2] + kLane, -480, 0}, {kRoads[2] + kLane, 480, 0}}),
        samples::routeOf("south", "Southwards",
                         {{kRoads[1] - kLane, 480, 0}, {kRoads[1] - kLane, -480, 0}}),
    };
    project.reflectors = {
        {"car-1", "car", "stretch-east", 8.0, 4.0},  {"car-2", "car", "stretch-east", 8.0, 34.0},
        {"car-3", "car", "stretch-west", 8.0, 60.0}, {"car-4", "car", "north", 10.0, 330.0},
        {"car-5", "car", "south", 10.0, 520.0},
    };
    project.views = {
        samples::viewOf("street", "A car in the middle of the stretch", {-2.5, y - 8.2, 1.5},
                        {-10.5, y + 0.5, 1.5}, 42, 15.5),
        samples::viewOf("trees", "Along the trees", {40, y - 8.6, 1.7}, {6, y + 8, 3.5}, 50, 15.5),
        samples::viewOf("crossing", "At the crossing", {92, y - 9.5, 1.7}, {60, y + 2, 3.0}, 50,
                        20.0),
        samples::viewOf("above", "The city from above", {-260, -420, 190}, {0, -60, 10}, 45, 15.0),
    };
    return project;
}

}  // namespace reflet::paper
