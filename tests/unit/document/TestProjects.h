// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"

#include <string>

namespace reflet::test {

/// A project with something in every list, and keys that Reflet does not know.
[[nodiscard]] inline Project richProject() {
    Project project;
    project.name = "rich";
    project.frame.origin = {85'000.0, 446'000.0, 0.0};
    ReadingOptions buildings;
    buildings.lod = "2.2";
    buildings.types = {"Building"};
    ReadingOptions dutch;
    dutch.crs = "EPSG:28992";
    project.models = {{buildings, "city.city.json", "00ff"}, {dutch, "roads/roads.city.json", ""}};
    for (int i = 1; i <= 4; ++i) {
        project.probes.push_back(
            {"p" + std::to_string(i), {85'000.0 + 10.0 * i, 446'010.0, 3.0}, std::nullopt, false});
    }
    project.routes = {{"line-1",
                       "Line 1",
                       {{85'000, 446'000, 1}, {85'100, 446'000, 1}, {85'100, 446'080, 2}},
                       12},
                      {"line-2", "", {{85'000, 446'050, 1}, {85'050, 446'050, 1}}, 0}};
    project.vehicles = {{"bike", "bike.glb", "", VehicleUp::PlusY, 1.0, 0.0, {0, 0, 0}, true}};
    project.reflectors = {{"tram-1", "tram", "line-1", 8.0, 5.0},
                          {"car-1", "car", "line-2", 12.0, 0.0},
                          {"bike-1", "bike", "line-1", 4.0, 60.0}};
    project.views = {
        {"corner", "At the corner", {85'010, 445'990, 2}, {85'050, 446'000, 2}, 0.9, 4}};
    project.source = R"({"schema": "reflet-project", "version": 1, "note": "by hand",
        "models": [{"path": "city.city.json", "licence": "CC0"}],
        "probes": [{"id": "p2", "note": "on the bridge"}],
        "routes": [{"id": "line-1", "operator": "GVB"}]})";
    return project;
}

/// One of two projects of 500 kB that differ everywhere: their names are "even" and "odd".
[[nodiscard]] inline Project largeProject(bool odd) {
    constexpr std::size_t kBytes = std::size_t{500} * 1000;
    Project project;
    project.name = odd ? "odd" : "even";
    project.probes.push_back({project.name, {1.0, odd ? 2.0 : 3.0, 4.0}, std::nullopt, odd});
    View view;
    view.name = project.name;
    view.caption = std::string(kBytes, odd ? 'o' : 'e');
    project.views.push_back(std::move(view));
    return project;
}

}  // namespace reflet::test
