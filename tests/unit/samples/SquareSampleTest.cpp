// SPDX-License-Identifier: GPL-3.0-or-later
#include "SampleUnderTest.h"
#include "core/geo/Crs.h"
#include "core/geo/ProjectFrame.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace reflet::test {
namespace {

TEST(SquareSample, StandsWithinAMetreOfItsPlaceOnTheEarth) {
    const SampleUnderTest& city = sampleUnderTest("square");
    const auto transform =
        CrsTransform::create(Crs::parse("EPSG:4326").value(), Crs::parse("EPSG:2154").value());
    ASSERT_TRUE(transform.has_value());
    const glm::dvec3 place = transform->apply(glm::dvec3(7.2705, 43.6975, 0.0)).value();
    EXPECT_LT(glm::length(glm::dvec2(city.translation - place)), 1.0);
    const Crs crs =
        Crs::parse(parsedModel("square").at("metadata").at("referenceSystem").get<std::string>())
            .value();
    EXPECT_EQ(crs.horizontal(), "EPSG:2154");
    EXPECT_EQ(crs.vertical(), "EPSG:5720");
}

TEST(SquareSample, HasAFrameInWholeKilometresAboutItsPlace) {
    const SampleUnderTest& city = sampleUnderTest("square");
    const ProjectFrame& frame = city.sample.project.frame;
    EXPECT_EQ(frame.crs, "EPSG:2154");
    EXPECT_EQ(frame.vertical, "EPSG:5720");
    EXPECT_EQ(frame.origin, frameOrigin(city.translation));
}

TEST(SquareSample, KeepsToItsBudgetOfTrianglesAndBytes) {
    const SampleUnderTest& city = sampleUnderTest("square");
    std::size_t total = 0;
    for (const FilePolygon& polygon : city.polygons) {
        total += triangles(polygon);
    }
    EXPECT_GT(total, 150'000U);
    EXPECT_LT(total, 600'000U);
    EXPECT_LT(city.sample.modelJson.size(), 25'000'000U);
}

TEST(SquareSample, GivesTheTramAMinuteOnItsRoute) {
    const Project& project = sampleUnderTest("square").sample.project;
    const Reflector& tram = project.reflectors.front();
    EXPECT_EQ(tram.vehicle, "tram");
    const RouteSpec& route = project.routes.front();
    EXPECT_EQ(tram.route, route.id);
    double length = 0.0;
    double sharpest = 0.0;
    for (std::size_t i = 0; i + 1 < route.points.size(); ++i) {
        const glm::dvec2 d(route.points[i + 1] - route.points[i]);
        length += glm::length(d);
        if (i > 0) {
            const glm::dvec2 before(route.points[i] - route.points[i - 1]);
            const double turn =
                std::abs(std::atan2(before.x * d.y - before.y * d.x, glm::dot(before, d)));
            sharpest = std::max(sharpest, turn);
        }
    }
    EXPECT_NEAR(length, 480.0, 0.01);
    EXPECT_NEAR(length / tram.speed, 60.0, 0.01);
    EXPECT_LT(sharpest, 4.0 * kPi / 180.0) << "a rail has no corners";
}

/// The tracer makes solid columns of whatever stands in a cell, so nothing may hang over the rails.
TEST(SquareSample, LeavesTheTramItsClearance) {
    const SampleUnderTest& city = sampleUnderTest("square");
    const RouteSpec& route = city.sample.project.routes.front();
    double walked = 0.0, next = 0.0;
    std::size_t stations = 0;
    for (std::size_t i = 0; i + 1 < route.points.size(); ++i) {
        const double part = glm::length(route.points[i + 1] - route.points[i]);
        for (; next <= walked + part; next += 4.0, ++stations) {
            const glm::dvec3 at =
                glm::mix(route.points[i], route.points[i + 1], (next - walked) / part);
            const std::vector<std::string> names = intruders(city, at, 2.2, 0.1, 60.0);
            EXPECT_TRUE(names.empty()) << "at " << next << " m: " << names.front();
        }
        walked += part;
    }
    EXPECT_GE(stations, 120U);
}

TEST(SquareSample, HasAProbeEvery15MetresOverTheRails) {
    const Project& project = sampleUnderTest("square").sample.project;
    ASSERT_EQ(project.probes.size(), 32U);
    for (std::size_t i = 0; i + 1 < project.probes.size(); ++i) {
        const double apart =
            glm::length(project.probes[i + 1].position - project.probes[i].position);
        EXPECT_LE(apart, 15.0 + 1e-9);
        EXPECT_GT(apart, 14.0) << "less than the way along the rails only in the bend";
    }
    EXPECT_EQ(project.bake.resolution, 256);
}

}  // namespace
}  // namespace reflet::test
