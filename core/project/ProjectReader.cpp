// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/JsonReader.h"
#include "core/project/Migrations.h"
#include "core/project/ModelJson.h"
#include "core/project/Project.h"
#include "core/project/VehicleJson.h"
#include "core/traffic/Vehicle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace reflet {

namespace {

using nlohmann::json;

constexpr double kRadiansPerDegree = kPi / 180.0;

void readFrame(const JsonReader& reader, ProjectFrame& frame) {
    const JsonReader crs = reader.object("crs");
    for (auto [key, target] :
         {std::pair{"horizontal", &frame.crs}, std::pair{"vertical", &frame.vertical}}) {
        if (!crs.has(key) || crs.raw(key).is_null())
            continue;
        std::string text;
        crs.read(key, text);
        *target = text;
    }
    crs.read("origin", frame.origin);
}

std::optional<ModelPlacement> readPlacement(const JsonReader& reader) {
    if (reader.raw("placement").is_null())
        return std::nullopt;
    const JsonReader item = reader.object("placement");
    ModelPlacement placement;
    item.read("offset", placement.offset);
    double degrees = 0.0;
    item.read("heading", degrees, -360.0, 360.0);
    placement.heading = degrees * kRadiansPerDegree;
    item.read("scale", placement.scale, kSmallestModelScale, kLargestModelScale);
    return placement;
}

void readUse(const JsonReader& reader, ModelUse& use) {
    std::string text = useText(use);
    reader.read("use", text);
    if (const auto parsed = useFromText(text))
        use = *parsed;
    else
        reader.fail("use", "\"city\", \"terrain\" or \"ortho\"");
}

constexpr double kLowestBuilding = 0.1, kHighestBuilding = 2000.0;  // metres
constexpr double kSmallestUnit = 1e-6, kLargestUnit = 1e6;          // metres
constexpr double kCoarsestTile = 1e6;                               // metres

ModelReference readModel(const JsonReader& reader) {
    ModelReference model;
    reader.require("path");
    reader.read("path", model.path);
    reader.read("hash", model.hash);
    reader.read("crs", model.crs);
    reader.read("lod", model.lod);
    reader.read("types", model.types);
    readUse(reader, model.use);
    model.placement = readPlacement(reader);
    reader.read("heightField", model.heightField);
    reader.read("crownField", model.crownField);
    reader.read("baseField", model.baseField);
    if (reader.has("defaultHeight")) {
        model.defaultHeight = 1.0;
        reader.read("defaultHeight", *model.defaultHeight, kLowestBuilding, kHighestBuilding);
    }
    reader.read("upAxis", model.upAxis);
    if (!model.upAxis.empty() && model.upAxis != "y" && model.upAxis != "z")
        reader.fail("upAxis", "\"y\" or \"z\"");
    if (reader.has("unit")) {
        model.unit = 1.0;
        reader.read("unit", *model.unit, kSmallestUnit, kLargestUnit);
    }
    if (reader.has("geometricError")) {
        model.geometricError = 0.0;
        reader.read("geometricError", *model.geometricError, 0.0, kCoarsestTile);
    }
    reader.read("axisOrder", model.axisOrder);
    if (!model.axisOrder.empty() && model.axisOrder != "en" && model.axisOrder != "ne")
        reader.fail("axisOrder", "\"en\" or \"ne\"");
    const json& box = reader.raw("bbox");
    if (box.is_null())
        return model;
    std::array<double, 4> values{};
    const bool fits =
        box.is_array() && box.size() == 4 && std::all_of(box.begin(), box.end(), [](const json& v) {
            return v.is_number() && std::isfinite(v.get<double>());
        });
    if (!fits) {
        reader.fail("bbox", "four numbers: E0, N0, E1, N1");
        return model;
    }
    for (std::size_t i = 0; i < 4; ++i)
        values[i] = box[i].get<double>();
    model.bbox = values;
    return model;
}

void readLod(const JsonReader& reader, LodSettings& lod) {
    reader.read("on", lod.on);
    reader.read("frameBudget", lod.frameBudget, LodSettings::kLeastBudget,
                LodSettings::kMostBudget);
    reader.read("blur", lod.blur, 0.0, 1.0);
}

void readTuning(const JsonReader& reader, MemSettings& tuning) {
    reader.read("meshSize", tuning.meshSize, 1, 256);
    if (reader.has("depthRatio") && reader.raw("depthRatio").is_null()) {
        tuning.depthRatio = std::numeric_limits<double>::infinity();
    } else {
        reader.read("depthRatio", tuning.depthRatio, 0.0, 1e9);
    }
    reader.read("errorBound", tuning.errorBound, 0.0, 1024.0);
    reader.read("smallestQuad", tuning.smallestQuad, 1.0, 4096.0);
    reader.read("refineAtValidity", tuning.refineAtValidity);
    reader.read("traceEdgeTexels", tuning.traceEdgeTexels);
    reader.read("refineHits", tuning.refineHits);
    reader.read("parallax", tuning.parallax);
    reader.read("resolution", tuning.resolution, 8, 2048);
    reader.read("probesPerVehicle", tuning.remsPerVehicle, 1, kMostRems);
    std::string weighting = "by-sight";
    reader.read("weighting", weighting);
    if (weighting != "by-sight" && weighting != "as-in-paper")
        reader.fail("weighting", "\"by-sight\" or \"as-in-paper\"");
    tuning.weighting = weighting == "by-sight" ? Weighting::BySight : Weighting::AsInPaper;
    std::string interpolation = "exact";
    reader.read("interpolation", interpolation);
    if (interpolation != "exact" && interpolation != "as-in-paper") {
        reader.fail("interpolation", "\"exact\" or \"as-in-paper\"");
    }
    tuning.interpolation =
        interpolation == "exact" ? Interpolation::Exact : Interpolation::AsInPaper;
    readLod(reader.object("levelOfDetail"), tuning.lod);
}

Probe readProbe(const JsonReader& reader) {
    Probe probe;
    reader.require("id");
    reader.require("position");
    reader.read("id", probe.id);
    reader.read("position", probe.position);
    reader.read("locked", probe.locked);
    if (reader.has("resolution") && !reader.raw("resolution").is_null()) {
        int resolution = 128;
        reader.read("resolution", resolution, 32, 2048);
        probe.resolution = resolution;
    }
    return probe;
}

RouteSpec readRoute(const JsonReader& reader) {
    RouteSpec route;
    reader.require("id");
    reader.require("points");
    reader.read("id", route.id);
    reader.read("name", route.name);
    reader.read("cornerRadius", route.cornerRadius, 0.0, 10'000.0);
    const json& points = reader.raw("points");
    if (!points.is_array()) {
        reader.fail("points", "a list of [east, north, up]");
        return route;
    }
    for (const auto& value : points) {
        const auto point = tripleFromJson(value);
        if (!point) {
            reader.fail("points", "a list of [east, north, up] with finite numbers");
            return route;
        }
        route.points.push_back(*point);
    }
    const bool moves = std::any_of(
        route.points.begin(), route.points.end(),
        [&](const glm::dvec3& p) { return glm::dvec2(p) != glm::dvec2(route.points.front()); });
    if (!moves)
        reader.fail("points", "at least two different places");
    const json& attributes = reader.raw("attributes");
    if (!attributes.is_null() && !attributes.is_object())
        reader.fail("attributes", "an object of texts");
    for (const auto& [name, value] : attributes.items()) {
        if (value.is_string())
            route.attributes[name] = value.get<std::string>();
        else
            reader.fail("attributes", "an object of texts");
    }
    return route;
}

NoProbeArea readNoProbeArea(const JsonReader& reader) {
    NoProbeArea area;
    for (const char* key : {"id", "center", "radius"})
        reader.require(key);
    reader.read("id", area.id);
    reader.read("radius", area.radius, 0.01, 1e6);
    const json& center = reader.raw("center");
    const auto number = [&](std::size_t k) {
        return center.is_array() && center.size() == 2 && center[k].is_number()
                   ? center[k].get<double>()
                   : std::numeric_limits<double>::quiet_NaN();
    };
    area.center = {number(0), number(1)};
    if (!std::isfinite(area.center.x) || !std::isfinite(area.center.y)) {
        reader.fail("center", "[east, north] with finite numbers");
        area.center = {};
    }
    return area;
}

Reflector readReflector(const JsonReader& reader) {
    Reflector reflector;
    reader.require("id");
    reader.require("route");
    reader.read("id", reflector.id);
    reader.read("vehicle", reflector.vehicle);
    reader.read("route", reflector.route);
    reader.read("speed", reflector.speed, 0.0, 200.0);
    reader.read("start", reflector.start, 0.0, 1e7);
    reader.read("interest", reflector.interest, 0.0, kMostInterest);
    return reflector;
}

VehicleModel readVehicle(const JsonReader& reader) {
    VehicleModel vehicle;
    reader.require("id");
    reader.require("path");
    reader.read("id", vehicle.id);
    reader.read("path", vehicle.path);
    reader.read("hash", vehicle.hash);
    std::string up = upText(vehicle.up);
    reader.read("up", up);
    if (const auto parsed = upFromText(up)) {
        vehicle.up = *parsed;
    } else {
        reader.fail("up", "one of \"+y\", \"-y\", \"+z\", \"-z\", \"+x\", \"-x\"");
    }
    reader.read("scale", vehicle.scale, kSmallestVehicleScale, kLargestVehicleScale);
    double degrees = 0.0;
    reader.read("heading", degrees, -360.0, 360.0);
    vehicle.heading = degrees * kRadiansPerDegree;
    reader.read("offset", vehicle.offset);
    reader.read("coat", vehicle.coat);
    const auto builtIn = builtInVehicleNames();
    if (std::find(builtIn.begin(), builtIn.end(), vehicle.id) != builtIn.end())
        reader.fail("id", "a name that no built-in vehicle has");
    return vehicle;
}

View readView(const JsonReader& reader) {
    View view;
    reader.require("name");
    reader.require("position");
    reader.require("target");
    reader.read("name", view.name);
    reader.read("caption", view.caption);
    reader.read("position", view.position);
    reader.read("target", view.target);
    reader.read("time", view.time, 0.0, 1e7);
    double degrees = view.verticalFov / kRadiansPerDegree;
    reader.read("verticalFov", degrees, 1.0, 170.0);
    view.verticalFov = degrees * kRadiansPerDegree;
    return view;
}

/// The names of the policies, as a message lists them.
std::string policyNames() {
    std::string names;
    for (std::size_t n = 0; n < kHeightPolicyCount; ++n)
        names += fmt::format("{}\"{}\"", n == 0 ? "" : ", ", toString(HeightPolicy(n)));
    return names;
}

/// Classes that are not named keep what they have without a choice.
void readHeightRules(const JsonReader& reader, HeightRules& rules) {
    reader.read("clearance", rules.clearance, 0.0, 100.0);
    const JsonReader classes = reader.object("classes");
    for (std::size_t n = 0; n < rules.policies.size(); ++n) {
        const char* const name = toString(CityObjectType(n));
        std::string text = toString(rules.policies[n]);
        classes.read(name, text);
        if (const auto policy = heightPolicyFromText(text)) {
            rules.policies[n] = *policy;
        } else {
            classes.fail(name, "one of " + policyNames());
        }
    }
}

void readLight(const JsonReader& reader, Project& project) {
    reader.read("turbidity", project.turbidity, 1.7, 10.0);
    if (!reader.has("date"))
        return;
    std::string date;
    reader.read("date", date);
    const auto parsed = parseDateTime(date, 0.0);
    if (!parsed)
        return reader.fail("date", "a date such as 2026-05-15T10:00+02:00");
    project.date = *parsed;
}

template <class Item, class Read>
void readList(const JsonReader& reader, const char* key, std::string Item::*identity,
              std::vector<Item>& out, const Read& read) {
    std::set<std::string> seen;
    for (const JsonReader& item : reader.objects(key)) {
        out.push_back(read(item));
        const std::string& id = out.back().*identity;
        if (id.empty())
            item.fail("", "a name that is not empty");
        if (!seen.insert(id).second)
            item.fail("", fmt::format("a name of its own: \"{}\" is taken", id));
    }
}

void readAll(const JsonReader& reader, Project& project) {
    reader.read("name", project.name);
    reader.read("generatedGround", project.generatedGround);
    reader.read("exposure", project.exposure, 1e-6, 1e6);
    readFrame(reader, project.frame);
    for (const JsonReader& item : reader.objects("models"))
        project.models.push_back(readModel(item));
    const JsonReader heightfield = reader.object("heightfield");
    heightfield.read("cellSize", project.heightfield.cellSize, 0.0, 1000.0);
    heightfield.read("maxCells", project.heightfield.maxCells, 1, project.heightfield.cellLimit);
    readHeightRules(heightfield, project.heightfield.rules);
    const JsonReader bake = reader.object("bake");
    bake.read("resolution", project.bake.resolution, 32, 2048);
    bake.read("samplesPerEdge", project.bake.samplesPerEdge, 1, 16);
    readTuning(reader.object("tuning"), project.tuning);
    readLight(reader.object("light"), project);
    readList(reader, "probes", &Probe::id, project.probes, readProbe);
    readList(reader, "noProbes", &NoProbeArea::id, project.noProbes, readNoProbeArea);
    readList(reader, "routes", &RouteSpec::id, project.routes, readRoute);
    readList(reader, "vehicles", &VehicleModel::id, project.vehicles, readVehicle);
    readList(reader, "reflectors", &Reflector::id, project.reflectors, readReflector);
    readList(reader, "views", &View::name, project.views, readView);
    for (std::size_t i = 0; i < project.reflectors.size(); ++i) {
        const bool known = std::any_of(
            project.routes.begin(), project.routes.end(),
            [&](const RouteSpec& route) { return route.id == project.reflectors[i].route; });
        if (!known)
            reader.fail(fmt::format("reflectors/{}/route", i), "the id of a route of this project");
    }
}

Result<int> schemaVersion(const json& root, const std::string& subject) {
    if (!root.is_object() || root.value("schema", json()) != json("reflet-project")) {
        return fail(ErrorCode::Unreadable, "this is not a Reflet project", subject,
                    "A project is a JSON object with \"schema\": \"reflet-project\"; city models "
                    "are read with "
                    "`reflet-cli import`.");
    }
    const json version = root.value("version", json());
    if (!version.is_number_integer() || version.get<double>() < 1) {
        return fail(ErrorCode::Unreadable, "/version is not a whole number from 1", subject,
                    "Take the file from a backup.");
    }
    if (version.get<double>() > kProjectSchemaVersion) {
        return fail(ErrorCode::Refused,
                    fmt::format("the project is of schema version {}, this Reflet knows up to {}",
                                version.dump(), kProjectSchemaVersion),
                    subject, "Open it with a newer Reflet; nothing was changed.");
    }
    return version.get<int>();
}

}  // namespace

Result<Project> projectFromJson(const std::string& text, const std::string& subject) {
    json root = json::parse(text, nullptr, false);
    if (root.is_discarded()) {
        return fail(ErrorCode::Unreadable, "this is not JSON, or it is cut off", subject,
                    "Take the file from a backup or from the autosave beside it.");
    }
    const auto version = schemaVersion(root, subject);
    if (!version)
        return tl::unexpected(version.error());
    migrateProject(root, *version);

    Project project;
    std::optional<JsonReader::Failure> failure;
    readAll(JsonReader(root, "", failure), project);
    if (failure) {
        return fail(ErrorCode::Unreadable,
                    fmt::format("{} should be {}", failure->pointer, failure->expected), subject,
                    "Mend that value in a text editor, or take the file from a backup.");
    }
    project.source = root.dump();
    return project;
}

}  // namespace reflet
