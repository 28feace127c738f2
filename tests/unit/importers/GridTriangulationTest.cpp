// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/GridTriangulation.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

namespace reflet::terrain {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <class HeightOf>
HeightGrid gridOf(int columns, int rows, const HeightOf& heightOf) {
    HeightGrid grid{columns, rows, {}};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            grid.heights.push_back(float(heightOf(i, j)));
    return grid;
}

/// Hills with noise on one half: even and rough ground.
HeightGrid hills(int columns, int rows) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.5, 0.5);
    return gridOf(columns, rows, [&](int i, int j) {
        const double hill = 20.0 * std::sin(i * 0.02) * std::cos(j * 0.03);
        return i > columns / 2 ? hill + noise(random) : hill;
    });
}

GridTriangles triangulated(const HeightGrid& grid, const Decimation& decimation) {
    auto made = triangulateGrid(grid, decimation, {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

double areaOf(const GridTriangles& t, std::size_t k) {
    const auto& [a, b, c] = t.triangles[k];
    const glm::dvec2 u = t.places[b] - t.places[a];
    const glm::dvec2 v = t.places[c] - t.places[a];
    return 0.5 * std::abs(u.x * v.y - u.y * v.x);
}

double totalArea(const GridTriangles& t) {
    double total = 0.0;
    for (std::size_t k = 0; k < t.triangles.size(); ++k)
        total += areaOf(t, k);
    return total;
}

/// The height of a triangle over a place; nullopt beside it.
std::optional<double> heightOver(const GridTriangles& t, std::size_t k, const glm::dvec2& p) {
    const auto& [a, b, c] = t.triangles[k];
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) {
        return u.x * v.y - u.y * v.x;
    };
    const glm::dvec2 ab = t.places[b] - t.places[a];
    const glm::dvec2 ac = t.places[c] - t.places[a];
    const double whole = cross(ab, ac);
    const double r = cross(p - t.places[a], ac) / whole;
    const double s = cross(ab, p - t.places[a]) / whole;
    constexpr double kHair = 1e-9;
    if (r < -kHair || s < -kHair || r + s > 1.0 + kHair)
        return std::nullopt;
    return t.heights[a] + r * (t.heights[b] - t.heights[a]) + s * (t.heights[c] - t.heights[a]);
}

/// The largest distance of a post from the triangles over it; posts without one are counted.
double largestError(const HeightGrid& grid, const GridTriangles& t, std::size_t& uncovered) {
    std::vector<double> error(grid.heights.size(), -1.0);
    for (std::size_t k = 0; k < t.triangles.size(); ++k) {
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const std::uint32_t v : t.triangles[k]) {
            low = glm::min(low, t.places[v]);
            high = glm::max(high, t.places[v]);
        }
        for (int j = int(std::ceil(low.y)); j <= int(high.y); ++j) {
            for (int i = int(std::ceil(low.x)); i <= int(high.x); ++i) {
                const auto z = heightOver(t, k, {double(i), double(j)});
                double& e = error[std::size_t(j) * std::size_t(grid.columns) + std::size_t(i)];
                if (z && !std::isnan(grid.at(i, j)))
                    e = std::max(e, std::abs(*z - double(grid.at(i, j))));
            }
        }
    }
    uncovered =
        std::size_t(std::count_if(error.begin(), error.end(), [](double e) { return e < 0.0; }));
    return *std::max_element(error.begin(), error.end());
}

/// Edges that only one triangle has, and that do not lie on the rim of the grid: cracks.
std::size_t cracks(const HeightGrid& grid, const GridTriangles& t) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& triangle : t.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++uses[std::minmax(triangle[k], triangle[(k + 1) % 3])];
    const auto onRim = [&](const glm::dvec2& p, const glm::dvec2& q) {
        return (p.x == q.x && (p.x == 0.0 || p.x == grid.columns - 1)) ||
               (p.y == q.y && (p.y == 0.0 || p.y == grid.rows - 1));
    };
    std::size_t count = 0;
    for (const auto& [edge, times] : uses)
        if (times != 2 && !(times == 1 && onRim(t.places[edge.first], t.places[edge.second])))
            ++count;
    return count;
}

TEST(GridTriangulation, OfEvenGroundAFewTrianglesAreLeftAndTheyCoverItAll) {
    const HeightGrid grid = gridOf(701, 402, [](int i, int j) { return 3.0 + 0.25 * i - 0.5 * j; });
    const GridTriangles t = triangulated(grid, {1e-4, 1'000'000});
    EXPECT_LE(t.triangles.size(), 40U);
    EXPECT_DOUBLE_EQ(totalArea(t), 700.0 * 401.0);
    std::size_t uncovered = 0;
    EXPECT_LE(largestError(grid, t, uncovered), 1e-4);
    EXPECT_EQ(uncovered, 0U);
    EXPECT_EQ(cracks(grid, t), 0U);
}

TEST(GridTriangulation, NoPostLiesFurtherOffThanTheErrorAndNoCrackIsLeft) {
    for (const auto& [columns, rows] : {std::pair{300, 270}, {257, 257}, {37, 513}, {2, 2}}) {
        const HeightGrid grid = hills(columns, rows);
        for (const double error : {0.02, 0.2, 2.0}) {
            const GridTriangles t = triangulated(grid, {error, 1'000'000});
            EXPECT_EQ(t.error, error);
            std::size_t uncovered = 0;
            EXPECT_LE(largestError(grid, t, uncovered), error + 1e-9) << columns << " " << error;
            EXPECT_EQ(uncovered, 0U);
            EXPECT_EQ(cracks(grid, t), 0U) << columns << " " << error;
            EXPECT_NEAR(totalArea(t), (columns - 1.0) * (rows - 1.0), 1e-6);
        }
    }
}

TEST(GridTriangulation, WithoutErrorEveryPostOfRoughGroundIsKept) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(0.0, 10.0);
    const HeightGrid grid = gridOf(83, 51, [&](int, int) { return noise(random); });
    const GridTriangles t = triangulated(grid, {0.0, 1'000'000});
    EXPECT_EQ(t.triangles.size(), 2U * 82U * 50U);
    EXPECT_EQ(t.places.size(), 83U * 51U);
    std::size_t uncovered = 0;
    EXPECT_EQ(largestError(grid, t, uncovered), 0.0);
}

TEST(GridTriangulation, MissingPostsMakeNoTrianglesAndNoCliffs) {
    HeightGrid grid = gridOf(200, 150, [](int, int) { return 50.0; });
    for (int j = 60; j < 90; ++j)
        for (int i = 100; i < 140; ++i)
            grid.heights[std::size_t(j) * 200 + std::size_t(i)] = kNaN;
    const GridTriangles t = triangulated(grid, {0.1, 1'000'000});
    for (const double z : t.heights)
        EXPECT_EQ(z, 50.0);
    std::size_t uncovered = 0;
    largestError(grid, t, uncovered);
    EXPECT_EQ(uncovered, 30U * 40U) << "all posts that have a height are covered, the others not";
    // The gap is 41 by 31 cells; at its corners half a cell may be left.
    EXPECT_NEAR(totalArea(t), 199.0 * 149.0 - 41.0 * 31.0, 2.0);
    EXPECT_LT(t.triangles.size(), 3000U) << "only beside the gap the triangles are small";
}

TEST(GridTriangulation, OneMissingPostLeavesAHoleOfItsOwnTriangles) {
    HeightGrid grid = gridOf(9, 9, [](int, int) { return 1.0; });
    grid.heights[4 * 9 + 3] = kNaN;
    const GridTriangles t = triangulated(grid, {0.1, 1'000'000});
    EXPECT_NEAR(totalArea(t), 64.0 - 2.0, 1e-12) << "an odd post has four triangles about it";
}

TEST(GridTriangulation, KeepsToTheNumberOfTrianglesAndTellsTheErrorThatItCosts) {
    const HeightGrid grid = hills(400, 400);
    const GridTriangles t = triangulated(grid, {0.01, 5'000});
    EXPECT_LE(t.triangles.size(), 5'200U) << "cutting at the rim may add some";
    EXPECT_GE(t.triangles.size(), 2'500U) << "what may be used is used";
    EXPECT_GT(t.error, 0.01);
    std::size_t uncovered = 0;
    EXPECT_LE(largestError(grid, t, uncovered), t.error + 1e-9);
    EXPECT_EQ(cracks(grid, t), 0U);
}

TEST(GridTriangulation, GridsWithoutACellGiveNothing) {
    for (const auto& [columns, rows] : {std::pair{1, 5}, {5, 1}, {1, 1}, {0, 0}})
        EXPECT_TRUE(triangulated(gridOf(columns, rows, [](int, int) { return 1.0; }), {})
                        .triangles.empty());
    EXPECT_TRUE(triangulated(gridOf(20, 20, [](int, int) { return kNaN; }), {}).triangles.empty());
}

TEST(GridTriangulation, ACancelledJobSaysSo) {
    std::stop_source stop;
    stop.request_stop();
    const auto made = triangulateGrid(hills(300, 300), {}, JobContext({}, stop.get_token()));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::Cancelled);
}

TEST(GridTriangulation, TheFinestHeightIsThatOfTheTrianglesOverAllPosts) {
    const HeightGrid grid = hills(12, 12);
    const GridTriangles t = triangulated(grid, {0.0, 1'000'000});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0.0, 11.0);
    for (int n = 0; n < 300; ++n) {
        const glm::dvec2 p(place(random), place(random));
        const int i = int(p.x);
        const int j = int(p.y);
        const double z = finestHeight(
            {grid.at(i, j), grid.at(i + 1, j), grid.at(i, j + 1), grid.at(i + 1, j + 1)}, i, j,
            p.x - i, p.y - j);
        bool found = false;
        for (std::size_t k = 0; k < t.triangles.size() && !found; ++k) {
            if (const auto own = heightOver(t, k, p)) {
                EXPECT_NEAR(*own, z, 1e-9);
                found = true;
            }
        }
        EXPECT_TRUE(found);
    }
}

}  // namespace
}  // namespace reflet::terrain
