// SPDX-License-Identifier: GPL-3.0-or-later
#include "SampleUnderTest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace reflet::test {

namespace {

using nlohmann::json;

glm::ivec3 vertexOf(const json& vertices, const json& index) {
    const json& v = vertices.at(index.get<std::size_t>());
    return {v[0].get<int>(), v[1].get<int>(), v[2].get<int>()};
}

void addOwn(const json& model, const std::string& id, const std::string& type, const json& geometry,
            std::vector<FilePolygon>& polygons) {
    for (const json& surface : geometry.at("boundaries")) {
        FilePolygon polygon{id, type, false, {}};
        for (const json& index : surface.at(0)) {
            polygon.ring.push_back(vertexOf(model.at("vertices"), index));
        }
        polygons.push_back(std::move(polygon));
    }
}

void addInstance(const json& model, const std::string& id, const std::string& type,
                 const json& geometry, std::vector<FilePolygon>& polygons) {
    const json& templates = model.at("geometry-templates");
    const json& shape = templates.at("templates").at(geometry.at("template").get<std::size_t>());
    const glm::dvec3 anchor(vertexOf(model.at("vertices"), geometry.at("boundaries").at(0)));
    const auto m = geometry.at("transformationMatrix").get<std::vector<double>>();
    for (const json& surface : shape.at("boundaries")) {
        FilePolygon polygon{id, type, true, {}};
        for (const json& index : surface.at(0)) {
            const auto v = templates.at("vertices-templates")
                               .at(index.get<std::size_t>())
                               .get<std::vector<double>>();
            glm::dvec3 p;
            for (int row = 0; row < 3; ++row) {
                const auto r = std::size_t(4 * row);
                p[row] = 1000.0 * (m[r] * v[0] + m[r + 1] * v[1] + m[r + 2] * v[2] + m[r + 3]);
            }
            polygon.ring.emplace_back(glm::round(anchor + p));
        }
        polygons.push_back(std::move(polygon));
    }
}

struct Parsed {
    SampleUnderTest city;
    json model;
};

const Parsed& parsed(const std::string& name) {
    static std::map<std::string, std::unique_ptr<Parsed>> all;
    std::unique_ptr<Parsed>& p = all[name];
    if (p) {
        return *p;
    }
    p = std::make_unique<Parsed>();
    p->city.sample = makeSample(name, 1).value();
    p->model = json::parse(p->city.sample.modelJson);
    const auto t = p->model.at("transform").at("translate").get<std::vector<double>>();
    p->city.translation = {t[0], t[1], t[2]};
    for (const auto& [id, object] : p->model.at("CityObjects").items()) {
        const auto type = object.at("type").get<std::string>();
        for (const json& geometry : object.at("geometry")) {
            const bool instance = geometry.at("type") == "GeometryInstance";
            (instance ? addInstance : addOwn)(p->model, id, type, geometry, p->city.polygons);
        }
    }
    return *p;
}

}  // namespace

const SampleUnderTest& sampleUnderTest(const std::string& name) {
    return parsed(name).city;
}
const json& parsedModel(const std::string& name) {
    return parsed(name).model;
}

std::size_t triangles(const FilePolygon& polygon) {
    return polygon.ring.size() - 2;
}

std::vector<std::string> intruders(const SampleUnderTest& city, const glm::dvec3& absolute,
                                   double radius, double low, double high) {
    const glm::dvec3 p = (absolute - city.translation) * 1000.0;
    std::vector<std::string> names;
    for (const FilePolygon& polygon : city.polygons) {
        glm::ivec3 least = polygon.ring[0], most = polygon.ring[0];
        for (const glm::ivec3& q : polygon.ring) {
            least = glm::min(least, q);
            most = glm::max(most, q);
        }
        const double dx = std::max({least.x - p.x, p.x - most.x, 0.0});
        const double dy = std::max({least.y - p.y, p.y - most.y, 0.0});
        const bool beside = std::hypot(dx, dy) > 1000.0 * radius;
        if (!beside && most.z > p.z + 1000.0 * low && least.z < p.z + 1000.0 * high) {
            names.push_back(polygon.object);
        }
    }
    return names;
}

}  // namespace reflet::test
