// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Mesh.h"

#include <string>
#include <vector>

namespace reflet::kit {

/// A template set up somewhere: turned by `heading` counter-clockwise, scaled, then shifted.
struct Placement {
    std::size_t shape = 0;  ///< index into SampleCity::templates
    glm::dvec3 anchor{0.0};
    double heading = 0.0;  ///< radians
    double scale = 1.0;
};

struct SampleObject {
    std::string id;
    CityObjectType type = CityObjectType::Generic;
    Mesh mesh;  ///< may be empty when there are placements
    std::vector<Placement> placements;
};

/// A city before it is written: local metres about the place that `writeCityJson` puts it at.
struct SampleCity {
    std::string title;
    std::vector<SampleObject> objects;
    std::vector<Mesh> templates;

    SampleObject& add(std::string id, CityObjectType type) {
        objects.push_back({std::move(id), type, {}, {}});
        return objects.back();
    }
    std::size_t addTemplate(Mesh mesh) {
        templates.push_back(std::move(mesh));
        return templates.size() - 1;
    }
};

}  // namespace reflet::kit
