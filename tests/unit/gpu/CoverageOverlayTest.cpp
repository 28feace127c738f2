// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn of a coverage over the city.
#include "core/gpu/overlay/CoverageOverlay.h"
#include "core/gpu/overlay/OverlayShapes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

/// CIE lightness of display values.
double lightness(const glm::vec3& color) {
    const auto linear = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(color.x) + 0.7152 * linear(color.y) + 0.0722 * linear(color.z);
    return 116.0 * std::cbrt(y) - 16.0;
}

std::size_t count(const OverlayShapes& shapes, OverlayPattern pattern) {
    return std::size_t(std::count_if(
        shapes.triangles.begin(), shapes.triangles.end(),
        [&](const OverlayVertex& vertex) { return vertex.pattern.z == float(pattern); }));
}

OverlayShapes shapesOf(const CoverageOverlay& coverage) {
    Overlays overlays;
    overlays.coverage = std::make_shared<const CoverageOverlay>(coverage);
    // From the south, 10 m up, to the north.
    const CityView view = cityView({{0.0, -20.0, 10.0}, {0.0, 20.0, 0.0}, 0.9}, 800, 600);
    return overlayShapes(overlays, view, nullptr);
}

constexpr std::size_t kQuad = 6;  // vertices

TEST(CoverageOverlay, TheScaleGrowsLighterEvenlySoThatItReadsTheSameInGrey) {
    double before = lightness(coverageColor(0.0));
    double least = 100.0, most = 0.0;
    for (int i = 1; i <= 20; ++i) {
        const double now = lightness(coverageColor(0.05 * i));
        least = std::min(least, now - before);
        most = std::max(most, now - before);
        before = now;
    }
    EXPECT_GT(least, 2.0);
    EXPECT_LT(most, 6.0);
    EXPECT_EQ(coverageColor(-1.0), coverageColor(0.0));
    EXPECT_EQ(coverageColor(2.0), coverageColor(1.0));
}

TEST(CoverageOverlay, APoorStretchIsHatchedAndAGoodOneIsNot) {
    const std::vector<glm::dvec3> line{{-5.0, 10.0, 0.0}, {0.0, 10.0, 0.0}, {5.0, 10.0, 0.0}};
    const OverlayShapes poor = shapesOf({{{line, 0.49}}, {}, {}});
    EXPECT_EQ(count(poor, OverlayPattern::HatchedBand), 2 * kQuad);
    EXPECT_EQ(count(poor, OverlayPattern::Band), 0U);
    const OverlayShapes good = shapesOf({{{line, 0.5}}, {}, {}});
    EXPECT_EQ(count(good, OverlayPattern::Band), 2 * kQuad);
    const glm::vec4& color = good.triangles.front().color;
    EXPECT_EQ(glm::vec3(color), coverageColor(0.5));
}

TEST(CoverageOverlay, AFacadeIsDrawnBeforeItsWallWhereItFacesTheEye) {
    const CoveredSpot facing{{0.0, 15.0, 3.0}, {0.0F, -1.0F, 0.0F}, 1.0, 0.8};
    CoveredSpot away = facing;
    away.normal = {0.0F, 1.0F, 0.0F};
    CoveredSpot hollow = facing;
    hollow.coverage = 0.0;
    const OverlayShapes shapes = shapesOf({{}, {facing, away, hollow}, {}});
    EXPECT_EQ(count(shapes, OverlayPattern::Spot), kQuad);
    EXPECT_EQ(count(shapes, OverlayPattern::HollowSpot), kQuad);
    for (const OverlayVertex& vertex : shapes.triangles) {
        const glm::dvec3 at = glm::dvec3(vertex.fromEye) + glm::dvec3(0.0, -20.0, 10.0);
        EXPECT_LT(at.y, 15.0) << "before the wall";
        EXPECT_NEAR(at.y, 15.0, 0.2);
        EXPECT_LE(std::abs(at.x), 1.0);
        EXPECT_LE(std::abs(at.z - 3.0), 1.0);
    }
}

TEST(CoverageOverlay, ASuggestedProbeFacesTheEyeAtItsPlace) {
    const OverlayShapes shapes = shapesOf({{}, {}, {{"s001", {0.0, 10.0, 1.75}, 1, 0.04}}});
    ASSERT_EQ(count(shapes, OverlayPattern::Ghost), kQuad);
    glm::dvec3 sum(0.0);
    for (const OverlayVertex& vertex : shapes.triangles)
        sum += glm::dvec3(vertex.fromEye) / double(kQuad);
    EXPECT_LT(glm::distance(sum + glm::dvec3(0.0, -20.0, 10.0), glm::dvec3(0.0, 10.0, 1.75)), 0.5);
}

}  // namespace
}  // namespace reflet
