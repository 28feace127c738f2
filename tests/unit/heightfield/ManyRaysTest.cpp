// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/heightfield/TrackWalk.h"
#include "tests/unit/heightfield/TracerFields.h"
#include "tests/unit/heightfield/TracerRays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reflet::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr int kRays = REFLET_TRACER_RAYS / 100;

/// Each instruction set that this machine has, one after another.
class ManyRays : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override { useWalkTarget(GetParam()); }
    void TearDown() override { useWalkTarget({}); }
};

HeightfieldHit oracle(const Heightfield& field, const Ray& ray) {
    return traceReference(field.grid, field.topCenter, field.centerSpans, ray);
}

/// Answers of traceFrom() and traceGrid() as hits.
struct Answers {
    std::vector<double> t;
    std::vector<std::uint32_t> cell;

    explicit Answers(std::size_t count) : t(count, -1.0), cell(count, 7) {}
    [[nodiscard]] RayHits spans() { return {t, cell}; }
    [[nodiscard]] HeightfieldHit at(std::size_t k, const GridSpec& grid) const {
        if (cell[k] == kNoCell)
            return {false, t[k] == kForever ? 0.0 : t[k], -1, -1};
        return {true, t[k], int(cell[k]) % grid.columns, int(cell[k]) / grid.columns};
    }
};

const std::array<GridSpec, 5> kGrids{{
    {0.0, 0.0, 1.0, 13, 9},
    {-4.2, 17.7, 0.3, 150, 70},
    {123.1, -987.6, 0.1, 64, 8},
    {-1000.0, 500.0, 2.5, 1, 200},
    {3.0, 5.0, 0.5, 1, 1},
}};

TEST_P(ManyRays, AgreeWithTheOracleBitForBitOnEveryKindOfRay) {
    std::size_t hits = 0, all = 0;
    for (const GridSpec& grid : kGrids) {
        for (const bool hollow : {false, true}) {
            const Heightfield field = hollow ? blockyColumns(grid, 3) : blockyField(grid, 7);
            const HeightfieldTracer tracer(field);
            RaySource source(grid, field.topCenter, 11);
            std::vector<Ray> rays;
            for (int n = 0; n < kRays / 10; ++n)
                rays.push_back(source.next(RayKind(n % int(RayKind::Count))));
            std::vector<HeightfieldHit> found(rays.size());
            tracer.trace(rays, found);
            for (std::size_t k = 0; k < rays.size(); ++k) {
                const HeightfieldHit expected = oracle(field, rays[k]);
                ASSERT_TRUE(sameBits(found[k], expected)) << described(rays[k], expected, found[k]);
                hits += expected.hit ? 1 : 0;
                ++all;
            }
        }
    }
    EXPECT_GT(hits, all / 10);
    EXPECT_GT(all - hits, all / 10);
}

/// Directions of which many share x and y, in no order: zeros of both signs, repetitions, rays
/// without any direction, and some that are not finite.
std::vector<glm::dvec3> fan(RaySource& source, std::mt19937& random, std::size_t count) {
    std::vector<glm::dvec3> ways, directions;
    for (std::size_t n = 0; n < 1 + count / 9; ++n)
        ways.push_back(source.next(RayKind(n % std::size_t(RayKind::Count))).direction);
    for (std::size_t n = 0; n < count; ++n) {
        glm::dvec3 d = ways[random() % ways.size()];
        if (n % 3 != 0)
            d.z = 0.1 * (double(random() % 21) - 10.0);
        if (n % 101 == 0)
            d = glm::dvec3(0.0, -0.0, 0.0);
        if (n % 103 == 0)
            d.z = n % 2 == 0 ? kForever : std::numeric_limits<double>::quiet_NaN();
        directions.push_back(d);
    }
    return directions;
}

TEST_P(ManyRays, OfOneOriginAgreeWithTheOracleHoweverManyShareTheirWay) {
    std::mt19937 random(5);
    std::size_t hits = 0, all = 0;
    for (const GridSpec& grid : kGrids) {
        for (const bool hollow : {false, true}) {
            const Heightfield field = hollow ? blockyColumns(grid, 3) : blockyField(grid, 7);
            const HeightfieldTracer tracer(field);
            RaySource source(grid, field.topCenter, 13);
            for (int n = 0; n < kRays / 2000; ++n) {
                const glm::dvec3 origin = source.next(RayKind(n % int(RayKind::Count))).origin;
                const auto directions = fan(source, random, random() % 400);
                Answers answers(directions.size());
                tracer.traceFrom(origin, directions, answers.spans());
                for (std::size_t k = 0; k < directions.size(); ++k) {
                    const Ray ray{origin, directions[k]};
                    const HeightfieldHit expected = oracle(field, ray);
                    const HeightfieldHit found = answers.at(k, grid);
                    ASSERT_TRUE(sameBits(found, expected)) << described(ray, expected, found);
                    hits += expected.hit ? 1 : 0;
                    ++all;
                }
            }
        }
    }
    EXPECT_GT(hits, all / 20);
    EXPECT_GT(all - hits, all / 20);
}

/// The faces of a cube, turned anyhow: the vertical axis is the base, or grows along rows or
/// columns, up or down.
std::vector<DirectionGrid> faces(std::span<const double> column, std::span<const double> row) {
    std::vector<DirectionGrid> grids;
    for (int base = 0; base < 3; ++base) {
        for (const int turn : {1, 2}) {
            for (const double sign : {-1.0, 1.0}) {
                DirectionGrid grid;
                grid.base[base] = sign;
                grid.columnAxis[(base + turn) % 3] = -sign;
                grid.rowAxis[(base + 3 - turn) % 3] = sign;
                grid.column = column;
                grid.row = row;
                grids.push_back(grid);
            }
        }
    }
    return grids;
}

TEST_P(ManyRays, OfWholeFacesAgreeWithTheOracle) {
    std::vector<double> column, row;
    for (int k = 0; k < 37; ++k)
        column.push_back((2.0 * k + 1.0) / 37.0 - 1.0);
    for (int k = 0; k <= 20; ++k)
        row.push_back(0.1 * k - 1.0);
    std::size_t hits = 0, all = 0;
    for (const GridSpec& grid : kGrids) {
        for (const bool hollow : {false, true}) {
            const Heightfield field = hollow ? blockyColumns(grid, 3) : blockyField(grid, 7);
            const HeightfieldTracer tracer(field);
            RaySource source(grid, field.topCenter, 17);
            for (const DirectionGrid& face : faces(column, row)) {
                const glm::dvec3 origin = source.next(RayKind::Anywhere).origin;
                Answers answers(face.size());
                tracer.traceGrid(origin, face, answers.spans());
                for (std::size_t k = 0; k < face.size(); ++k) {
                    const Ray ray{origin, face.at(k % column.size(), k / column.size())};
                    const HeightfieldHit expected = oracle(field, ray);
                    const HeightfieldHit found = answers.at(k, grid);
                    ASSERT_TRUE(sameBits(found, expected)) << described(ray, expected, found);
                    hits += expected.hit ? 1 : 0;
                    ++all;
                }
            }
        }
    }
    EXPECT_GT(hits, all / 20);
    EXPECT_GT(all - hits, all / 20);
}

TEST_P(ManyRays, LeaveTheCellsAloneWhenNobodyWantsThem) {
    const Heightfield field = blockyField(kGrids[0], 7);
    const HeightfieldTracer tracer(field);
    const glm::dvec3 origin(3.3, 4.4, 20.0);
    const std::vector<glm::dvec3> directions{{0, 0, -1}, {0.1, 0.2, -1}, {0, 0, 1}};
    std::vector<double> t(3);
    tracer.traceFrom(origin, directions, {t});
    for (std::size_t k = 0; k < 3; ++k) {
        const HeightfieldHit expected = oracle(field, {origin, directions[k]});
        EXPECT_EQ(t[k], expected.hit ? expected.t : kForever);
    }
    EXPECT_EQ(t[2], kForever);
}

TEST_P(ManyRays, AreTheSameForAnyNumberOfThreads) {
    const GridSpec grid{-50.0, 20.0, 0.7, 300, 200};
    const Heightfield field = blockyField(grid, 9);
    const HeightfieldTracer tracer(field);
    RaySource source(grid, field.topCenter, 19);
    std::mt19937 random(7);
    const auto directions = fan(source, random, 20000);
    const glm::dvec3 origin(40.0, 90.0, 6.0);
    std::vector<std::vector<double>> t;
    for (const int threads : {1, 2, 7}) {
        setThreadLimit(threads);
        t.emplace_back(directions.size());
        tracer.traceFrom(origin, directions, {t.back()});
    }
    setThreadLimit(0);
    EXPECT_EQ(t[0], t[1]);
    EXPECT_EQ(t[0], t[2]);
}

/// Leaves nothing on the stack that could pass for a number.
[[gnu::noinline]] void fillStackWithNan() {
    std::array<volatile double, 16384> rubbish;
    for (volatile double& value : rubbish)
        value = std::numeric_limits<double>::quiet_NaN();
}

TEST_P(ManyRays, MayBeFewerThanTheProcessorHasLanes) {
    const GridSpec grid{-5.0, 2.0, 0.7, 30, 20};
    const Heightfield field = blockyField(grid, 3);
    const HeightfieldTracer tracer(field);
    const glm::dvec3 origin(4.0, 9.0, 2.5);
    setThreadLimit(1);
    for (std::size_t count = 0; count < 18; ++count) {
        std::vector<glm::dvec3> directions;
        for (std::size_t k = 0; k < count; ++k)
            directions.emplace_back(std::cos(double(k)), std::sin(double(k)), -0.1 * double(k % 4));
        std::vector<double> t(count);
        fillStackWithNan();
        tracer.traceFrom(origin, directions, {t, {}});
        for (std::size_t k = 0; k < count; ++k) {
            const HeightfieldHit expected = oracle(field, {origin, directions[k]});
            EXPECT_EQ(t[k], expected.hit ? expected.t : kForever);
        }
    }
    setThreadLimit(0);
}

INSTANTIATE_TEST_SUITE_P(Targets, ManyRays, testing::ValuesIn(walkTargets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace reflet::test
