// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/ModelJson.h"
#include "core/project/Project.h"
#include "core/project/VehicleJson.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <unordered_map>

namespace reflet {

namespace {

using nlohmann::json;

json triple(const glm::dvec3& v) {
    return json::array({v.x, v.y, v.z});
}

json optionalText(const std::optional<std::string>& text) {
    return text ? json(*text) : json();
}

/// What the project was read from: the place where unknown keys survive.
class Source {
public:
    explicit Source(const std::string& text) : m_root(json::parse(text, nullptr, false)) {
        if (!m_root.is_object())
            m_root = json::object();
    }
    [[nodiscard]] const json& root() const { return m_root; }
    [[nodiscard]] json object(const char* key) const {
        const auto found = m_root.find(key);
        return found != m_root.end() && found->is_object() ? *found : json::object();
    }
    /// The element of list `key` whose member `identity` is `id`; an empty object if there is none.
    [[nodiscard]] json element(const char* key, const char* identity, const std::string& id) {
        const auto [list, isNew] = m_elements.try_emplace(key);
        if (isNew)
            index(key, identity, list->second);
        const auto found = list->second.find(id);
        return found == list->second.end() ? json::object() : *found->second;
    }

private:
    using ElementsById = std::unordered_map<std::string, const json*>;

    /// The first of several elements of one name counts.
    void index(const char* key, const char* identity, ElementsById& out) const {
        const auto list = m_root.find(key);
        if (list == m_root.end() || !list->is_array())
            return;
        for (const auto& item : *list) {
            const json id = item.is_object() ? item.value(identity, json()) : json();
            if (id.is_string())
                out.try_emplace(id.get<std::string>(), &item);
        }
    }

    json m_root;
    std::unordered_map<std::string, ElementsById> m_elements;  ///< by list
};

/// Degrees for people: rounded to a billionth, so that a value read and saved again stays the same.
double degrees(double radians) {
    return std::round(radians * 180.0 / kPi * 1e9) / 1e9;
}

json placementToJson(const std::optional<ModelPlacement>& placement, const json& model) {
    if (!placement)
        return {};
    json out = model.value("placement", json());
    if (!out.is_object())
        out = json::object();
    out["offset"] = triple(placement->offset);
    out["heading"] = degrees(placement->heading);
    out["scale"] = placement->scale;
    return out;
}

/// For keys that only some have.
void setOrErase(json& item, const char* key, const json& value, bool present) {
    if (present)
        item[key] = value;
    else
        item.erase(key);
}

json modelsToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& model : project.models) {
        json item = source.element("models", "path", model.path);
        item["path"] = model.path;
        item["hash"] = model.hash;
        item["crs"] = model.crs;
        item["lod"] = model.lod;
        item["types"] = model.types;
        item["bbox"] = model.bbox ? json(*model.bbox) : json();
        if (model.use != ModelUse::City || item.contains("use"))
            item["use"] = useText(model.use);
        if (model.placement || item.contains("placement"))
            item["placement"] = placementToJson(model.placement, item);
        setOrErase(item, "heightField", model.heightField, !model.heightField.empty());
        setOrErase(item, "crownField", model.crownField, !model.crownField.empty());
        setOrErase(item, "baseField", model.baseField, !model.baseField.empty());
        setOrErase(item, "defaultHeight", model.defaultHeight.value_or(0.0),
                   model.defaultHeight.has_value());
        setOrErase(item, "upAxis", model.upAxis, !model.upAxis.empty());
        setOrErase(item, "axisOrder", model.axisOrder, !model.axisOrder.empty());
        setOrErase(item, "unit", model.unit.value_or(1.0), model.unit.has_value());
        setOrErase(item, "geometricError", model.geometricError.value_or(0.0),
                   model.geometricError.has_value());
        out.push_back(std::move(item));
    }
    return out;
}

json probesToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& probe : project.probes) {
        json item = source.element("probes", "id", probe.id);
        item["id"] = probe.id;
        item["position"] = triple(probe.position);
        item["resolution"] = probe.resolution ? json(*probe.resolution) : json();
        item["locked"] = probe.locked;
        out.push_back(std::move(item));
    }
    return out;
}

json noProbesToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& area : project.noProbes) {
        json item = source.element("noProbes", "id", area.id);
        item["id"] = area.id;
        item["center"] = {area.center.x, area.center.y};
        item["radius"] = area.radius;
        out.push_back(std::move(item));
    }
    return out;
}

json routesToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& route : project.routes) {
        json item = source.element("routes", "id", route.id);
        item["id"] = route.id;
        item["name"] = route.name;
        item["cornerRadius"] = route.cornerRadius;
        item["points"] = json::array();
        for (const auto& point : route.points)
            item["points"].push_back(triple(point));
        setOrErase(item, "attributes", route.attributes, !route.attributes.empty());
        out.push_back(std::move(item));
    }
    return out;
}

json reflectorsToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& reflector : project.reflectors) {
        json item = source.element("reflectors", "id", reflector.id);
        item["id"] = reflector.id;
        item["vehicle"] = reflector.vehicle;
        item["route"] = reflector.route;
        item["speed"] = reflector.speed;
        item["start"] = reflector.start;
        setOrErase(item, "interest", reflector.interest, reflector.interest != 1.0);
        out.push_back(std::move(item));
    }
    return out;
}

json vehiclesToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& vehicle : project.vehicles) {
        json item = source.element("vehicles", "id", vehicle.id);
        item["id"] = vehicle.id;
        item["path"] = vehicle.path;
        item["hash"] = vehicle.hash;
        item["up"] = upText(vehicle.up);
        item["scale"] = vehicle.scale;
        item["heading"] = degrees(vehicle.heading);
        item["offset"] = triple(vehicle.offset);
        item["coat"] = vehicle.coat;
        out.push_back(std::move(item));
    }
    return out;
}

json viewsToJson(const Project& project, Source& source) {
    json out = json::array();
    for (const auto& view : project.views) {
        json item = source.element("views", "name", view.name);
        item["name"] = view.name;
        item["caption"] = view.caption;
        item["position"] = triple(view.position);
        item["target"] = triple(view.target);
        item["verticalFov"] = degrees(view.verticalFov);
        item["time"] = view.time;
        out.push_back(std::move(item));
    }
    return out;
}

json tuningToJson(const MemSettings& tuning, json out) {
    out["meshSize"] = tuning.meshSize;
    out["depthRatio"] = std::isfinite(tuning.depthRatio) ? json(tuning.depthRatio) : json();
    out["errorBound"] = tuning.errorBound;
    out["smallestQuad"] = tuning.smallestQuad;
    out["refineAtValidity"] = tuning.refineAtValidity;
    out["traceEdgeTexels"] = tuning.traceEdgeTexels;
    out["refineHits"] = tuning.refineHits;
    out["parallax"] = tuning.parallax;
    out["interpolation"] = tuning.interpolation == Interpolation::Exact ? "exact" : "as-in-paper";
    out["weighting"] = tuning.weighting == Weighting::BySight ? "by-sight" : "as-in-paper";
    out["probesPerVehicle"] = tuning.remsPerVehicle;
    out["resolution"] = tuning.resolution;
    json& lod = out["levelOfDetail"];
    if (!lod.is_object())
        lod = json::object();
    lod["on"] = tuning.lod.on;
    lod["frameBudget"] = tuning.lod.frameBudget;
    lod["blur"] = tuning.lod.blur;
    return out;
}

json classesToJson(const HeightRules& rules, json out) {
    if (!out.is_object())
        out = json::object();
    for (std::size_t n = 0; n < rules.policies.size(); ++n)
        out[toString(CityObjectType(n))] = toString(rules.policies[n]);
    return out;
}

/// The shortest decimal that gives the float back, so that 2.2f is not written 2.2000000477.
double shortest(float value) {
    return std::stod(json(value).dump());
}

}  // namespace

std::string projectToJson(const Project& project) {
    Source source(project.source);
    json root = source.root();
    root["schema"] = "reflet-project";
    root["version"] = kProjectSchemaVersion;
    root["name"] = project.name;
    json crs = source.object("crs");
    crs["horizontal"] = optionalText(project.frame.crs);
    crs["vertical"] = optionalText(project.frame.vertical);
    crs["origin"] = triple(project.frame.origin);
    root["crs"] = crs;
    json heightfield = source.object("heightfield");
    heightfield["cellSize"] = project.heightfield.cellSize;
    heightfield["maxCells"] = project.heightfield.maxCells;
    heightfield["clearance"] = project.heightfield.rules.clearance;
    heightfield["classes"] = classesToJson(project.heightfield.rules, heightfield["classes"]);
    root["heightfield"] = heightfield;
    json bake = source.object("bake");
    bake["resolution"] = project.bake.resolution;
    bake["samplesPerEdge"] = project.bake.samplesPerEdge;
    root["bake"] = bake;
    root["tuning"] = tuningToJson(project.tuning, source.object("tuning"));
    json light = source.object("light");
    light["date"] = toIso8601(project.date);
    light["turbidity"] = shortest(project.turbidity);
    root["light"] = light;
    root["exposure"] = shortest(project.exposure);
    root["generatedGround"] = project.generatedGround;
    root["models"] = modelsToJson(project, source);
    root["probes"] = probesToJson(project, source);
    if (!project.noProbes.empty() || root.contains("noProbes"))
        root["noProbes"] = noProbesToJson(project, source);
    root["routes"] = routesToJson(project, source);
    if (!project.vehicles.empty() || root.contains("vehicles"))
        root["vehicles"] = vehiclesToJson(project, source);
    root["reflectors"] = reflectorsToJson(project, source);
    root["views"] = viewsToJson(project, source);
    return root.dump(2) + "\n";
}

}  // namespace reflet
