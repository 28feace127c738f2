// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/EnvironmentBaker.h"
#include "core/city/ModelPlacement.h"
#include "core/city/ReadingOptions.h"
#include "core/geo/SunPosition.h"
#include "core/heightfield/HeightfieldBuilder.h"
#include "core/reconstruction/Reconstruction.h"
#include "core/traffic/VehicleModel.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// What a model is to the project. A folder or a list of rasters is one model.
enum class ModelUse : std::uint8_t {
    City,
    Terrain,     ///< a raster of heights, or several that make one ground
    Orthophoto,  ///< a raster of colours, laid on the ground
};

/// A source of city data and how it is read.
struct ModelReference : ReadingOptions {
    std::string path;  ///< relative to the project file where that is possible, '/' separated
    std::string hash;  ///< ContentHash of the file's bytes when it was imported; may be empty
    ModelUse use = ModelUse::City;
    /// Of a model in local coordinates (crs "local"): where it stands. Of one with a CRS: the
    /// offset alone counts, and moves it from where it would stand.
    std::optional<ModelPlacement> placement = {};

    friend bool operator==(const ModelReference&, const ModelReference&) = default;
};

/// A place for a reference environment map. Positions in a project file are absolute: east, north
/// and up in the project's CRS and datum, doubles.
struct Probe {
    std::string id;
    glm::dvec3 position{0.0};       ///< absolute
    std::optional<int> resolution;  ///< of this one; else the project's
    bool locked = false;

    friend bool operator==(const Probe&, const Probe&) = default;
};

/// Where no probe is to be suggested: a circle in the plan.
struct NoProbeArea {
    std::string id;
    glm::dvec2 center{0.0};  ///< absolute
    double radius = 0.0;     ///< metres, above 0

    friend bool operator==(const NoProbeArea&, const NoProbeArea&) = default;
};

struct RouteSpec {
    std::string id;
    std::string name;
    std::vector<glm::dvec3> points;  ///< absolute; z of the running surface
    double cornerRadius = 0.0;       ///< metres, corners are rounded to at most this
    /// Of the line that it was read from, by name, so that a table of streets can be joined again.
    std::map<std::string, std::string> attributes = {};

    friend bool operator==(const RouteSpec&, const RouteSpec&) = default;
};

/// The most that a vehicle may matter to a planner.
inline constexpr double kMostInterest = 10.0;

/// A vehicle on a route.
struct Reflector {
    std::string id;
    std::string vehicle = "tram";  ///< a built-in vehicle, or the id of a VehicleModel
    std::string route;             ///< id of a RouteSpec
    double speed = 8.0;            ///< metres a second
    double start = 0.0;            ///< metres along the route at time 0
    /// How much it matters when not all reflections can be drawn in time: 2 counts as if it looked
    /// twice as large, 0 as if it were far away. Up to kMostInterest.
    double interest = 1.0;

    friend bool operator==(const Reflector&, const Reflector&) = default;
};

/// A named picture: a camera, and where the traffic is.
struct View {
    std::string name;
    std::string caption;
    glm::dvec3 position{0.0};  ///< absolute
    glm::dvec3 target{0.0};    ///< absolute
    double verticalFov = 0.9;  ///< radians in memory, degrees in the file
    double time = 0.0;         ///< seconds: reflectors stand where they are then

    friend bool operator==(const View&, const View&) = default;
};

/// Everything that a planner decides, and nothing derived. A value.
struct Project {
    std::string name;
    ProjectFrame frame;
    std::vector<ModelReference> models;
    HeightfieldSettings heightfield;
    BakeSettings bake;
    MemSettings tuning;
    std::vector<Probe> probes;
    std::vector<NoProbeArea> noProbes;
    std::vector<RouteSpec> routes;
    std::vector<VehicleModel> vehicles;  ///< brought by the user; ids are never built-in names
    std::vector<Reflector> reflectors;
    std::vector<View> views;
    DateTime date;
    float turbidity = 2.5F;
    float exposure = 1.0F;
    bool generatedGround = true;  ///< add a ground where the models have none
    /// The JSON text that the project was read from: keys that this version does not know are kept
    /// when it is saved. Empty for a new project.
    std::string source;
};

inline constexpr int kProjectSchemaVersion = 1;

/// JSON text of the project, keys sorted, two-space indent, ending in a newline.
[[nodiscard]] std::string projectToJson(const Project& project);
/// Unreadable for text that is no project; Refused for one of a newer schema version. Errors name
/// the JSON pointer of the offending value and what it should be. Numbers must be finite, ids
/// unique, references (a reflector's route) present.
[[nodiscard]] Result<Project> projectFromJson(const std::string& json, const std::string& subject);

}  // namespace reflet
