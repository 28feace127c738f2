// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/HeightfieldBench.h"
#include "app/pipeline/TraceBenchCities.h"
#include "app/pipeline/TraceCheck.h"
#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/support/StreetProject.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <map>

namespace reflet {
namespace {

double areaOf(const CityModel& city, const CityTriangle& triangle) {
    const glm::dvec3 a(city.vertices[triangle.vertex[0]]);
    const glm::dvec3 b(city.vertices[triangle.vertex[1]]);
    const glm::dvec3 c(city.vertices[triangle.vertex[2]]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

std::map<std::uint32_t, double> areasBySurface(const CityModel& city) {
    std::map<std::uint32_t, double> areas;
    for (const CityTriangle& triangle : city.triangles)
        areas[triangle.surface] += areaOf(city, triangle);
    return areas;
}

Heightfield fieldOf(const CityModel& city) {
    HeightfieldSettings settings;
    settings.cellSize = 1.0;
    const auto grid = gridFor(city, settings);
    return *buildHeightfield(city, *grid, JobContext());
}

TEST(TraceBench, TheTenfoldCityHasTheSameSurfacesInTenTimesTheTriangles) {
    const CityModel city = blockCity(4000);
    const CityModel dense = tenfold(city);
    EXPECT_EQ(dense.triangles.size(), 10 * city.triangles.size());
    const auto expected = areasBySurface(city);
    const auto found = areasBySurface(dense);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [surface, area] : expected)
        EXPECT_NEAR(found.at(surface), area, 1e-4 * area);
    const Heightfield before = fieldOf(city);
    const Heightfield after = fieldOf(dense);
    ASSERT_EQ(after.grid, before.grid);
    std::size_t differing = 0;
    for (std::size_t k = 0; k < before.topMax.size(); ++k)
        differing += std::abs(after.topMax[k] - before.topMax[k]) > 1e-3F ? 1 : 0;
    EXPECT_LT(differing, before.topMax.size() / 1000);
}

TEST(TraceBench, TheCheckFindsATracerOfAnotherCity) {
    const Heightfield field = fieldOf(blockCity(4000));
    Heightfield other = field;
    for (float& height : other.topCenter)
        height += 0.25F;
    const JobContext job;
    EXPECT_EQ(randomMismatches(HeightfieldTracer(field), field, 20000, job), 0U);
    EXPECT_GT(randomMismatches(HeightfieldTracer(other), field, 20000, job), 1000U);
    const Ray down{{10.0, 10.0, 500.0}, {0.0, 0.0, -1.0}};
    const double t = HeightfieldTracer(field).trace(down).t;
    EXPECT_TRUE(isOracles(field, down, t));
    EXPECT_FALSE(isOracles(field, down, std::nextafter(t, 0.0)));
    EXPECT_FALSE(isOracles(field, down, std::numeric_limits<double>::infinity()));
}

TEST(TraceBench, CitiesAreTracedFromWhereTheirVehiclesDrive) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(test::importStreetWithCar(folder, folder / "street.reflet"));
    TraceBenchOptions options;
    options.files = {folder / "street.reflet"};
    options.poses = 5;
    const auto cities = traceBenchCities(options, JobContext());
    ASSERT_TRUE(cities);
    ASSERT_EQ(cities->size(), 1U);
    const TraceBenchCity& city = cities->front();
    EXPECT_EQ(city.positions.size(), 5U);
    for (const glm::dvec3& p : city.positions) {
        EXPECT_FALSE(city.tracer->trace({p, {0.0, 0.0, 1.0}}).hit) << "nothing above a vehicle";
        EXPECT_NEAR(city.tracer->trace({p, {0.0, 0.0, -1.0}}).t, 1.5, 1.5) << "near the ground";
    }
}

TEST(TraceBench, AMissingFileIsNamed) {
    TraceBenchOptions options;
    options.files = {"no-such.reflet"};
    const auto report = benchTrace(options, JobContext());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Unreadable);
    EXPECT_NE(report.error().subject.find("no-such.reflet"), std::string::npos);
}

}  // namespace
}  // namespace reflet
