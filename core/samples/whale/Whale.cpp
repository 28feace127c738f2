// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/whale/Whale.h"

#include "core/samples/kit/ProjectParts.h"
#include "core/samples/paper/Paper.h"
#include "core/samples/paper/PaperPlan.h"

#include <fmt/format.h>

namespace reflet::whale {

namespace {

using paper::kLane;
using paper::kPavementHeight;
using paper::kRoadHalf;

constexpr double kRoad = paper::kRoads[1];         ///< y of the road that the whale flies along
constexpr double kFlight = 9.0;                    ///< metres of its height there
constexpr double kProbeEvery = 30.0;               ///< metres, of the probes in the air
constexpr double kWalk = kRoad + kRoadHalf + 2.2;  ///< y of the pavement that people walk on
constexpr double kCrossing = 12.0;                 ///< x where they cross

/// It dives into the street, flies along it and rises again.
std::vector<glm::dvec3> flight() {
    return {{-230, kRoad, 34},     {-150, kRoad, 24},    {-80, kRoad + 0.5, kFlight + 2},
            {-20, kRoad, kFlight}, {40, kRoad, kFlight}, {100, kRoad, kFlight + 2},
            {100, kRoad + 90, 26}};
}

/// At the whale's own height, and at the trees.
void addProbes(Project& project) {
    int number = 0;
    for (double x = -150.0; x <= 100.0; x += kProbeEvery) {
        Probe probe;
        probe.id = fmt::format("air-{:02}", ++number);
        const double z = x < -80.0 ? kFlight + 2.0 + (-80.0 - x) * 13.0 / 70.0 : kFlight;
        probe.position = {x, kRoad, z + 2.6};
        project.probes.push_back(probe);
    }
}

}  // namespace

Project makeProject(const std::string& modelFileName) {
    Project project = paper::makeProject(modelFileName);
    project.name = "The city invaded by a whale";
    addProbes(project);
    project.routes.push_back(samples::routeOf("flight", "The whale's way", flight(), 40.0));
    project.routes.push_back(samples::routeOf(
        "grove", "Where the mirror trees stand",
        {{-45, kRoad + 14.6, kPavementHeight}, {45, kRoad + 14.6, kPavementHeight}}, 0.0));
    project.routes.push_back(
        samples::routeOf("pavement", "Along the pavement",
                         {{-60, kWalk, kPavementHeight}, {60, kWalk, kPavementHeight}}, 0.0));
    project.routes.push_back(samples::routeOf(
        "pavement-back", "Along the pavement, westwards",
        {{60, kWalk + 0.9, kPavementHeight}, {-60, kWalk + 0.9, kPavementHeight}}, 0.0));
    project.routes.push_back(
        samples::routeOf("crossing", "Across the street",
                         {{kCrossing, kWalk, kPavementHeight},
                          {kCrossing, kRoad + kRoadHalf, 0.0},
                          {kCrossing, kRoad - kRoadHalf, 0.0},
                          {kCrossing, kRoad - kRoadHalf - 2.2, kPavementHeight}},
                         0.0));
    project.reflectors = {
        {"whale", "whale", "flight", 9.0, 20.0},
        {"tree-1", "mirror-tree", "grove", 0.0, 15.0},
        {"tree-2", "mirror-tree", "grove", 0.0, 36.0},
        {"tree-3", "mirror-tree", "grove", 0.0, 76.0},
        {"car-1", "car", "stretch-east", 8.0, 75.0},
        {"car-2", "car", "stretch-west", 8.0, 30.0},
        {"anna", "woman", "pavement", 1.35, 38.0},
        {"tom", "child", "pavement", 1.35, 38.9},
        {"ben", "man", "pavement-back", 1.4, 40.0},
        {"clara", "woman", "crossing", 1.3, 0.0},
        {"dan", "man", "crossing", 1.2, 2.3},
    };
    const double y = kRoad;
    project.views = {
        samples::viewOf("whale", "A whale over the street", {6, y - 8.8, 1.7}, {-15, y + 1, 8.2},
                        42, 21.3),
        samples::viewOf("mirror", "The street in the whale's side", {-4, y - 9.4, 3.0},
                        {-12.5, y, 10.8}, 54, 21.8),
        samples::viewOf("trees", "Mirror trees and people", {-19, y + 7.6, 1.7},
                        {-9.5, y + 13.6, 3.3}, 50, 8.0),
        samples::viewOf("crossing", "A car waits for people", {21, y - 8.6, 1.65},
                        {9, y - 2.0, 1.3}, 40, 8.8),
    };
    return project;
}

Sample makeWhaleCity(std::uint64_t seed) {
    Sample sample = paper::makePaper(seed);
    sample.modelFileName = "whale.city.json";
    sample.project = makeProject(sample.modelFileName);
    return sample;
}

}  // namespace reflet::whale
