// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Vehicle.h"

#include "core/traffic/BuiltInVehicles.h"

#include <algorithm>

namespace reflet {
namespace {

struct BuiltIn {
    const char* name;
    Vehicle (*make)();
};

constexpr BuiltIn kBuiltIn[] = {
    {"tram", makeTram},     {"bus", makeBus},     {"car", makeCar},
    {"sphere", makeSphere}, {"woman", makeWoman}, {"man", makeMan},
    {"child", makeChild},   {"whale", makeWhale}, {"mirror-tree", makeMirrorTree}};

}  // namespace

double Vehicle::length() const {
    double rear = 0.0;
    double front = 0.0;
    bool first = true;
    for (const VehicleBody& body : bodies) {
        for (const glm::vec3& v : body.vertices) {
            const double x = body.offset + double(v.x);
            rear = first ? x : std::min(rear, x);
            front = first ? x : std::max(front, x);
            first = false;
        }
    }
    return front - rear;
}

Result<Vehicle> builtInVehicle(std::string_view name) {
    for (const BuiltIn& candidate : kBuiltIn) {
        if (name == candidate.name) {
            return candidate.make();
        }
    }
    return fail(ErrorCode::Usage, "there is no built-in vehicle of this name", std::string(name),
                "use tram, bus, car, sphere, woman, man, child, whale or mirror-tree");
}

std::vector<std::string> builtInVehicleNames() {
    std::vector<std::string> names;
    for (const BuiltIn& candidate : kBuiltIn) {
        names.emplace_back(candidate.name);
    }
    return names;
}

}  // namespace reflet
