// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/BoxesSeen.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace reflet {
namespace {

constexpr float kSky = std::numeric_limits<float>::infinity();

/// The map at the centre of a room: its walls end every ray, but for a hole in the east wall.
ReferenceEnvironmentMap room(int resolution, const glm::dvec3& center) {
    ReferenceEnvironmentMap map;
    map.center = center;
    map.distance = CubeMap<float>(resolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                const glm::dvec3 d = texelDirection(resolution, face, column, row);
                const bool hole = face == 0 && std::abs(d.y) < 0.25 && std::abs(d.z) < 0.25;
                map.distance.at(face, column, row) = hole ? kSky : float(10.0 * glm::length(d));
            }
        }
    }
    return map;
}

Box boxAt(const glm::dvec3& center, const glm::dvec3& half) {
    Box box;
    box.add(center - half);
    box.add(center + half);
    return box;
}

/// Every texel with points along its ray, a centimetre apart.
bool seenByWalking(const ReferenceEnvironmentMap& map, const Box& box) {
    const int n = map.distance.resolution();
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const glm::dvec3 d = glm::normalize(texelDirection(n, face, column, row));
                const double end = std::min(60.0, double(map.distance.at(face, column, row)));
                for (double t = 0.0; t <= end; t += 0.01) {
                    const glm::dvec3 p = map.center + t * d;
                    if (glm::all(glm::lessThanEqual(box.min, p)) &&
                        glm::all(glm::lessThanEqual(p, box.max)))
                        return true;
                }
            }
        }
    }
    return false;
}

TEST(BoxesSeen, InsideTheWallsAndThroughTheHoleButNotBehindTheWall) {
    const glm::dvec3 center(3.0, -4.0, 2.0);
    const ReferenceEnvironmentMap map = room(20, center);
    const std::vector<Box> behind{boxAt(center + glm::dvec3(0.0, 20.0, 0.0), glm::dvec3(5.0))};
    EXPECT_FALSE(nearestBoxSeen(map, behind));
    const std::vector<Box> through{behind[0],
                                   boxAt(center + glm::dvec3(200.0, 0.0, 0.0), glm::dvec3(12.0))};
    EXPECT_EQ(nearestBoxSeen(map, through), 1U);
    const std::vector<Box> around{through[1], boxAt(center, glm::dvec3(1.0))};
    EXPECT_EQ(nearestBoxSeen(map, around), 1U) << "the centre lies inside it";
    EXPECT_FALSE(nearestBoxSeen(map, {}));
}

TEST(BoxesSeen, TheNearestOfThoseThatAreSeenIsTold) {
    const ReferenceEnvironmentMap map = room(32, glm::dvec3(0.0));
    const std::vector<Box> boxes{boxAt({0.0, 13.0, 0.0}, glm::dvec3(2.0)),  // behind a wall
                                 boxAt({0.0, -8.0, 0.0}, glm::dvec3(0.9)),  // seen
                                 boxAt({0.0, 0.0, 5.0}, glm::dvec3(0.9)),   // seen, nearer
                                 boxAt({0.0, 0.0, 5.0}, glm::dvec3(0.9))};  // at the same place
    EXPECT_EQ(nearestBoxSeen(map, boxes), 2U);
}

TEST(BoxesSeen, AgreesWithWalkingAlongEveryRay) {
    const ReferenceEnvironmentMap map = room(12, glm::dvec3(0.5, 0.25, -0.75));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-24.0, 24.0), size(0.05, 4.0);
    int seen = 0;
    constexpr int kTrials = 120;
    for (int i = 0; i < kTrials; ++i) {
        const glm::dvec3 at(place(random), place(random), place(random));
        const Box box = boxAt(at, {size(random), size(random), size(random)});
        const std::vector<Box> one{box};
        const bool is = nearestBoxSeen(map, one).has_value();
        const bool walked = seenByWalking(map, box);
        seen += walked ? 1 : 0;
        // A ray may touch a corner between two points of the walk.
        EXPECT_TRUE(is || !walked) << i;
        const std::vector<Box> smaller{boxAt(at, 0.5 * box.size() - glm::dvec3(0.02))};
        if (is && !walked) {
            EXPECT_FALSE(nearestBoxSeen(map, smaller)) << i;
        }
    }
    EXPECT_GT(seen, kTrials / 10);
    EXPECT_LT(seen, kTrials - kTrials / 10);
}

}  // namespace
}  // namespace reflet
