// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/ProjectParts.h"

#include "core/math/Geometry.h"

#include <utility>

namespace reflet::samples {

RouteSpec routeOf(const char* id, const char* name, std::vector<glm::dvec3> points,
                  double cornerRadius) {
    RouteSpec spec;
    spec.id = id;
    spec.name = name;
    spec.points = std::move(points);
    spec.cornerRadius = cornerRadius;
    return spec;
}

View viewOf(const char* name, const char* caption, const glm::dvec3& eye, const glm::dvec3& target,
            double fov, double time) {
    View v;
    v.name = name;
    v.caption = caption;
    v.position = eye;
    v.target = target;
    v.verticalFov = fov * kPi / 180.0;
    v.time = time;
    return v;
}

}  // namespace reflet::samples
