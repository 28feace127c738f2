// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of Meyer and Loscos 2003, section 7.
#include "SampleUnderTest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace reflet::test {
namespace {

std::map<std::string, std::size_t> trianglesByType(const SampleUnderTest& city) {
    std::map<std::string, std::size_t> counts;
    for (const FilePolygon& polygon : city.polygons) {
        counts[polygon.type] += triangles(polygon);
    }
    return counts;
}

TEST(PaperSample, HasBuildingsOf25600TrianglesAndEightTreesOf59100Each) {
    const SampleUnderTest& city = sampleUnderTest("paper");
    EXPECT_EQ(trianglesByType(city)["Building"], 25'600U);
    std::map<std::string, std::size_t> trees;
    for (const FilePolygon& polygon : city.polygons) {
        if (polygon.type == "SolitaryVegetationObject") {
            trees[polygon.object] += triangles(polygon);
        }
    }
    EXPECT_EQ(trees.size(), 8U);
    for (const auto& [id, count] : trees) {
        EXPECT_EQ(count, 59'100U) << id;
    }
}

TEST(PaperSample, HasAboutHalfAMillionTrianglesForAnySeed) {
    for (const std::uint64_t seed : {2U, 77U}) {
        const Sample sample = makeSample("paper", seed).value();
        EXPECT_LT(sample.modelJson.size(), 25'000'000U);
    }
    std::size_t total = 0;
    for (const auto& [type, count] : trianglesByType(sampleUnderTest("paper"))) {
        total += count;
    }
    EXPECT_GT(total, 495'000U);
    EXPECT_LT(total, 505'000U);
}

TEST(PaperSample, CoversASquareKilometreWithEightRoads) {
    const SampleUnderTest& city = sampleUnderTest("paper");
    glm::ivec3 low(1 << 30), high(-(1 << 30));
    std::map<std::string, std::size_t> roads;
    for (const FilePolygon& polygon : city.polygons) {
        for (const glm::ivec3& p : polygon.ring) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        if (polygon.object.starts_with("road-")) {
            ++roads[polygon.object];
        }
    }
    EXPECT_EQ(high.x - low.x, 1'000'000);
    EXPECT_EQ(high.y - low.y, 1'000'000);
    EXPECT_EQ(roads.size(), 8U);
}

TEST(PaperSample, Has54ProbesOf128TexelsAndCellsOfHalfAMetre) {
    const Project& project = sampleUnderTest("paper").sample.project;
    EXPECT_EQ(project.probes.size(), 54U);
    EXPECT_EQ(project.bake.resolution, 128);
    EXPECT_EQ(project.heightfield.cellSize, 0.5);
}

TEST(PaperSample, HasAProbeWithinEightMetresOfAnyPlaceThatItsFirstRouteDrives) {
    const Project& project = sampleUnderTest("paper").sample.project;
    const RouteSpec& route = project.routes.front();
    ASSERT_EQ(route.points.size(), 2U);
    for (int i = 0; i <= 100; ++i) {
        const glm::dvec3 at = glm::mix(route.points[0], route.points[1], i / 100.0);
        double nearest = 1e9;
        for (const Probe& probe : project.probes) {
            nearest = std::min(nearest, glm::length(glm::dvec2(probe.position - at)));
        }
        EXPECT_LT(nearest, 8.0);
    }
}

TEST(PaperSample, KeepsItsBuildingsApart) {
    const SampleUnderTest& city = sampleUnderTest("paper");
    struct Footprint {
        glm::ivec2 low{1 << 30}, high{-(1 << 30)};
    };
    std::map<std::string, Footprint> prints;
    for (const FilePolygon& polygon : city.polygons) {
        if (polygon.type == "Building" || polygon.type == "SolitaryVegetationObject") {
            Footprint& print = prints[polygon.object];
            for (const glm::ivec3& p : polygon.ring) {
                print.low = glm::min(print.low, glm::ivec2(p));
                print.high = glm::max(print.high, glm::ivec2(p));
            }
        }
    }
    EXPECT_EQ(prints.size(), 256U + 8U);
    for (auto a = prints.begin(); a != prints.end(); ++a) {
        for (auto b = std::next(a); b != prints.end(); ++b) {
            const bool tree = a->first.starts_with("tree") || b->first.starts_with("tree");
            const bool trees = a->first.starts_with("tree") && b->first.starts_with("tree");
            const glm::ivec2 low = glm::max(a->second.low, b->second.low);
            const glm::ivec2 high = glm::min(a->second.high, b->second.high);
            const bool apart = low.x > high.x || low.y > high.y;
            EXPECT_TRUE(apart || trees) << a->first << " " << b->first << (tree ? " (tree)" : "");
        }
    }
}

}  // namespace
}  // namespace reflet::test
