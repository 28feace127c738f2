// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/PolygonTriangulation.h"
#include "importers/extrusion/Lengths.h"
#include "importers/extrusion/Solid.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <utility>

namespace reflet::extrusion {
namespace {

const PlanPolygon kBox{{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}}};
const PlanPolygon kTurnedBox{{{{0, 0}, {16, 12}, {10, 20}, {-6, 8}}}};  // the same by 3-4-5
const PlanPolygon kCourtyard{
    {{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{5, 4}, {5, 7}, {15, 7}, {15, 4}}}};
const PlanPolygon kL{{{{0, 0}, {20, 0}, {20, 5}, {8, 5}, {8, 12}, {0, 12}}}};
const PlanPolygon kE{{{{0, 0},
                       {12, 0},
                       {12, 4},
                       {4, 4},
                       {4, 8},
                       {12, 8},
                       {12, 12},
                       {4, 12},
                       {4, 16},
                       {12, 16},
                       {12, 20},
                       {0, 20}}}};
const Levels kLevels{2.0, 6.0, 9.0};

/// Edges that are not that of one other face, the other way round.
std::size_t openEdges(const Solid& solid) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Face& face : solid.faces) {
        for (const auto& ring : face.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                ++edges[{ring[i], ring[(i + 1) % ring.size()]}];
        }
    }
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        const auto other = edges.find({edge.second, edge.first});
        open += count != 1 || other == edges.end() || other->second != 1 ? 1 : 0;
    }
    return open;
}

/// By the divergence theorem: positive only when faces look outward.
double volume(const Solid& solid) {
    double sum = 0.0;
    for (const Face& face : solid.faces) {
        std::vector<PolygonRing> rings;
        for (const auto& ring : face.rings) {
            PolygonRing& points = rings.emplace_back();
            for (const std::uint32_t point : ring)
                points.push_back(solid.points[point]);
        }
        const TriangulatedPolygon t = triangulatePolygon(rings);
        EXPECT_EQ(t.problem, "");
        EXPECT_FALSE(t.repaired);
        EXPECT_LT(t.planeDeviation, 1e-6);
        for (const auto& [a, b, c] : t.triangles)
            sum += glm::dot(t.points[a], glm::cross(t.points[b], t.points[c])) / 6.0;
    }
    return sum;
}

double volumeOf(const PlanPolygon& polygon, const Roof& roof, RoofShape made) {
    const Extruded result = extruded(polygon, kLevels, roof);
    EXPECT_EQ(result.made, made);
    EXPECT_EQ(openEdges(result.solid), 0U);
    for (const glm::dvec3& p : result.solid.points) {
        EXPECT_GE(p.z, kLevels.bottom);
        EXPECT_LE(p.z, kLevels.top);
    }
    return volume(result.solid);
}

TEST(Solid, OfAFlatRoofHasAreaTimesHeight) {
    EXPECT_NEAR(volumeOf(kBox, {}, RoofShape::Flat), 200.0 * 7.0, 1e-9);
    EXPECT_NEAR(volumeOf(kTurnedBox, {}, RoofShape::Flat), 200.0 * 7.0, 1e-9);
    EXPECT_NEAR(volumeOf(kCourtyard, {}, RoofShape::Flat), 170.0 * 7.0, 1e-9);
    EXPECT_NEAR(volumeOf(kL, {}, RoofShape::Flat), 156.0 * 7.0, 1e-9);
}

TEST(Solid, OfAGableHasHalfOfItsRoofsBox) {
    EXPECT_NEAR(volumeOf(kBox, {RoofShape::Gabled, false, {}}, RoofShape::Gabled), 800.0 + 300.0,
                1e-9);
    EXPECT_NEAR(volumeOf(kTurnedBox, {RoofShape::Gabled, false, {}}, RoofShape::Gabled),
                800.0 + 300.0, 1e-6);
    EXPECT_NEAR(volumeOf(kBox, {RoofShape::Gabled, true, {}}, RoofShape::Gabled), 800.0 + 300.0,
                1e-9);
}

TEST(Solid, OfAGableHasItsRidgeAlongTheLongerSideUnlessAcross) {
    const auto ridge = [](bool across) {
        const Extruded result = extruded(kBox, kLevels, {RoofShape::Gabled, across, {}});
        std::vector<glm::dvec3> top;
        for (const glm::dvec3& p : result.solid.points) {
            if (p.z == kLevels.top)
                top.push_back(p);
        }
        EXPECT_EQ(top.size(), 2U);
        return top.at(0) - top.at(1);
    };
    EXPECT_NEAR(std::abs(ridge(false).x), 20.0, 1e-9);
    EXPECT_NEAR(ridge(false).y, 0.0, 1e-9);
    EXPECT_NEAR(std::abs(ridge(true).y), 10.0, 1e-9);
}

TEST(Solid, OfAGableStaysClosedWhereTheRidgeMeetsCourtsAndWings) {
    // The court takes from the roof what lies over it: 10 m by 1 m on one side of the ridge at
    // y = 5 and by 2 m on the other, under the roof 3 * (1 - |y - 5| / 5).
    const double court = 10.0 * (3.0 * (1.0 - 0.1) * 1.0 + 3.0 * (1.0 - 0.2) * 2.0);
    EXPECT_NEAR(volumeOf(kCourtyard, {RoofShape::Gabled, false, {}}, RoofShape::Gabled),
                170.0 * 4.0 + 300.0 - court, 1e-6);
    EXPECT_GT(volumeOf(kL, {RoofShape::Gabled, false, {}}, RoofShape::Gabled), 156.0 * 4.0);
    EXPECT_GT(volumeOf(kE, {RoofShape::Gabled, false, {}}, RoofShape::Gabled), 0.0);
    EXPECT_GT(volumeOf(kE, {RoofShape::Gabled, true, {}}, RoofShape::Gabled), 0.0);
}

TEST(Solid, OfHippedAndPyramidalRoofsHasTheirVolumes) {
    // A hip's inset is half the width: 3 * 10 * (2 * 20 + 10) / 6.
    EXPECT_NEAR(volumeOf(kBox, {RoofShape::Hipped, false, {}}, RoofShape::Hipped), 800.0 + 250.0,
                1e-9);
    EXPECT_NEAR(volumeOf(kTurnedBox, {RoofShape::Hipped, false, {}}, RoofShape::Hipped),
                800.0 + 250.0, 1e-9);
    EXPECT_NEAR(volumeOf(kBox, {RoofShape::Pyramidal, false, {}}, RoofShape::Pyramidal),
                800.0 + 200.0, 1e-9);
    const PlanPolygon square{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}};
    EXPECT_NEAR(volumeOf(square, {RoofShape::Hipped, false, {}}, RoofShape::Hipped), 400.0 + 100.0,
                1e-9);
}

TEST(Solid, OfAShapeThatTheFootprintDoesNotAllowGetsAGable) {
    EXPECT_GT(volumeOf(kL, {RoofShape::Hipped, false, {}}, RoofShape::Gabled), 0.0);
    EXPECT_GT(volumeOf(kCourtyard, {RoofShape::Pyramidal, false, {}}, RoofShape::Gabled), 0.0);
}

TEST(Solid, OfASkillionSlopesWhereItIsTold) {
    constexpr double kEast = std::numbers::pi / 2.0;
    const Roof east{RoofShape::Skillion, false, kEast};
    EXPECT_NEAR(volumeOf(kBox, east, RoofShape::Skillion), 800.0 + 300.0, 1e-9);
    const Solid solid = extruded(kBox, kLevels, east).solid;
    for (const glm::dvec3& p : solid.points) {
        if (p.z > kLevels.bottom) {
            EXPECT_NEAR(p.z, p.x == 0.0 ? kLevels.top : kLevels.eaves, 1e-9);
        }
    }
    EXPECT_GT(volumeOf(kCourtyard, {RoofShape::Skillion, false, {}}, RoofShape::Skillion), 0.0);
}

TEST(Solid, OfARoofThatMeetsTheGroundIsClosed) {
    const Levels levels{0.0, 0.0, 5.0};
    for (const RoofShape shape :
         {RoofShape::Gabled, RoofShape::Hipped, RoofShape::Pyramidal, RoofShape::Skillion}) {
        const Solid solid = extruded(kBox, levels, {shape, false, {}}).solid;
        EXPECT_EQ(openEdges(solid), 0U) << int(shape);
        EXPECT_GT(volume(solid), 0.0) << int(shape);
    }
}

TEST(Lengths, AreReadAsPeopleWriteThem) {
    EXPECT_EQ(parseLength("12"), 12.0);
    EXPECT_EQ(parseLength(" 12.5 m"), 12.5);
    EXPECT_EQ(parseLength("12,5"), 12.5);
    EXPECT_EQ(parseLength("~9"), 9.0);
    EXPECT_NEAR(parseLength("40 ft").value(), 12.192, 1e-9);
    EXPECT_NEAR(parseLength("7'4\"").value(), 7 * 0.3048 + 4 * 0.0254, 1e-9);
    EXPECT_NEAR(parseLength("40'").value(), 12.192, 1e-9);
    EXPECT_NEAR(parseLength("100", 0.3048).value(), 30.48, 1e-9);
    EXPECT_EQ(parseLength("100 m", 0.3048), 100.0);
    for (const char* text : {"", "high", "3 storeys", "nan", "inf", "1e9", "7'x", "--3", "5;6"})
        EXPECT_EQ(parseLength(text), std::nullopt) << text;
    EXPECT_EQ(parseStoreys("2.5"), 2.5);
    for (const char* text : {"", "two", "-1", "1000", "2 floors"})
        EXPECT_EQ(parseStoreys(text), std::nullopt) << text;
}

}  // namespace
}  // namespace reflet::extrusion
