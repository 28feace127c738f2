// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "tests/unit/heightfield/TracerFields.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

namespace reflet::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

struct Span {
    double enter;
    double leave;
};

/// When the ray is between two borders of one axis, straight from the contract's words.
Span between(double low, double high, double origin, double direction) {
    const double inverse = 1.0 / direction;
    if (std::isinf(inverse)) {
        return low <= origin && origin < high ? Span{-kForever, kForever} : Span{0.0, 0.0};
    }
    const double a = (low - origin) * inverse;
    const double b = (high - origin) * inverse;
    return direction > 0.0 ? Span{a, b} : Span{b, a};
}

/// Asks each column by itself, in no order, and keeps the earliest hit.
HeightfieldHit bruteForce(const GridSpec& grid, const std::vector<float>& layer, const Ray& ray) {
    HeightfieldHit best;
    best.t = kForever;
    for (int j = 0; j < grid.rows; ++j) {
        const Span y = between(grid.yMin(j), grid.yMin(j + 1), ray.origin.y, ray.direction.y);
        for (int i = 0; i < grid.columns; ++i) {
            const float height = layer[grid.index(i, j)];
            const Span x = between(grid.xMin(i), grid.xMin(i + 1), ray.origin.x, ray.direction.x);
            const double enter = std::max({0.0, x.enter, y.enter});
            const double leave = std::min(x.leave, y.leave);
            if (isMissing(height) || !(enter < leave)) {
                continue;
            }
            double t = kForever;
            if (ray.origin.z + enter * ray.direction.z <= double(height)) {
                t = enter;
            } else if (ray.direction.z < 0.0) {
                const double down = (double(height) - ray.origin.z) * (1.0 / ray.direction.z);
                t = down < leave ? std::max(enter, down) : kForever;
            }
            if (t < best.t) {
                best = {true, t, i, j};
            }
        }
    }
    return best.hit ? best : HeightfieldHit{};
}

Heightfield fieldOf(const GridSpec& grid, std::vector<float> layer) {
    return {grid, {}, layer, std::move(layer)};
}

const std::array<GridSpec, 5> kGrids{{
    {0.0, 0.0, 1.0, 13, 9},
    {-4.2, 17.7, 0.3, 11, 12},
    {123.1, -987.6, 0.1, 16, 8},
    {-1000.0, 500.0, 2.5, 1, 20},
    {3.0, 5.0, 0.5, 1, 1},
}};

TEST(HeightfieldTracer, FindsWhatAskingEveryColumnFindsOnEveryKindOfRay) {
    constexpr int perKind = REFLET_TRACER_RAYS / 10 / int(kGrids.size()) / int(RayKind::Count);
    int hits = 0;
    int misses = 0;
    for (const GridSpec& grid : kGrids) {
        const std::vector<float> layer = blockyLayer(grid, 7);
        const HeightfieldTracer tracer(fieldOf(grid, layer));
        RaySource rays(grid, layer, 11);
        for (int kind = 0; kind < int(RayKind::Count); ++kind) {
            for (int n = 0; n < perKind; ++n) {
                const Ray ray = rays.next(RayKind(kind));
                const HeightfieldHit expected = bruteForce(grid, layer, ray);
                const HeightfieldHit walked = traceReference(grid, layer, ray);
                ASSERT_TRUE(sameBits(walked, expected))
                    << "kind " << kind << " " << described(ray, expected, walked);
                const HeightfieldHit traced = tracer.trace(ray);
                ASSERT_TRUE(sameBits(traced, expected))
                    << "kind " << kind << " " << described(ray, expected, traced);
                ++(expected.hit ? hits : misses);
            }
        }
    }
    EXPECT_GT(hits, misses / 10);
    EXPECT_GT(misses, hits / 10);
}

/// A town of blocks and streets on gently rolling ground.
std::vector<float> townLayer(const GridSpec& grid) {
    std::vector<float> layer(grid.cellCount());
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const bool street = i % 40 < 9 || j % 60 < 11;
            const bool park = (i / 40 + j / 60) % 7 == 3;
            const float ground = 0.25F * std::floor(4.0F * std::sin(0.01F * float(i + 2 * j)));
            const auto floors = float(((i / 40) * 7 + (j / 60) * 13) % 9);
            layer[grid.index(i, j)] = street || park ? ground : ground + 3.0F * floors;
        }
    }
    return layer;
}

TEST(HeightfieldTracer, AgreesWithThePlainWalkBitForBitOverATown) {
    constexpr std::size_t chunk = 1000;
    const GridSpec grid{-333.3, 1200.1, 0.7, 500, 403};
    const std::vector<float> layer = townLayer(grid);
    const HeightfieldTracer tracer(fieldOf(grid, layer));
    std::atomic<std::size_t> differing = 0;
    std::atomic<std::size_t> differingTogether = 0;
    std::atomic<std::size_t> hits = 0;
    parallelFor(0, REFLET_TRACER_RAYS / chunk, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            RaySource source(grid, layer, unsigned(c));
            std::vector<Ray> rays(chunk);
            for (std::size_t n = 0; n < chunk; ++n)
                rays[n] = source.next(RayKind(n % std::size_t(RayKind::Count)));
            std::vector<HeightfieldHit> together(chunk);
            tracer.trace(rays, together);
            for (std::size_t n = 0; n < chunk; ++n) {
                const HeightfieldHit expected = traceReference(grid, layer, rays[n]);
                differing += sameBits(tracer.trace(rays[n]), expected) ? 0 : 1;
                differingTogether += sameBits(together[n], expected) ? 0 : 1;
                hits += expected.hit ? 1 : 0;
            }
        }
    });
    EXPECT_EQ(differingTogether, 0U);
    EXPECT_EQ(differing, 0U);
    EXPECT_GT(hits, std::size_t(REFLET_TRACER_RAYS / 4));
}

TEST(HeightfieldTracer, AgreesWithPlainRayBoxIntersectionToANanometre) {
    // Slabs by division, no border rules: the same up to rounding on rays in general position.
    const GridSpec grid{10.0, -20.0, 1.5, 12, 10};
    std::vector<float> layer = blockyLayer(grid, 23);
    const HeightfieldTracer tracer(fieldOf(grid, layer));
    RaySource rays(grid, layer, 5);
    int hits = 0;
    for (int n = 0; n < 20000; ++n) {
        const Ray ray = rays.next(RayKind::Anywhere);
        double nearest = kForever;
        for (int j = 0; j < grid.rows; ++j) {
            for (int i = 0; i < grid.columns; ++i) {
                const float height = layer[grid.index(i, j)];
                if (isMissing(height)) {
                    continue;
                }
                const glm::dvec3 low(grid.xMin(i), grid.yMin(j), -1e6);
                const glm::dvec3 high(grid.xMin(i + 1), grid.yMin(j + 1), height);
                const glm::dvec3 a = (low - ray.origin) / ray.direction;
                const glm::dvec3 b = (high - ray.origin) / ray.direction;
                const glm::dvec3 in = glm::min(a, b);
                const glm::dvec3 out = glm::max(a, b);
                const double enter = std::max({0.0, in.x, in.y, in.z});
                if (enter <= std::min({out.x, out.y, out.z})) {
                    nearest = std::min(nearest, enter);
                }
            }
        }
        const HeightfieldHit hit = tracer.trace(ray);
        ASSERT_EQ(hit.hit, nearest < kForever);
        if (hit.hit) {
            ASSERT_NEAR(hit.t, nearest, 1e-9);
            ++hits;
        }
    }
    EXPECT_GT(hits, 4000);
}

/// One tower of 10 m in cell (2, 1) of a 5 x 3 plain at height 0.
struct Tower {
    GridSpec grid{0.0, 0.0, 1.0, 5, 3};
    std::vector<float> layer = std::vector<float>(15, 0.0F);
    Tower() { layer[grid.index(2, 1)] = 10.0F; }
    [[nodiscard]] HeightfieldHit trace(glm::dvec3 origin, glm::dvec3 direction) const {
        const HeightfieldHit hit =
            HeightfieldTracer(fieldOf(grid, layer)).trace({origin, direction});
        EXPECT_EQ(hit, traceReference(grid, layer, {origin, direction}));
        return hit;
    }
};

TEST(HeightfieldTracer, HitsAWallWhereTheRayEntersTheColumn) {
    EXPECT_EQ(Tower().trace({0.5, 1.5, 5}, {1, 0, 0}), (HeightfieldHit{true, 1.5, 2, 1}));
    EXPECT_EQ(Tower().trace({4.5, 1.5, 5}, {-0.5, 0, 0}), (HeightfieldHit{true, 3.0, 2, 1}));
    EXPECT_EQ(Tower().trace({-7, 1.5, 5}, {1, 0, 0}), (HeightfieldHit{true, 9.0, 2, 1}));
}

TEST(HeightfieldTracer, HitsTheTopFromAboveAndPassesOverIt) {
    EXPECT_EQ(Tower().trace({2.5, 1.5, 30}, {0, 0, -1}), (HeightfieldHit{true, 20.0, 2, 1}));
    EXPECT_EQ(Tower().trace({0.5, 1.5, 12}, {1, 0, -1}), (HeightfieldHit{true, 2.0, 2, 1}));
    EXPECT_FALSE(Tower().trace({0.5, 1.5, 10.01}, {1, 0, 0}).hit);
    EXPECT_TRUE(Tower().trace({0.5, 1.5, 10.0}, {1, 0, 0}).hit);
    EXPECT_FALSE(Tower().trace({2.5, 1.5, 11}, {0, 0, 1}).hit);
}

TEST(HeightfieldTracer, HitsAtOnceWhenItStartsInsideABuildingOrOnARoof) {
    EXPECT_EQ(Tower().trace({2.5, 1.5, 5}, {0, 0, 1}), (HeightfieldHit{true, 0.0, 2, 1}));
    EXPECT_EQ(Tower().trace({2.5, 1.5, 10}, {0, 0, 1}), (HeightfieldHit{true, 0.0, 2, 1}));
}

TEST(HeightfieldTracer, LeavesAWallThatItStartsOnAndMovesAwayFrom) {
    EXPECT_EQ(Tower().trace({2, 1.5, 5}, {1, 0, 0}), (HeightfieldHit{true, 0.0, 2, 1}));
    EXPECT_FALSE(Tower().trace({2, 1.5, 5}, {-1, 0, 0}).hit);
    EXPECT_FALSE(Tower().trace({3, 1.5, 5}, {1, 0, 0}).hit);
    EXPECT_EQ(Tower().trace({3, 1.5, 5}, {-1, 0, 0}), (HeightfieldHit{true, 0.0, 2, 1}));
}

TEST(HeightfieldTracer, FollowsTheHalfOpenSquareAlongABorder) {
    EXPECT_EQ(Tower().trace({2, 0.5, 5}, {0, 1, 0}), (HeightfieldHit{true, 0.5, 2, 1}));
    EXPECT_FALSE(Tower().trace({3, 0.5, 5}, {0, 1, 0}).hit);
    EXPECT_FALSE(Tower().trace({3, 0.5, 5}, {-0.0, 1, 0}).hit);
}

TEST(HeightfieldTracer, GoesDiagonallyThroughACornerWithoutTouchingTheCellsBeside) {
    EXPECT_FALSE(Tower().trace({1.5, 0.5 + 1.0, 5}, {1, 1, 0}).hit);
    EXPECT_EQ(Tower().trace({1.5, 0.5, 5}, {1, 1, 0}), (HeightfieldHit{true, 0.5, 2, 1}));
    EXPECT_EQ(Tower().trace({3.5, 2.5, 5}, {-1, -1, 0}), (HeightfieldHit{true, 0.5, 2, 1}));
    EXPECT_FALSE(Tower().trace({3.5, 1.5, 5}, {-1, 1, 0}).hit);
}

TEST(HeightfieldTracer, MissesWithRaysThatNameNoLine) {
    const double nan = std::nan("");
    EXPECT_FALSE(Tower().trace({2.5, 1.5, 5}, {0, 0, 0}).hit);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double bad : {nan, kForever, -kForever}) {
            glm::dvec3 origin(2.5, 1.5, 5);
            glm::dvec3 direction(0.5, 0.25, -0.5);
            origin[axis] = bad;
            const Tower tower;
            EXPECT_FALSE(traceReference(tower.grid, tower.layer, {origin, direction}).hit);
            EXPECT_FALSE(
                HeightfieldTracer(fieldOf(tower.grid, tower.layer)).trace({origin, direction}).hit);
            std::swap(origin[axis], direction[axis]);
            EXPECT_FALSE(traceReference(tower.grid, tower.layer, {origin, direction}).hit);
            EXPECT_FALSE(
                HeightfieldTracer(fieldOf(tower.grid, tower.layer)).trace({origin, direction}).hit);
        }
    }
}

TEST(HeightfieldTracer, PassesThroughMissingCells) {
    Tower tower;
    tower.layer[tower.grid.index(0, 1)] = kMissingHeight;
    EXPECT_FALSE(tower.trace({0.5, 1.5, 5}, {0, 0, -1}).hit);
    EXPECT_EQ(tower.trace({0.5, 1.5, -5}, {1, 0, 0}), (HeightfieldHit{true, 0.5, 1, 1}));
}

TEST(HeightfieldTracer, TakesItsColumnsFromTheLayerThatItIsGiven) {
    Heightfield field;
    field.grid = {0.0, 0.0, 1.0, 1, 1};
    field.topMax = {4.0F};
    field.topCenter = {2.0F};
    const Ray down{{0.5, 0.5, 10.0}, {0.0, 0.0, -1.0}};
    EXPECT_EQ(HeightfieldTracer(field, TopLayer::Maximum).trace(down).t, 6.0);
    EXPECT_EQ(HeightfieldTracer(field).trace(down).t, 8.0);
}

TEST(MaxPyramid, HoldsTheMaximumOfEachBlockOnEachLevel) {
    for (const GridSpec& grid :
         {GridSpec{0, 0, 1, 13, 9}, GridSpec{0, 0, 1, 1, 7}, GridSpec{0, 0, 1, 64, 64}}) {
        const std::vector<float> layer = blockyLayer(grid, 3);
        const MaxPyramid pyramid = buildMaxPyramid(grid, layer);
        ASSERT_EQ(pyramid.levels.back().maximum.size(), 1U);
        for (std::size_t level = 0; level < pyramid.levels.size(); ++level) {
            const MaxPyramid::Level& blocks = pyramid.levels[level];
            const int size = 1 << level;
            ASSERT_EQ(blocks.columns, (grid.columns + size - 1) / size);
            ASSERT_EQ(blocks.rows, (grid.rows + size - 1) / size);
            std::vector<float> expected(blocks.maximum.size(), -kInfinity);
            for (int j = 0; j < grid.rows; ++j) {
                for (int i = 0; i < grid.columns; ++i) {
                    const float height = layer[grid.index(i, j)];
                    float& block = expected[std::size_t(j / size) * std::size_t(blocks.columns) +
                                            std::size_t(i / size)];
                    block = isMissing(height) ? block : std::max(block, height);
                }
            }
            ASSERT_EQ(blocks.maximum, expected);
        }
    }
}

}  // namespace
}  // namespace reflet::test
