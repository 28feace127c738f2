// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/ModelPlacement.h"

#include <cmath>

namespace reflet {

glm::dvec3 ModelPlacement::operator*(const glm::dvec3& inModel) const {
    // +y points to the bearing `heading`, +x a right angle clockwise of it.
    const double s = scale * std::sin(heading);
    const double c = scale * std::cos(heading);
    return offset +
           glm::dvec3(c * inModel.x + s * inModel.y, c * inModel.y - s * inModel.x, inModel.z);
}

ModelPlacement ModelPlacement::operator*(const ModelPlacement& inner) const {
    return {*this * inner.offset, std::remainder(heading + inner.heading, 2.0 * kPi),
            scale * inner.scale};
}

ModelPlacement inverse(const ModelPlacement& placement) {
    ModelPlacement out{glm::dvec3(0.0), -placement.heading, 1.0 / placement.scale};
    out.offset = -(out * placement.offset);
    return out;
}

void place(CityModel& model, const ModelPlacement& placement, const ProjectFrame& frame) {
    const glm::dvec3 own = model.frame.origin;
    for (glm::vec3& v : model.vertices)
        v = glm::vec3(placement * (own + glm::dvec3(v)) - frame.origin);
    model.frame = frame;
}

}  // namespace reflet
