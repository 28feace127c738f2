// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/paper/Paper.h"

#include "core/samples/kit/CityJsonWriter.h"
#include "core/samples/kit/Tree.h"
#include "core/samples/paper/PaperPlan.h"

#include <fmt/format.h>

#include <cmath>

namespace reflet::paper {

namespace {

/// Two shapes, each planted four times: a file holds a template once.
constexpr std::array<glm::dvec2, kTrees> kTreePlaces{
    {{-48, -78}, {-16, -80}, {18, -77}, {52, -79}, {-150, -72}, {152, -74}, {-30, 122}, {34, 124}}};

}  // namespace

void addTrees(kit::SampleCity& city, kit::Random random) {
    const std::size_t shapes[] = {
        city.addTemplate(kit::treeOfTriangles(kTrianglesPerTree, 13.0, random)),
        city.addTemplate(kit::treeOfTriangles(kTrianglesPerTree, 16.0, random))};
    for (std::size_t i = 0; i < kTrees; ++i) {
        kit::SampleObject& tree =
            city.add(fmt::format("tree-{}", i + 1), CityObjectType::SolitaryVegetation);
        tree.placements.push_back({shapes[i % 2], glm::dvec3(kTreePlaces[i], kPavementHeight),
                                   random.between(0.0, 2.0 * kPi), 1.0});
    }
}

kit::SampleCity makeCity(std::uint64_t seed) {
    kit::SampleCity city;
    city.title = "Reflet sample: the test scene of Meyer and Loscos 2003";
    kit::Random random(seed);
    addGround(city);
    addBuildings(city, random.fork(1));
    addTrees(city, random.fork(2));
    return city;
}

Sample makePaper(std::uint64_t seed) {
    Sample sample;
    sample.modelFileName = "paper.city.json";
    sample.modelJson = kit::writeCityJson(makeCity(seed), {});
    sample.project = makeProject(sample.modelFileName);
    return sample;
}

}  // namespace reflet::paper
