// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace reflet::test {

/// A CityJSON street of box houses on both sides of a road along x, 12 m apart, with terrain:
/// small, and known to the millimetre. Houses are 9 m long with 1 m gaps and 6 to 12 m high; the
/// road's middle runs from (east, north) to (east + 10·houses, north) at height `up`.
class StreetCity {
public:
    explicit StreetCity(int houses = 6, double east = 690'000.0, double north = 5'335'000.0,
                        double up = 0.0)
        : m_houses(houses), m_east(east), m_north(north), m_up(up) {}

    [[nodiscard]] std::string cityJson(
        const std::string& crs = "https://www.opengis.net/def/crs/EPSG/0/25832") {
        m_vertices.clear();
        m_objects = nlohmann::json::object();
        addTerrain();
        for (int i = 0; i < m_houses; ++i) {
            addHouse("north-" + std::to_string(i), 10 * i, 6, 14, 6 + i % 3 * 3);
            addHouse("south-" + std::to_string(i), 10 * i, -14, -6, 6 + (i + 1) % 3 * 3);
        }
        for (const More& more : m_more)
            addBox("more-" + std::to_string(m_vertices.size()), more.type, more.low, more.high);
        if (m_bridge)
            addBox("bridge", "Bridge", {30.0, -6.0, 5.0}, {38.0, 6.0, 6.0});
        nlohmann::json root{{"type", "CityJSON"}, {"version", "2.0"}, {"CityObjects", m_objects}};
        root["transform"] = {{"scale", {0.001, 0.001, 0.001}},
                             {"translate", {m_east, m_north, m_up}}};
        root["vertices"] = m_vertices;
        if (!crs.empty())
            root["metadata"]["referenceSystem"] = crs;
        return root.dump();
    }

    /// The same with a bridge of 8 m × 12 m across the road from house to house, from 30 m to 38 m
    /// along it: a closed slab from 5 m to 6 m above the road.
    [[nodiscard]] StreetCity withBridge() const {
        StreetCity city = *this;
        city.m_bridge = true;
        return city;
    }

    /// The same with one more house, metres from the start of the road's middle.
    [[nodiscard]] StreetCity withHouse(const std::array<double, 3>& low,
                                       const std::array<double, 3>& high) const {
        StreetCity city = *this;
        city.m_more.push_back({"Building", low, high});
        return city;
    }

    /// The same with a tree in the shape of a box.
    [[nodiscard]] StreetCity withTree(const std::array<double, 3>& low,
                                      const std::array<double, 3>& high) const {
        StreetCity city = *this;
        city.m_more.push_back({"SolitaryVegetationObject", low, high});
        return city;
    }

    /// The middle of the road as a GeoJSON line in EPSG:25832, named "street".
    [[nodiscard]] std::string routeGeoJson() const {
        const nlohmann::json geometry{
            {"type", "LineString"},
            {"coordinates", {{m_east + 2.0, m_north}, {m_east + 10.0 * m_houses - 2.0, m_north}}}};
        const nlohmann::json feature{
            {"type", "Feature"}, {"properties", {{"name", "street"}}}, {"geometry", geometry}};
        return nlohmann::json{
            {"type", "FeatureCollection"},
            {"crs", {{"type", "name"}, {"properties", {{"name", "urn:ogc:def:crs:EPSG::25832"}}}}},
            {"features", {feature}}}
            .dump();
    }

    /// City objects of the file: the terrain and two houses for each number.
    [[nodiscard]] int objects() const {
        return 1 + 2 * m_houses + (m_bridge ? 1 : 0) + int(m_more.size());
    }

private:
    int vertex(double x, double y, double z) {
        const auto millimetres = [](double v) { return static_cast<long>(v * 1000.0); };
        m_vertices.push_back({millimetres(x), millimetres(y), millimetres(z)});
        return int(m_vertices.size()) - 1;
    }

    void addTerrain() {
        const double far = 10.0 * m_houses + 40.0;
        const nlohmann::json ring{vertex(-40, -40, 0), vertex(far, -40, 0), vertex(far, 40, 0),
                                  vertex(-40, 40, 0)};
        const nlohmann::json boundaries = nlohmann::json::array({nlohmann::json::array({ring})});
        m_objects["ground"] = {
            {"type", "TINRelief"},
            {"geometry",
             {{{"type", "CompositeSurface"}, {"lod", "1"}, {"boundaries", boundaries}}}}};
    }

    void addHouse(const std::string& id, double x0, double y0, double y1, double height) {
        addBox(id, "Building", {x0, y0, 0.0}, {x0 + 9.0, y1, height});
    }

    /// A closed box, faces outwards, its lower face a GroundSurface.
    void addBox(const std::string& id, const std::string& type, const std::array<double, 3>& low,
                const std::array<double, 3>& high) {
        std::array<int, 8> v{};
        for (int i = 0; i < 8; ++i) {
            v[std::size_t(i)] = vertex(i % 4 == 1 || i % 4 == 2 ? high[0] : low[0],
                                       i % 4 >= 2 ? high[1] : low[1], i >= 4 ? high[2] : low[2]);
        }
        const std::array<std::array<int, 4>, 6> faces{
            {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
        nlohmann::json shell = nlohmann::json::array();
        for (const auto& face : faces) {
            nlohmann::json ring = nlohmann::json::array();
            for (const int corner : face)
                ring.push_back(v[std::size_t(corner)]);
            shell.push_back(nlohmann::json::array({ring}));
        }
        const nlohmann::json semantics{
            {"surfaces",
             {{{"type", "GroundSurface"}}, {{"type", "RoofSurface"}}, {{"type", "WallSurface"}}}},
            {"values", nlohmann::json::array({nlohmann::json::array({0, 1, 2, 2, 2, 2})})}};
        m_objects[id] = {{"type", type},
                         {"geometry",
                          {{{"type", "Solid"},
                            {"lod", "2"},
                            {"boundaries", nlohmann::json::array({shell})},
                            {"semantics", semantics}}}}};
    }

    int m_houses;
    double m_east, m_north, m_up;
    bool m_bridge = false;
    struct More {
        std::string type;
        std::array<double, 3> low, high;
    };
    std::vector<More> m_more;
    std::vector<std::array<long, 3>> m_vertices;
    nlohmann::json m_objects;
};

/// The text of a CityJSON file that has north before east.
[[nodiscard]] inline std::string withAxesExchanged(const std::string& cityJson) {
    nlohmann::json root = nlohmann::json::parse(cityJson);
    const auto exchange = [](nlohmann::json& point) { std::swap(point[0], point[1]); };
    for (nlohmann::json& vertex : root["vertices"])
        exchange(vertex);
    exchange(root["transform"]["translate"]);
    return root.dump();
}

}  // namespace reflet::test
