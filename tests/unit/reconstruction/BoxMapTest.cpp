// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/BoxMap.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A room with walls at u = −6 and 9, v = −4 and 5, floor at −1.5 and ceiling at 3 (or the sky),
/// turned about z; everything relative to its origin.
struct Room {
    double yaw = 0.0;
    glm::dvec3 low{-6.0, -4.0, -1.5}, high{9.0, 5.0, 3.0};
    bool roofed = true;

    [[nodiscard]] glm::dvec3 toRoom(const glm::dvec3& v) const {
        return {std::cos(yaw) * v.x + std::sin(yaw) * v.y,
                -std::sin(yaw) * v.x + std::cos(yaw) * v.y, v.z};
    }
    /// The parameter of the hit of a ray from inside; +infinity for sky.
    [[nodiscard]] double hit(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const glm::dvec3 o = toRoom(origin), d = toRoom(direction);
        double t = kInfinity;
        int axisHit = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (d[axis] == 0.0)
                continue;
            const double reach = ((d[axis] > 0.0 ? high : low)[axis] - o[axis]) / d[axis];
            if (reach < t) {
                t = reach;
                axisHit = axis;
            }
        }
        return !roofed && axisHit == 2 && d.z > 0.0 ? kInfinity : t;
    }
    /// A smooth colour of surface points; one colour for the sky.
    [[nodiscard]] glm::vec3 color(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const double t = hit(origin, direction);
        if (std::isinf(t))
            return {0.2f, 0.4f, 0.9f};
        const glm::dvec3 p = origin + t * direction;
        return {float(0.5 + 0.03 * p.x), float(0.5 + 0.03 * p.y), float(0.5 + 0.1 * p.z)};
    }
    [[nodiscard]] ReferenceEnvironmentMap see(const glm::dvec3& center, int resolution) const {
        ReferenceEnvironmentMap rem{"room", center, CubeMap<glm::vec3>(resolution),
                                    CubeMap<float>(resolution)};
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < resolution; ++row) {
                for (int column = 0; column < resolution; ++column) {
                    const glm::dvec3 d =
                        glm::normalize(texelDirection(resolution, face, column, row));
                    rem.radiance.at(face, column, row) = color(center, d);
                    rem.distance.at(face, column, row) = float(hit(center, d));
                }
            }
        }
        return rem;
    }
};

LocalEnvironmentMap boxMap(const RemSet& rems, const glm::dvec3& position, int resolution) {
    ReconstructionInput input;
    input.rems = rems;
    return reconstructBox(input, position, resolution);
}

TEST(BoxMap, FindsTheWallsOfATurnedRoomFromAnywhereInIt) {
    const Room room{kPi / 6.0};
    const glm::dvec3 center{1.0, 0.5, 0.25};
    const FittedBox box = fitBox(room.see(center, 64));
    EXPECT_NEAR(box.yaw, kPi / 6.0, 1e-12);
    const glm::dvec3 c = room.toRoom(center);
    EXPECT_NEAR(box.distance[0], 9.0 - c.x, 1e-4);
    EXPECT_NEAR(box.distance[1], 6.0 + c.x, 1e-4);
    EXPECT_NEAR(box.distance[2], 5.0 - c.y, 1e-4);
    EXPECT_NEAR(box.distance[3], 4.0 + c.y, 1e-4);
    EXPECT_NEAR(box.distance[4], 2.75, 1e-4);
    EXPECT_NEAR(box.distance[5], 1.75, 1e-4);
}

TEST(BoxMap, IsExactInsideABoxForEveryPosition) {
    const Room room{kPi / 6.0};
    const RemSet rems{room.see({1.0, 0.5, 0.25}, 128)};
    for (const glm::dvec3 position :
         {glm::dvec3(1.0, 0.5, 0.25), glm::dvec3(3.0, -0.5, -1.0), glm::dvec3(-2.0, 1.5, 2.0)}) {
        const LocalEnvironmentMap map = boxMap(rems, position, 32);
        EXPECT_EQ(map.center, position);
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i < 32 * 32; ++i) {
                const glm::dvec3 d = glm::normalize(texelDirection(32, face, i % 32, i / 32));
                const glm::vec3 truth = room.color(position, d);
                const glm::vec3 ours = map.radiance.at(face, i % 32, i / 32);
                // Bilinear lookups bend colours at the room's edges by a texel.
                ASSERT_LT(glm::distance(ours, truth), 0.02f) << face << ' ' << i;
                ASSERT_NEAR(double(map.distance.at(face, i % 32, i / 32)), room.hit(position, d),
                            2e-3);
            }
        }
    }
}

TEST(BoxMap, LeavesTheSkyAtInfinity) {
    Room room;
    room.roofed = false;
    const ReferenceEnvironmentMap rem = room.see({0.0, 0.0, 0.0}, 64);
    const FittedBox box = fitBox(rem);
    EXPECT_TRUE(std::isinf(box.distance[4]));
    EXPECT_NEAR(box.distance[5], 1.5, 1e-4);
    const LocalEnvironmentMap map = boxMap({rem}, {1.0, 1.0, 0.0}, 16);
    const Texel up = texelAt(16, {0.0, 0.0, 1.0});
    EXPECT_TRUE(std::isinf(map.distance.at(up.face, up.column, up.row)));
    EXPECT_EQ(map.radiance.at(up.face, up.column, up.row), glm::vec3(0.2f, 0.4f, 0.9f));
    // Above the walls' top as the probe sees it, the box's walls go on, and show sky there.
    const Texel high = texelAt(16, {1.0, 0.0, 0.9});
    EXPECT_TRUE(std::isinf(map.distance.at(high.face, high.column, high.row)));
}

TEST(BoxMap, IsNotMovedByAPostBeforeTheWall) {
    const Room room;
    ReferenceEnvironmentMap rem = room.see({0.0, 0.0, 0.0}, 64);
    const FittedBox before = fitBox(rem);
    for (int row = 0; row < 64; ++row) {
        for (int column = 24; column < 27; ++column) {
            rem.distance.at(0, column, row) = 2.0f;
            rem.distance.at(2, column, row) = kInfinity;  // a gap in another wall
        }
    }
    const FittedBox after = fitBox(rem);
    for (std::size_t side = 0; side < 6; ++side)
        EXPECT_NEAR(after.distance[side], before.distance[side], 1e-4) << side;
}

TEST(BoxMap, TakesAPointOutsideForOneJustInside) {
    FittedBox box;
    box.distance = {2.0, 2.0, 3.0, 3.0, kInfinity, 1.0};
    const auto ahead = leaveBox(box, {50.0, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    ASSERT_TRUE(ahead);
    EXPECT_NEAR(ahead->x, -2.0, 1e-12);
    const auto aside = leaveBox(box, {50.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    ASSERT_TRUE(aside);
    EXPECT_NEAR(aside->x, 2.0, 0.01);
    EXPECT_NEAR(aside->y, 3.0, 1e-12);
    EXPECT_FALSE(leaveBox(box, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}));
}

TEST(BoxMap, UsesTheNearestReferenceMapAndIsBlackWithoutAny) {
    const RemSet rems{test::plainMap("far", {20.0, 0.0, 0.0}, 8, glm::vec3(1.0f), 5.0f),
                      test::plainMap("near", {2.0, 0.0, 0.0}, 8, glm::vec3(0.25f), 5.0f)};
    const LocalEnvironmentMap map = boxMap(rems, {0.0, 0.0, 0.0}, 4);
    for (const glm::vec3& texel : map.radiance.texels())
        EXPECT_EQ(texel, glm::vec3(0.25f));
    const LocalEnvironmentMap none = boxMap({}, {0.0, 0.0, 0.0}, 4);
    EXPECT_EQ(none.radiance.at(0, 0, 0), glm::vec3(0.0f));
    EXPECT_EQ(none.uncovered.at(0, 0, 0), 1);
}

TEST(BoxMap, OfAReferenceMapThatSeesNothingIsThatMapAtInfinity) {
    const RemSet rems{test::plainMap("sky", {0.0, 0.0, 0.0}, 8, glm::vec3(0.5f), kInfinity)};
    const LocalEnvironmentMap map = boxMap(rems, {3.0, 4.0, 5.0}, 4);
    for (std::size_t i = 0; i < map.radiance.texels().size(); ++i) {
        EXPECT_EQ(map.radiance.texels()[i], glm::vec3(0.5f));
        EXPECT_TRUE(std::isinf(map.distance.texels()[i]));
    }
}

}  // namespace
}  // namespace reflet
