// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/cityjson/CityJsonImporter.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

// Small CityJSON texts made in the tests, and what is asked of the results again and again.
namespace reflet::test {

using nlohmann::json;

/// The shell of a box on the vertices of boxVertices(): floor, roof, then four walls; all outward.
inline json boxShell(int first = 0) {
    json shell = json::array();
    for (const auto& ring :
         {std::array{0, 3, 2, 1}, std::array{4, 5, 6, 7}, std::array{0, 1, 5, 4},
          std::array{1, 2, 6, 5}, std::array{2, 3, 7, 6}, std::array{3, 0, 4, 7}}) {
        json indices = json::array();
        for (const int i : ring)
            indices.push_back(first + i);
        shell.push_back(json::array({indices}));
    }
    return shell;
}

/// Corners of a box in whole numbers (millimetres with the transform of emptyCity()).
inline json boxVertices(int x = 0, int y = 0, int z = 0, int sx = 10000, int sy = 8000,
                        int sz = 6000) {
    json vertices = json::array();
    for (const int up : {z, z + sz}) {
        vertices.push_back({x, y, up});
        vertices.push_back({x + sx, y, up});
        vertices.push_back({x + sx, y + sy, up});
        vertices.push_back({x, y + sy, up});
    }
    return vertices;
}

/// A CityJSON 2.0 without objects, in millimetres around (85000, 446000) of EPSG:7415.
inline json emptyCity() {
    return {
        {"type", "CityJSON"},
        {"version", "2.0"},
        {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}}},
        {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {85000.0, 446000.0, 0.0}}}},
        {"CityObjects", json::object()},
        {"vertices", json::array()}};
}

inline json solid(std::string lod, json shell = boxShell()) {
    return {{"type", "Solid"},
            {"lod", std::move(lod)},
            {"boundaries", json::array({std::move(shell)})}};
}

inline json surfaces(std::string lod, json boundaries) {
    return {
        {"type", "MultiSurface"}, {"lod", std::move(lod)}, {"boundaries", std::move(boundaries)}};
}

inline json object(std::string type, json geometries = json::array()) {
    return {{"type", std::move(type)}, {"geometry", std::move(geometries)}};
}

/// One building "a": a box of 10 m by 8 m by 6 m.
inline json boxCity() {
    json city = emptyCity();
    city["vertices"] = boxVertices();
    city["CityObjects"]["a"] = object("Building", json::array({solid("2")}));
    return city;
}

inline Result<Imported<CityImport>> tryImport(
    std::string_view text, const ImportOptions& options = {},
    const std::filesystem::path& path = "city.city.json") {
    return importCityJsonText(text, path, options, {});
}

/// The import of a text that must succeed; an empty one, and a failure of the test, if it does not.
inline Imported<CityImport> import(const json& city, const ImportOptions& options = {},
                                   const std::filesystem::path& path = "city.city.json") {
    auto result = tryImport(city.dump(), options, path);
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

/// The error of an import that must fail.
inline Error importError(std::string_view text, const ImportOptions& options = {}) {
    auto result = tryImport(text, options);
    if (result) {
        ADD_FAILURE() << "the import went through";
        return {};
    }
    return result.error();
}

template <class T>
const Diagnostic* findDiagnostic(const Imported<T>& result, std::string_view code,
                                 std::string_view object = {}) {
    const auto found = std::find_if(
        result.diagnostics.begin(), result.diagnostics.end(), [&](const Diagnostic& d) {
            return d.code == code && (object.empty() || d.object == object);
        });
    return found == result.diagnostics.end() ? nullptr : &*found;
}

template <class T>
std::string textOf(const Imported<T>& result, std::string_view code, std::string_view object = {}) {
    const Diagnostic* found = findDiagnostic(result, code, object);
    return found == nullptr ? "" : found->text;
}

template <class T>
std::string countsOf(const Imported<T>& result) {
    return std::to_string(result.counts.loaded) + " loaded, " +
           std::to_string(result.counts.repaired) + " repaired, " +
           std::to_string(result.counts.skipped) + " skipped";
}

/// Divergence theorem: each oriented triangle adds a sixth of the determinant of its corners.
inline double enclosedVolume(const CityModel& city) {
    double sum = 0.0;
    for (const CityTriangle& triangle : city.triangles) {
        const glm::dvec3 a(city.vertices[triangle.vertex[0]]);
        const glm::dvec3 b(city.vertices[triangle.vertex[1]]);
        const glm::dvec3 c(city.vertices[triangle.vertex[2]]);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6.0;
}

inline double areaOf(const CityModel& city) {
    double sum = 0.0;
    for (const CityTriangle& triangle : city.triangles) {
        const glm::dvec3 a(city.vertices[triangle.vertex[0]]);
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(city.vertices[triangle.vertex[1]]) - a,
                                            glm::dvec3(city.vertices[triangle.vertex[2]]) - a));
    }
    return sum;
}

}  // namespace reflet::test
