// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "importers/cityjson/CityJsonImporter.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet::test {
namespace {

/// Delft, where terrain, roads, water, bridges and buildings make up one seamless surface.
class HeightfieldOfDelft : public testing::Test {
protected:
    void SetUp() override {
        const auto path = sharedData("cityjson/delft-terrain.city.json");
        if (!path) {
            GTEST_SKIP() << kNoSharedData;
        }
        auto imported = importCityJson(*path, {}, {});
        ASSERT_TRUE(imported) << imported.error().message();
        city = std::move(imported->value.city);
        const auto grid = gridFor(city, {});
        ASSERT_TRUE(grid) << grid.error().message();
        auto built = buildHeightfield(city, *grid, {});
        ASSERT_TRUE(built) << built.error().message();
        field = std::move(*built);
    }

    [[nodiscard]] std::array<glm::dvec3, 3> corners(std::size_t n) const {
        const auto& vertex = city.triangles[n].vertex;
        return {glm::dvec3(city.vertices[vertex[0]]), glm::dvec3(city.vertices[vertex[1]]),
                glm::dvec3(city.vertices[vertex[2]])};
    }

    /// Highest surface over a point by asking every triangle; NaN when none is there.
    [[nodiscard]] double highestAt(double x, double y) const {
        double highest = std::nan("");
        for (std::size_t n = 0; n < city.triangles.size(); ++n) {
            const auto [a, b, c] = corners(n);
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            if (normal.z == 0.0) {
                continue;
            }
            const auto area = [&](const glm::dvec3& p, const glm::dvec3& q) {
                return ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)) / normal.z;
            };
            if (area(a, b) >= 0.0 && area(b, c) >= 0.0 && area(c, a) >= 0.0) {
                const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
                highest = z > highest || std::isnan(highest) ? z : highest;
            }
        }
        return highest;
    }

    CityModel city;
    Heightfield field;
};

TEST_F(HeightfieldOfDelft, ShowsAtItsCentresWhatAskingEveryTriangleShows) {
    std::mt19937 random(4);
    const GridSpec& grid = field.grid;
    int covered = 0;
    for (int n = 0; n < 1000; ++n) {
        const int i = int(random() % unsigned(grid.columns));
        const int j = int(random() % unsigned(grid.rows));
        const double expected =
            highestAt(grid.xMin(i) + 0.5 * grid.cellSize, grid.yMin(j) + 0.5 * grid.cellSize);
        const std::size_t cell = grid.index(i, j);
        if (std::isnan(expected)) {
            // Nothing but the ground interpolated across a hole or out to the hull, if that.
            ASSERT_EQ(isMissing(field.topCenter[cell]), isMissing(field.ground[cell]));
            continue;
        }
        ASSERT_NEAR(double(field.topCenter[cell]), expected, 2e-6);
        ASSERT_LE(field.topCenter[cell], field.topMax[cell]);
        ASSERT_FALSE(isMissing(field.ground[cell]));
        ++covered;
    }
    EXPECT_GT(covered, 150);
}

TEST_F(HeightfieldOfDelft, HasNoPointOfASurfaceAboveItsCell) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 100000; ++n) {
        const auto [a, b, c] = corners(random() % city.triangles.size());
        const double u = unit(random);
        const double v = (1.0 - u) * unit(random);
        const glm::dvec3 p = a + u * (b - a) + v * (c - a);
        const int i = field.grid.column(p.x);
        const int j = field.grid.row(p.y);
        if (field.grid.contains(i, j)) {
            ASSERT_LE(p.z, double(field.topMax[field.grid.index(i, j)]) + 1e-9);
        }
    }
}

TEST_F(HeightfieldOfDelft, IsTracedAsThePlainWalkTracesIt) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const GridSpec& grid = field.grid;
    const HeightfieldTracer tracer(field);
    int hits = 0;
    for (int n = 0; n < 50000; ++n) {
        const std::size_t cell = random() % grid.cellCount();
        const int i = int(cell % std::size_t(grid.columns));
        const int j = int(cell / std::size_t(grid.columns));
        const float ground = isMissing(field.ground[cell]) ? 0.0F : field.ground[cell];
        const Ray ray{{grid.xMin(i), grid.yMin(j), double(ground) + 1.5},
                      {unit(random), unit(random), 0.3 * unit(random)}};
        const HeightfieldHit hit = tracer.trace(ray);
        ASSERT_EQ(hit, traceReference(grid, field.topCenter, ray));
        hits += hit.hit ? 1 : 0;
    }
    EXPECT_GT(hits, 15000);
}

}  // namespace
}  // namespace reflet::test
