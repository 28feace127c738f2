// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/PolygonTriangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace reflet {
namespace {

using Flat = std::vector<std::vector<glm::dvec2>>;

const std::vector<glm::dvec2> kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

std::vector<PolygonRing> inSpace(const Flat& flat, const glm::dvec3& origin = glm::dvec3(0.0),
                                 const glm::dvec3& u = {1, 0, 0}, const glm::dvec3& v = {0, 1, 0}) {
    std::vector<PolygonRing> rings;
    for (const auto& ring : flat) {
        rings.emplace_back();
        for (const auto& p : ring)
            rings.back().push_back(origin + p.x * u + p.y * v);
    }
    return rings;
}

TriangulatedPolygon triangulated(const Flat& flat) {
    return triangulatePolygon(inSpace(flat));
}

/// Even-odd area of rings in the plane, without any triangulation: between two neighbouring
/// heights of corners and crossings the inside is a row of trapezoids.
double evenOddArea(const Flat& rings) {
    struct Edge {
        glm::dvec2 a, b;
        [[nodiscard]] double xAt(double y) const {
            return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
    };
    std::vector<Edge> edges;
    std::vector<double> levels;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            glm::dvec2 a = ring[i];
            glm::dvec2 b = ring[(i + 1) % ring.size()];
            levels.push_back(a.y);
            if (a.y > b.y)
                std::swap(a, b);
            if (a.y < b.y)
                edges.push_back({a, b});
        }
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const glm::dvec2 r = edges[i].b - edges[i].a;
            const glm::dvec2 s = edges[j].b - edges[j].a;
            const glm::dvec2 q = edges[j].a - edges[i].a;
            const double det = r.x * s.y - r.y * s.x;
            if (det == 0.0)
                continue;
            const double t = (q.x * s.y - q.y * s.x) / det;
            if (t >= 0.0 && t <= 1.0)
                levels.push_back(edges[i].a.y + t * r.y);
        }
    std::sort(levels.begin(), levels.end());
    double area = 0.0;
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
        const double y = 0.5 * (levels[k] + levels[k + 1]);
        std::vector<double> cuts;
        for (const Edge& edge : edges)
            if (edge.a.y < y && y < edge.b.y)
                cuts.push_back(edge.xAt(y));
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t c = 0; c + 1 < cuts.size(); c += 2)
            area += (levels[k + 1] - levels[k]) * (cuts[c + 1] - cuts[c]);
    }
    return area;
}

glm::dvec3 vectorArea(const TriangulatedPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (const auto& [a, b, c] : polygon.triangles)
        sum += 0.5 * glm::cross(polygon.points[b] - polygon.points[a],
                                polygon.points[c] - polygon.points[a]);
    return sum;
}

TEST(PolygonTriangulation, CutsAWindowOutOfAWall) {
    const auto out = triangulated({kSquare, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}});
    EXPECT_DOUBLE_EQ(out.area, 96.0);
    EXPECT_EQ(out.triangles.size(), 8U);
    EXPECT_FALSE(out.repaired);
    EXPECT_EQ(out.points.size(), 8U);
}

TEST(PolygonTriangulation, CutsAHoleThatSharesPartOfTheOuterEdge) {
    EXPECT_DOUBLE_EQ(triangulated({kSquare, {{0, 2}, {0, 4}, {4, 4}, {4, 2}}}).area, 92.0);
}

TEST(PolygonTriangulation, FillsBothWingsOfABowTie) {
    const auto out = triangulated({{{0, 0}, {10, 0}, {0, 10}, {10, 10}}});
    EXPECT_DOUBLE_EQ(out.area, 50.0);
    EXPECT_TRUE(out.repaired);
    ASSERT_EQ(out.points.size(), 5U);
    EXPECT_EQ(out.points[4], glm::dvec3(5, 5, 0));
    EXPECT_EQ(out.inputPoints, 4U);
}

TEST(PolygonTriangulation, CountsAHoleThatCrossesTheOuterRingByEvenOdd) {
    const auto out = triangulated({kSquare, {{5, 5}, {15, 5}, {15, 7}, {5, 7}}});
    EXPECT_NEAR(out.area, 100.0, 1e-12);
    EXPECT_TRUE(out.repaired);
}

TEST(PolygonTriangulation, ReportsTwoIdenticalRingsThatCancelOut) {
    const auto out = triangulated({kSquare, kSquare});
    EXPECT_EQ(out.area, 0.0);
    EXPECT_TRUE(out.triangles.empty());
    EXPECT_EQ(out.problem, "its rings cancel each other out");
}

TEST(PolygonTriangulation, IgnoresASpike) {
    const auto out = triangulated({{{0, 0}, {10, 0}, {10, 10}, {10, 15}, {10, 10}, {0, 10}}});
    EXPECT_DOUBLE_EQ(out.area, 100.0);
}

TEST(PolygonTriangulation, DropsRepeatedAndClosingPoints) {
    const auto out = triangulated({{{0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}});
    EXPECT_DOUBLE_EQ(out.area, 100.0);
    EXPECT_TRUE(out.repaired);
    EXPECT_EQ(out.inputPoints, 6U);
    EXPECT_EQ(out.triangles.size(), 2U);
}

TEST(PolygonTriangulation, RefusesCollinearPoints) {
    EXPECT_EQ(triangulated({{{0, 0}, {5, 0}, {10, 0}}}).problem, "all points lie on a line");
    EXPECT_EQ(triangulated({{{0, 0}, {5, 0}, {7, 0}, {10, 0}}}).problem,
              "all points lie on a line");
}

TEST(PolygonTriangulation, RefusesTooFewPointsNoRingsAndCoordinatesThatAreNotFinite) {
    EXPECT_EQ(triangulated({}).problem, "no ring");
    EXPECT_EQ(triangulated({{}}).problem, "fewer than three distinct points");
    EXPECT_EQ(triangulated({{{0, 0}, {1, 1}, {0, 0}}}).problem, "fewer than three distinct points");
    EXPECT_EQ(triangulated({{{0, 0}, {1, 0}, {std::nan(""), 3}}}).problem,
              "a coordinate is not a finite number");
    EXPECT_TRUE(triangulated({{{0, 0}, {1, 0}, {HUGE_VAL, 3}, {4, 4}}}).triangles.empty());
}

TEST(PolygonTriangulation, DropsAHoleWithoutAreaAndSaysSo) {
    const auto out = triangulated({kSquare, {{2, 2}, {4, 4}}});
    EXPECT_DOUBLE_EQ(out.area, 100.0);
    EXPECT_TRUE(out.repaired);
}

TEST(PolygonTriangulation, AClosingPointAloneIsNoRepair) {
    auto closed = kSquare;
    closed.push_back(kSquare.front());
    EXPECT_FALSE(triangulated({closed}).repaired);
}

TEST(PolygonTriangulation, ADoublyWoundStarIsHollowInTheMiddle) {
    // A pentagram turns left at every corner, like a convex ring, but goes round twice.
    std::vector<glm::dvec2> star;
    for (int i = 0; i < 5; ++i)
        star.push_back({10 * std::cos(i * 0.8 * kPi), 10 * std::sin(i * 0.8 * kPi)});
    const auto out = triangulated({star});
    EXPECT_NEAR(out.area, evenOddArea({star}), 1e-9 * out.area);
    EXPECT_EQ(out.points.size(), 10U);
}

TEST(PolygonTriangulation, AgreesWithAnIndependentEvenOddAreaOnRandomRings) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
    int crossed = 0;
    for (int round = 0; round < 250; ++round) {
        Flat rings(1 + round % 3);
        for (auto& ring : rings)
            for (int i = 0; i < 3 + round % 17; ++i)
                ring.push_back({coordinate(random), coordinate(random)});
        const auto out = triangulated(rings);
        const double expected = evenOddArea(rings);
        ASSERT_EQ(out.problem, "") << round;
        EXPECT_NEAR(out.area, expected, 1e-9 * expected) << round;
        crossed += out.points.size() > out.inputPoints;
    }
    EXPECT_GT(crossed, 150);
}

TEST(PolygonTriangulation, AgreesWithTheEvenOddAreaOnRingsWithSharedCornersAndEdges) {
    // Few integer coordinates: corners repeat, edges overlap, rings touch and degenerate.
    std::mt19937 random(11);
    std::uniform_int_distribution<int> coordinate(0, 4);
    int filled = 0;
    for (int round = 0; round < 1200; ++round) {
        Flat rings(1 + round % 3);
        for (auto& ring : rings)
            for (int i = 0; i < 4 + round % 6; ++i)
                ring.push_back({coordinate(random), coordinate(random)});
        // A first ring that collapses to less than three points is refused, not triangulated.
        const auto out = triangulated(rings);
        if (out.problem == "fewer than three distinct points")
            continue;
        const double expected = evenOddArea(rings);
        EXPECT_NEAR(out.area, expected, 1e-9 * std::max(expected, 1.0)) << round << out.problem;
        filled += !out.triangles.empty();
    }
    EXPECT_GT(filled, 800);
}

TEST(PolygonTriangulation, ConvexRingsNeedNoConstrainedTriangulationAndKeepTheirArea) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> radius(0.5, 50.0);
    for (int corners = 3; corners <= 12; ++corners) {
        const double r = radius(random);
        std::vector<glm::dvec2> ring;
        for (int i = 0; i < corners; ++i)
            ring.push_back(
                {r * std::cos(2 * kPi * i / corners), r * std::sin(2 * kPi * i / corners)});
        const auto out = triangulated({ring});
        EXPECT_NEAR(out.area, 0.5 * corners * r * r * std::sin(2 * kPi / corners), 1e-12 * r * r);
        EXPECT_EQ(out.triangles.size(), std::size_t(corners - 2));
        EXPECT_NEAR(vectorArea(out).z, out.area, 1e-12 * r * r);
    }
}

using Whole = std::array<std::int64_t, 2>;

std::int64_t turn(const Whole& a, const Whole& b, const Whole& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The convex hull of points on even coordinates, counter-clockwise, with the middle of each second
/// edge between its ends (Andrew 1979).
std::vector<Whole> roundRing(std::mt19937& random, int points) {
    std::vector<Whole> all;
    for (int n = 0; n < points; ++n)
        all.push_back({2 * std::int64_t(random() % 500), 2 * std::int64_t(random() % 500)});
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<Whole> hull;
    for (const int way : {0, 1}) {
        const std::size_t begin = hull.size();
        for (const Whole& p : all) {
            while (hull.size() > begin + 1 && turn(hull[hull.size() - 2], hull.back(), p) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        if (way == 0)
            std::reverse(all.begin(), all.end());
    }
    std::vector<Whole> ring;
    for (std::size_t n = 0; n < hull.size(); ++n) {
        const Whole& next = hull[(n + 1) % hull.size()];
        ring.push_back(hull[n]);
        if (n % 2 == 0)
            ring.push_back({(hull[n][0] + next[0]) / 2, (hull[n][1] + next[1]) / 2});
    }
    return ring;
}

/// Positive where p lies in the circle through a, b and c, which are counter-clockwise.
std::int64_t inCircle(const Whole& a, const Whole& b, const Whole& c, const Whole& p) {
    const auto from = [&](const Whole& q) {
        const std::int64_t x = q[0] - p[0], y = q[1] - p[1];
        return std::array{x, y, x * x + y * y};
    };
    const auto u = from(a), v = from(b), w = from(c);
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
}

TEST(PolygonTriangulation, ConvexRingsWithPointsBetweenTheirCornersAreDelaunay) {
    std::mt19937 random(13);
    std::size_t largest = 0;
    for (int round = 0; round < 400; ++round) {
        const std::vector<Whole> ring = roundRing(random, 3 + round % 60);
        if (ring.size() < 4)
            continue;
        largest = std::max(largest, ring.size());
        std::vector<glm::dvec2> flat;
        std::int64_t twice = 0;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            flat.emplace_back(double(ring[n][0]), double(ring[n][1]));
            twice += turn(ring[0], ring[n], ring[(n + 1) % ring.size()]);
        }
        const auto out = triangulated({flat});
        ASSERT_EQ(out.triangles.size(), ring.size() - 2) << out.problem;
        EXPECT_FALSE(out.repaired);
        std::int64_t covered = 0;
        for (const auto& [a, b, c] : out.triangles) {
            const std::int64_t area = turn(ring[a], ring[b], ring[c]);
            ASSERT_GT(area, 0);
            covered += area;
            for (const Whole& p : ring)
                ASSERT_LE(inCircle(ring[a], ring[b], ring[c], p), 0) << round;
        }
        EXPECT_EQ(covered, twice);
    }
    EXPECT_GT(largest, 16U);
}

TEST(PolygonTriangulation, ABlockOfFlatsWithPointsInItsWallsIsSplitTheSameWayWhereverItStands) {
    // A rectangle with the middles of its sides: all its circles pass through several points.
    const Flat block{{{0, 0}, {6, 0}, {12, 0}, {12, 5}, {12, 10}, {6, 10}, {0, 10}, {0, 5}}};
    const auto near = triangulated(block);
    ASSERT_EQ(near.triangles.size(), 6U);
    EXPECT_DOUBLE_EQ(near.area, 120.0);
    const auto far = triangulatePolygon(inSpace(block, {391234.567, 5820123.321, 34.5}));
    EXPECT_EQ(far.triangles, near.triangles);
}

TEST(PolygonTriangulation, ASpikeAlongAnEdgeIsNotTakenForAStraightCorner) {
    const Flat spike{{{0, 0}, {12, 0}, {6, 0}, {6, 8}, {0, 8}}};
    const auto out = triangulated(spike);
    EXPECT_NEAR(out.area, 48.0, 1e-12);
    const Flat around{{{0, 0}, {6, 0}, {12, 0}, {9, 0}, {12, 9}, {0, 9}}};
    EXPECT_NEAR(triangulated(around).area, evenOddArea(around), 1e-12);
}

TEST(PolygonTriangulation, AValueThatIsUsedAgainKeepsNothingOfTheLastPolygon) {
    TriangulatedPolygon used;
    const Flat bowTie{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}};
    const Flat holed{kSquare, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}};
    const Flat line{{{0, 0}, {5, 0}, {9, 0}}};
    for (const Flat& flat : {bowTie, line, holed, Flat{}, Flat{kSquare}}) {
        const auto rings = inSpace(flat);
        triangulatePolygon(rings, used);
        const TriangulatedPolygon fresh = triangulatePolygon(rings);
        EXPECT_EQ(used.points, fresh.points);
        EXPECT_EQ(used.triangles, fresh.triangles);
        EXPECT_EQ(used.problem, fresh.problem);
        EXPECT_EQ(used.repaired, fresh.repaired);
        EXPECT_EQ(used.area, fresh.area);
        EXPECT_EQ(used.planeDeviation, fresh.planeDeviation);
        EXPECT_EQ(used.inputPoints, fresh.inputPoints);
    }
}

TEST(PolygonTriangulation, TiltedAndVerticalPlanesKeepAreaPlaneAndOrientation) {
    const Flat flat{{{0, 0}, {10, 0}, {10, 10}, {5, 3}, {0, 10}}, {{4, 1}, {4, 2}, {6, 2}, {6, 1}}};
    const double expected = evenOddArea(flat);
    std::mt19937 random(5);
    std::normal_distribution<double> gauss;
    for (int round = 0; round < 200; ++round) {
        glm::dvec3 u = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
        if (round < 3)
            u = {round == 0, round == 1, round == 2};
        const glm::dvec3 help(u.y + 0.3, u.z - 0.2, u.x + 0.1);
        const glm::dvec3 v = glm::normalize(glm::cross(u, help));
        const auto out = triangulatePolygon(inSpace(flat, {3, -7, 40}, u, v));
        ASSERT_EQ(out.problem, "");
        EXPECT_NEAR(out.area, expected, 1e-9 * expected);
        EXPECT_LT(out.planeDeviation, 1e-12);
        EXPECT_NEAR(glm::dot(vectorArea(out), glm::cross(u, v)), expected, 1e-9 * expected);
    }
}

TEST(PolygonTriangulation, FindsThePlaneOfATiltedBowTieThatHasNoNormal) {
    const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0, 0, 1)));
    const auto out =
        triangulatePolygon(inSpace({{{0, 0}, {10, 0}, {0, 10}, {10, 10}}}, {1, 2, 3}, u, v));
    EXPECT_NEAR(out.area, 50.0, 1e-9);
    EXPECT_LT(out.planeDeviation, 1e-9);
}

TEST(PolygonTriangulation, AClockwiseRingFacesDown) {
    auto ring = kSquare;
    std::reverse(ring.begin(), ring.end());
    EXPECT_NEAR(vectorArea(triangulated({ring})).z, -100.0, 1e-12);
    ring.insert(ring.begin() + 1, glm::dvec2(5, 9));  // concave: through the full recipe
    const auto out = triangulated({ring});
    EXPECT_NEAR(vectorArea(out).z, -out.area, 1e-12);
}

TEST(PolygonTriangulation, GivesInputPointsBackBitByBitFarFromTheOrigin) {
    const glm::dvec3 far(389123.456789, 5820123.789123, 34.56);
    const auto near = inSpace({kSquare, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}});
    const auto rings = inSpace({kSquare, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}}, far);
    const auto out = triangulatePolygon(rings);
    std::size_t i = 0;
    for (const auto& ring : rings)
        for (const auto& p : ring)
            EXPECT_EQ(out.points[i++], p);
    EXPECT_EQ(out.triangles, triangulatePolygon(near).triangles);
    EXPECT_NEAR(out.area, 96.0, 1e-7);
}

TEST(PolygonTriangulation, ReportsHowFarAPointLeavesThePlane) {
    // One corner of the square lifted by 1: the plane of the Newell normal (-5, -5, 100) leaves
    // the corners by a quarter of that each, along the normal.
    const std::vector<PolygonRing> rings{{{0, 0, 0}, {10, 0, 0}, {10, 10, 1}, {0, 10, 0}}};
    const auto out = triangulatePolygon(rings);
    const glm::dvec3 n = glm::normalize(glm::dvec3(-5, -5, 100));
    const glm::dvec3 center(5, 5, 0.25);
    double expected = 0.0;
    for (const auto& p : rings[0])
        expected = std::max(expected, std::abs(glm::dot(p - center, n)));
    EXPECT_NEAR(out.planeDeviation, expected, 1e-12);
    EXPECT_EQ(out.triangles.size(), 2U);
    EXPECT_FALSE(out.repaired);
}

TEST(PolygonTriangulation, RefusesARingThatCrossesItselfTooOftenInsteadOfFillingTheMemory) {
    // A zigzag between two lines and one across it: n²/4 crossings.
    std::vector<glm::dvec2> ring;
    const int n = 300;
    for (int i = 0; i < n; ++i)
        ring.push_back({i + 0.01 * (i % 7), i % 2 == 0 ? 0.0 : double(n)});
    for (int i = 0; i < n; ++i)
        ring.push_back({i % 2 == 0 ? -1.0 : n + 1.0, double(n - i) - 0.5});
    const auto out = triangulated({ring});
    EXPECT_EQ(out.problem, "its edges cross each other too often");
    EXPECT_EQ(out.points.size(), out.inputPoints);
}

TEST(PolygonTriangulation, TriangulatesALongRingWithoutCrossings) {
    std::vector<glm::dvec2> comb;
    const int teeth = 5000;
    for (int i = 0; i < teeth; ++i) {
        comb.push_back({2.0 * i, 10.0});
        comb.push_back({2.0 * i + 1.0, 1.0});
    }
    comb.push_back({2.0 * teeth, 10.0});
    comb.push_back({2.0 * teeth, 0.0});
    comb.push_back({0.0, 0.0});
    const auto out = triangulated({comb});
    EXPECT_EQ(out.triangles.size(), comb.size() - 2);
    EXPECT_NEAR(out.area,
                evenOddArea({{{0, 0}, {2.0 * teeth, 0}, {2.0 * teeth, 10}, {0, 10}}}) - teeth * 9.0,
                1e-6);
}

}  // namespace
}  // namespace reflet
