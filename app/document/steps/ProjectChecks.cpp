// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/steps/ProjectChecks.h"

#include "core/project/VehicleJson.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kFarthest = 1e9;  ///< metres from the CRS's origin

bool isPlace(const glm::dvec3& p) {
    return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}

template <class Number>
Number within(Number value, Number low, Number high, Number now) {
    return std::isnan(value) ? now : std::clamp(value, low, high);
}

Error fault(std::string what, std::string subject, std::string remedy) {
    return {ErrorCode::Usage, std::move(what), std::move(subject), std::move(remedy), {}};
}

constexpr const char* kPlaceRemedy = "Click a place on the ground of the city.";

}  // namespace

MemSettings withinRange(MemSettings tuning, const MemSettings& now) {
    constexpr double kLargestRatio = 1e9;
    constexpr double kLargestQuad = 4096.0;
    tuning.resolution = std::clamp(tuning.resolution, 8, 2048);
    tuning.meshSize = std::clamp(tuning.meshSize, 1, std::min(256, tuning.resolution));
    if (!std::isinf(tuning.depthRatio) || tuning.depthRatio < 0.0)
        tuning.depthRatio = within(tuning.depthRatio, 0.0, kLargestRatio, now.depthRatio);
    tuning.errorBound = within(tuning.errorBound, 0.0, 1024.0, now.errorBound);
    tuning.remsPerVehicle = std::clamp(tuning.remsPerVehicle, 1, kMostRems);
    tuning.smallestQuad = within(tuning.smallestQuad, 1.0, kLargestQuad, now.smallestQuad);
    tuning.lod.frameBudget = within(tuning.lod.frameBudget, LodSettings::kLeastBudget,
                                    LodSettings::kMostBudget, now.lod.frameBudget);
    tuning.lod.blur = within(tuning.lod.blur, 0.0, 1.0, now.lod.blur);
    return tuning;
}

BakeSettings withinRange(BakeSettings bake) {
    bake.resolution = std::clamp(bake.resolution, 32, 2048);
    bake.samplesPerEdge = std::clamp(bake.samplesPerEdge, 1, 16);
    return bake;
}

HeightfieldSettings withinRange(HeightfieldSettings heightfield, const HeightfieldSettings& now) {
    constexpr double kLargestCell = 1000.0;
    heightfield.cellSize = within(heightfield.cellSize, 0.0, kLargestCell, now.cellSize);
    heightfield.rules.clearance =
        within(heightfield.rules.clearance, 0.0, 100.0, now.rules.clearance);
    heightfield.cellLimit = now.cellLimit;  // not part of a project
    heightfield.maxCells = std::clamp<std::size_t>(heightfield.maxCells, 1, heightfield.cellLimit);
    return heightfield;
}

float turbidityWithinRange(float turbidity, float now) {
    // The reader compares as double, where 1.7F is below 1.7.
    constexpr float kClearest = 1.7000001F;
    return within(turbidity, kClearest, 10.0F, now);
}

float exposureWithinRange(float exposure, float now) {
    return within(exposure, 1.1e-6F, 1e6F, now);
}

Reflector withinRange(Reflector reflector, const Reflector& now) {
    reflector.speed = within(reflector.speed, 0.0, 200.0, now.speed);
    reflector.start = within(reflector.start, 0.0, 1e7, now.start);
    reflector.interest = within(reflector.interest, 0.0, kMostInterest, now.interest);
    return reflector;
}

View withinRange(View view) {
    constexpr double kRadiansPerDegree = kPi / 180.0;
    view.verticalFov =
        within(view.verticalFov, kRadiansPerDegree, 170.0 * kRadiansPerDegree, View{}.verticalFov);
    view.time = within(view.time, 0.0, 1e7, 0.0);
    return view;
}

VehicleModel withinRange(VehicleModel vehicle, const VehicleModel& now) {
    vehicle.scale = within(vehicle.scale, kSmallestVehicleScale, kLargestVehicleScale, now.scale);
    vehicle.heading =
        std::isfinite(vehicle.heading) ? std::remainder(vehicle.heading, 2.0 * kPi) : now.heading;
    return vehicle;
}

std::optional<Error> faultOf(const Probe& probe) {
    if (!isPlace(probe.position))
        return fault("this is no place for a probe", probe.id, kPlaceRemedy);
    if (probe.resolution && (*probe.resolution < 32 || *probe.resolution > 2048)) {
        return fault("the resolution is out of range", probe.id, "Choose 32 to 2048 texels.");
    }
    return std::nullopt;
}

std::optional<Error> faultOf(const RouteSpec& route) {
    if (!std::all_of(route.points.begin(), route.points.end(), isPlace))
        return fault("a point of the route is no place", route.id, kPlaceRemedy);
    const bool moves = std::any_of(
        route.points.begin(), route.points.end(),
        [&](const glm::dvec3& p) { return glm::dvec2(p) != glm::dvec2(route.points.front()); });
    if (!moves)
        return fault("the route leads nowhere", route.id, "Draw at least two different points.");
    if (!(route.cornerRadius >= 0.0 && route.cornerRadius <= 10'000.0)) {
        return fault("the corner radius is out of range", route.id, "Choose 0 to 10000 m.");
    }
    return std::nullopt;
}

std::optional<Error> faultOf(const View& view) {
    if (view.name.empty())
        return fault("a view needs a name", "", "Type a name.");
    if (!isPlace(view.position) || !isPlace(view.target))
        return fault("this is no place for a camera", view.name, "Move the camera to the city.");
    return std::nullopt;
}

std::optional<Error> faultOf(const VehicleModel& vehicle) {
    if (vehicle.path.empty())
        return fault("a vehicle model needs a file", vehicle.id, "Choose a glTF file.");
    if (!isPlace(vehicle.offset))
        return fault("the vehicle is moved to no place", vehicle.id, "Type lengths in metres.");
    return std::nullopt;
}

std::optional<Error> faultOf(const DateTime& date) {
    const auto read = parseDateTime(toIso8601(date), 0.0);
    if (!read)
        return fault("this is no date", toIso8601(date), "Choose a day of the calendar.");
    return std::nullopt;
}

}  // namespace reflet
