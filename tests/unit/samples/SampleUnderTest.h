// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/Samples.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace reflet::test {

/// A polygon of the file as it stands in the city, millimetres about the file's translation.
struct FilePolygon {
    std::string object;
    std::string type;  ///< of the city object
    bool instance = false;
    std::vector<glm::ivec3> ring;
};

/// The sample with seed 1, made and parsed once.
struct SampleUnderTest {
    Sample sample;
    std::vector<FilePolygon> polygons;  ///< templates are repeated for each instance
    glm::dvec3 translation{0.0};
};
const SampleUnderTest& sampleUnderTest(const std::string& name);
const nlohmann::json& parsedModel(const std::string& name);

/// n - 2 for every polygon of n points.
std::size_t triangles(const FilePolygon& polygon);

/// Names of objects that reach into the upright cylinder about a point, from `low` to `high` above
/// it: conservative, by the boxes of their polygons.
std::vector<std::string> intruders(const SampleUnderTest& city, const glm::dvec3& absolute,
                                   double radius, double low, double high);

}  // namespace reflet::test
