// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace reflet::test {
namespace {

using Point = std::array<long double, 3>;

Heightfield built(const CityModel& city, const GridSpec& grid) {
    auto field = buildHeightfield(city, grid, {});
    EXPECT_TRUE(field) << field.error().message();
    return field ? std::move(*field) : Heightfield{};
}

GridSpec square(double extent, double cellSize) {
    const int count = int(std::lround(extent / cellSize));
    return {0.0, 0.0, cellSize, count, count};
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
               return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
           });
}

void expectSameBits(const Heightfield& a, const Heightfield& b) {
    EXPECT_TRUE(sameBits(a.topMax, b.topMax));
    EXPECT_TRUE(sameBits(a.topCenter, b.topCenter));
    EXPECT_TRUE(sameBits(a.ground, b.ground));
}

/// Number of float32 steps from a to b; huge when just one is missing.
std::int64_t steps(float a, float b) {
    if (isMissing(a) || isMissing(b)) {
        return isMissing(a) && isMissing(b) ? 0 : 1'000'000;
    }
    const auto order = [](float value) {
        const auto bits = std::bit_cast<std::int32_t>(value);
        return std::int64_t(bits < 0 ? std::int32_t(0x80000000U) - bits : bits);
    };
    return std::abs(order(a) - order(b));
}

/// A town with a bumpy terrain that has holes, boxes in and beside the holes, and some triangles
/// of every kind: what a real city has, in small.
CityModel town(unsigned seed) {
    std::mt19937 random(seed);
    TestCity model;
    const auto at = [](int i, int j) {
        return glm::vec3(float(4 * i), float(4 * j), 0.5F * float((i * 5 + j * 3) % 7));
    };
    model.object(CityObjectType::TinRelief);
    for (int j = 0; j < 16; ++j) {
        for (int i = 0; i < 16; ++i) {
            if (random() % 5 != 0) {
                model.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
    }
    for (int n = 0; n < 12; ++n) {
        const glm::vec3 low(float(random() % 224) * 0.25F, float(random() % 224) * 0.25F, 0);
        model.box(low, low + glm::vec3(3.1F, 6.7F, 4.0F + float(random() % 20)));
    }
    CityModel city = model.city;
    append(city, randomTriangles(200, 64.0F, seed + 1).city);
    return city;
}

/// The triangle's maximum over the closed square, by listing where a linear function can be
/// highest: its corners in the square, its edges on the square's sides, the square's corners in it.
class HighestPoint {
public:
    HighestPoint(const std::array<Point, 3>& triangle, std::array<long double, 4> box)
        : m_box(box) {
        for (std::size_t n = 0; n < 3; ++n) {
            const Point& a = triangle[n];
            const Point& b = triangle[(n + 1) % 3];
            consider(a);
            for (std::size_t side = 0; side < 4; ++side) {
                const std::size_t axis = side / 2;
                if ((a[axis] < box[side]) != (b[axis] < box[side])) {
                    const long double s = (box[side] - a[axis]) / (b[axis] - a[axis]);
                    Point p{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]),
                            a[2] + s * (b[2] - a[2])};
                    p[axis] = box[side];
                    consider(p);
                }
            }
        }
        for (const long double x : {box[0], box[1]}) {
            for (const long double y : {box[2], box[3]}) {
                if (const auto z = heightAt(triangle, x, y); z > -kInfinity) {
                    consider({x, y, z});
                }
            }
        }
    }

    /// The triangle's plane over (x, y) if that is strictly inside; else -infinity.
    static long double heightAt(const std::array<Point, 3>& t, long double x, long double y) {
        std::array<long double, 3> weight{};
        for (std::size_t n = 0; n < 3; ++n) {
            const Point& a = t[(n + 1) % 3];
            const Point& b = t[(n + 2) % 3];
            weight[n] = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        }
        const long double sum = weight[0] + weight[1] + weight[2];
        long double z = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            if (!(weight[n] / sum > 0)) {
                return -kInfinity;
            }
            z += weight[n] / sum * t[n][2];
        }
        return z;
    }

    long double value = -kInfinity;

private:
    void consider(const Point& p) {
        if (p[0] >= m_box[0] && p[0] <= m_box[1] && p[1] >= m_box[2] && p[1] <= m_box[3]) {
            value = std::max(value, p[2]);
        }
    }
    std::array<long double, 4> m_box;
};

std::array<Point, 3> exactCorners(const CityModel& city, const CityTriangle& triangle) {
    std::array<Point, 3> corners;
    for (std::size_t n = 0; n < 3; ++n) {
        const glm::vec3& p = city.vertices[triangle.vertex[n]];
        corners[n] = {p.x, p.y, p.z};
    }
    return corners;
}

TEST(HeightfieldProperty, EqualsTheHighestPointOfAnyTriangleOverEachClosedCell) {
    const CityModel city = randomTriangles(400, 32.0F, 77).city;
    const GridSpec grid = square(32.0, 0.5);
    const Heightfield field = built(city, grid);
    std::vector<long double> expected(grid.cellCount(), -kInfinity);
    for (const CityTriangle& triangle : city.triangles) {
        const auto corners = exactCorners(city, triangle);
        for (int j = 0; j < grid.rows; ++j) {
            for (int i = 0; i < grid.columns; ++i) {
                const HighestPoint highest(
                    corners, {grid.xMin(i), grid.xMin(i + 1), grid.yMin(j), grid.yMin(j + 1)});
                long double& cell = expected[grid.index(i, j)];
                cell = std::max(cell, highest.value);
            }
        }
    }
    int touched = 0;
    for (std::size_t n = 0; n < grid.cellCount(); ++n) {
        ASSERT_EQ(isMissing(field.topMax[n]), expected[n] == -kInfinity);
        if (!isMissing(field.topMax[n])) {
            // 1e-12 m is what double leaves of the long double's digits.
            ASSERT_GE(field.topMax[n], expected[n] - 1e-12L);
            ASSERT_LE(std::nextafter(field.topMax[n], -kInfinity), expected[n] + 1e-12L);
            ++touched;
        }
    }
    EXPECT_GT(touched, 3000);
}

TEST(HeightfieldProperty, EqualsTheUpperEnvelopeAtEachCentre) {
    const CityModel city = randomTriangles(400, 32.0F, 78).city;
    const GridSpec grid = square(32.0, 0.5);
    const Heightfield field = built(city, grid);
    int covered = 0;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            long double expected = -kInfinity;
            for (std::size_t n = 0; n < city.triangles.size(); ++n) {
                if (std::abs(city.normal(n).z) > 0.0018F) {
                    expected = std::max(
                        expected, HighestPoint::heightAt(exactCorners(city, city.triangles[n]),
                                                         grid.xMin(i) + 0.25, grid.yMin(j) + 0.25));
                }
            }
            const float center = field.topCenter[grid.index(i, j)];
            ASSERT_EQ(isMissing(center), expected == -kInfinity);
            if (!isMissing(center)) {
                ASSERT_LE(steps(center, float(expected)), 1);
                ASSERT_LE(center, field.topMax[grid.index(i, j)]);
                ++covered;
            }
        }
    }
    EXPECT_GT(covered, 2000);
}

TEST(HeightfieldProperty, NoPointOfASurfaceLiesAboveItsCell) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int samples = 0;
    for (const double s : {1.0, 0.5, 0.1, 0.3}) {
        const CityModel city = randomTriangles(500, 60.0F, unsigned(100 * s)).city;
        const GridSpec grid = square(60.0, s);
        const Heightfield field = built(city, grid);
        for (int n = 0; n < 50000; ++n) {
            const CityTriangle& triangle = city.triangles[random() % city.triangles.size()];
            double u = unit(random);
            double v = unit(random);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            // Every tenth on an edge.
            v = n % 10 == 0 ? 0.0 : v;
            const glm::dvec3 a(city.vertices[triangle.vertex[0]]);
            const glm::dvec3 b(city.vertices[triangle.vertex[1]]);
            const glm::dvec3 c(city.vertices[triangle.vertex[2]]);
            const glm::dvec3 p = a + u * (b - a) + v * (c - a);
            const int i = grid.column(p.x);
            const int j = grid.row(p.y);
            if (grid.contains(i, j)) {
                ASSERT_LE(p.z, double(field.topMax[grid.index(i, j)]) + 1e-9);
                ++samples;
            }
        }
    }
    EXPECT_GT(samples, 190000);
}

TEST(HeightfieldProperty, AnAddedObjectNeverLowersACell) {
    CityModel city = town(1);
    // Ground below everything: no cell shows interpolated terrain, which objects may replace.
    append(city, TestCity().ground(0, 0, 64, 64, -3).city);
    const GridSpec grid = square(64.0, 0.5);
    Heightfield before = built(city, grid);
    int raised = 0;
    for (unsigned seed = 2; seed < 8; ++seed) {
        append(city, town(seed));
        const Heightfield after = built(city, grid);
        for (std::size_t n = 0; n < grid.cellCount(); ++n) {
            ASSERT_GE(after.topMax[n], before.topMax[n]);
            ASSERT_GE(after.topCenter[n], before.topCenter[n]);
            ASSERT_GE(after.ground[n], before.ground[n]);
            raised += after.topMax[n] > before.topMax[n];
        }
        before = after;
    }
    EXPECT_GT(raised, 1000);
}

TEST(HeightfieldProperty, TheOrderOfTrianglesAndOfTheirCornersDoesNotMatter) {
    CityModel city = town(11);
    const GridSpec grid = square(64.0, 0.3);
    const Heightfield field = built(city, grid);
    std::mt19937 random(5);
    for (int round = 0; round < 3; ++round) {
        std::shuffle(city.triangles.begin(), city.triangles.end(), random);
        for (CityTriangle& triangle : city.triangles) {
            std::rotate(triangle.vertex.begin(), triangle.vertex.begin() + random() % 3,
                        triangle.vertex.end());
        }
        const Heightfield shuffled = built(city, grid);
        expectSameBits(field, shuffled);
    }
}

TEST(HeightfieldProperty, MovingACityInItsCrsMovesItsHeightfieldAndNothingElse) {
    CityModel city = town(21);
    for (const double s : {2.0, 1.0, 0.5, 0.25, 0.1, 0.3}) {
        HeightfieldSettings settings;
        settings.cellSize = s;
        // Three kilometres hold a whole number of each of these cells.
        city.frame.origin = {0.0, 0.0, 0.0};
        const GridSpec near = gridFor(city, settings).value();
        const Heightfield atOrigin = built(city, near);
        city.frame.origin = {390000.0, s == 0.3 ? 5799000.0 : 5800000.0, 0.0};
        const GridSpec far = gridFor(city, settings).value();
        EXPECT_EQ(near, far);
        expectSameBits(atOrigin, built(city, far));
    }
}

TEST(HeightfieldProperty, TilesOfACityAgreeWhereTheyOverlap) {
    CityModel city = town(31);
    city.frame.origin = {389000.0, 5820000.0, 0.0};
    for (const double s : {1.0, 0.5, 0.1, 0.3, 0.7}) {
        HeightfieldSettings settings;
        settings.cellSize = s;
        const GridSpec whole = gridFor(city, settings).value();
        const Heightfield field = built(city, whole);
        for (const int first : {0, 7, 13}) {
            // A tile's origin as arithmetic on its own corner gives it, not as the whole's has it.
            GridSpec tile = whole;
            tile.x0 = std::round((whole.x0 + first * s + 389000.0) / s) * s - 389000.0;
            tile.y0 = whole.y0 + first * s;
            tile.columns = whole.columns - first - 4;
            tile.rows = whole.rows - first - 9;
            const Heightfield part = built(city, tile);
            for (int j = 0; j < tile.rows; ++j) {
                const auto row = [&](const std::vector<float>& layer) {
                    const auto begin =
                        layer.begin() + std::ptrdiff_t(whole.index(first, j + first));
                    return std::vector<float>(begin, begin + tile.columns);
                };
                const auto tileRow = [&](const std::vector<float>& layer) {
                    const auto begin = layer.begin() + std::ptrdiff_t(tile.index(0, j));
                    return std::vector<float>(begin, begin + tile.columns);
                };
                ASSERT_TRUE(sameBits(row(field.topMax), tileRow(part.topMax))) << s << " " << first;
                ASSERT_TRUE(sameBits(row(field.topCenter), tileRow(part.topCenter)));
                ASSERT_TRUE(sameBits(row(field.ground), tileRow(part.ground)));
            }
        }
    }
}

TEST(HeightfieldProperty, TriangulatingAPlanarFaceAnotherWayChangesAtMostTheLastBit) {
    std::mt19937 random(41);
    const auto eighths = [&](int from, int to) {
        return 0.125F * float(from + int(random() % unsigned(to - from)));
    };
    int differing = 0;
    int present = 0;
    for (int round = 0; round < 40; ++round) {
        const float dx = eighths(-32, 32);
        const float dy = eighths(-32, 32);
        // Six corners of a convex polygon on multiples of 1/8: their heights are exact, and
        // far from zero, near which a last bit is nothing.
        std::array<glm::vec3, 6> ring{};
        const std::array<glm::vec2, 6> corners{{{2 + eighths(0, 8), 1},
                                                {12, 0.5F},
                                                {15 + eighths(0, 8), 6},
                                                {14, 13},
                                                {7, 15.5F},
                                                {1, 9 + eighths(0, 8)}}};
        for (std::size_t n = 0; n < 6; ++n) {
            ring[n] = glm::vec3(corners[n], 200.0F + dx * corners[n].x + dy * corners[n].y);
        }
        std::array<TestCity, 2> cities;
        for (std::size_t way = 0; way < 2; ++way) {
            cities[way].object(CityObjectType::TinRelief);
            for (std::size_t n = 1; n < 5; ++n) {
                const std::size_t o = 3 * way;
                cities[way].triangle(ring[o], ring[(o + n) % 6], ring[(o + n + 1) % 6]);
            }
        }
        const GridSpec grid = square(16.5, round % 2 == 0 ? 0.5 : 0.3);
        const Heightfield a = built(cities[0].city, grid);
        const Heightfield b = built(cities[1].city, grid);
        for (std::size_t n = 0; n < grid.cellCount(); ++n) {
            ASSERT_LE(steps(a.topMax[n], b.topMax[n]), 1);
            ASSERT_LE(steps(a.topCenter[n], b.topCenter[n]), 1);
            ASSERT_LE(steps(a.ground[n], b.ground[n]), 1);
            present += isMissing(a.ground[n]) ? 0 : 1;
            differing += a.topMax[n] != b.topMax[n];
        }
    }
    EXPECT_GT(present, 10000);
    RecordProperty("cells that differ in the last bit", differing);
}

}  // namespace
}  // namespace reflet::test
