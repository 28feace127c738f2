// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Traffic.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace reflet {
namespace {

std::shared_ptr<const Vehicle> vehicle(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const Vehicle>> made;
    auto& entry = made[name];
    if (!entry)
        entry = std::make_shared<const Vehicle>(builtInVehicle(name).value());
    return entry;
}

std::shared_ptr<const Route> line(std::vector<glm::dvec3> points, double radius = 0.0) {
    const Route route(std::move(points));
    return std::make_shared<const Route>(radius > 0.0 ? route.smoothed(radius) : route);
}

Drive drive(const std::string& id, const char* name, std::shared_ptr<const Route> route,
            double speed, double start = 0.0) {
    return {id, "route", vehicle(name), std::move(route), speed, start};
}

Traffic settled(std::vector<Drive> drives) {
    Traffic traffic;
    for (Drive& d : drives)
        traffic.add(std::move(d));
    traffic.settle();
    return traffic;
}

/// The outline of a body seen from above.
using Outline = std::array<glm::dvec2, 4>;

std::vector<Outline> outlines(const PlacedReflector& placed) {
    static std::map<const VehicleBody*, Box> known;
    std::vector<Outline> all;
    for (std::size_t i = 0; i < placed.poses.size(); ++i) {
        Box& box = known[&placed.vehicle->bodies[i]];
        if (box.empty()) {
            for (const glm::vec3& v : placed.vehicle->bodies[i].vertices)
                box.add(glm::dvec3(v));
        }
        const auto corner = [&](double x, double y) {
            return glm::dvec2(placed.poses[i] * glm::dvec3(x, y, 0.0));
        };
        all.push_back({corner(box.min.x, box.min.y), corner(box.max.x, box.min.y),
                       corner(box.max.x, box.max.y), corner(box.min.x, box.max.y)});
    }
    return all;
}

/// Separating axes of two convex outlines.
bool overlap(const Outline& a, const Outline& b) {
    for (const Outline* from : {&a, &b}) {
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec2 edge = (*from)[(k + 1) % 4] - (*from)[k];
            const glm::dvec2 axis(-edge.y, edge.x);
            const auto range = [&](const Outline& o) {
                double low = 1e300, high = -1e300;
                for (const glm::dvec2& p : o) {
                    low = std::min(low, glm::dot(p, axis));
                    high = std::max(high, glm::dot(p, axis));
                }
                return std::pair(low, high);
            };
            const auto [lowA, highA] = range(a);
            const auto [lowB, highB] = range(b);
            if (highA < lowB || highB < lowA)
                return false;
        }
    }
    return true;
}

bool overlap(const PlacedReflector& a, const PlacedReflector& b) {
    for (const Outline& one : outlines(a)) {
        for (const Outline& other : outlines(b)) {
            if (overlap(one, other))
                return true;
        }
    }
    return false;
}

/// The first second at which two are within each other, people among themselves apart; -1: never.
double firstOverlap(const Traffic& traffic, double until) {
    for (double t = 0.0; t <= until; t += 0.5) {
        const auto all = traffic.at(t);
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = i + 1; j < all.size(); ++j) {
                if (all[i].vehicle->walks && all[j].vehicle->walks)
                    continue;
                if (overlap(all[i], all[j]))
                    return t;
            }
        }
    }
    return -1.0;
}

TEST(Timetable, WhoMeetsNobodyDrivesAtASteadySpeedAndWaitsAtTheEnd) {
    const auto west = line({{0, 0, 0}, {200, 0, 0}});
    const auto far = line({{0, 50, 0}, {200, 50, 0}});
    const Traffic traffic =
        settled({drive("a", "car", west, 8.0, 3.0), drive("b", "car", far, 5.0)});
    for (const double t : {0.0, 0.05, 7.3, 20.0}) {
        EXPECT_DOUBLE_EQ(traffic.at(0, t).station, 3.0 + 8.0 * t);
        EXPECT_DOUBLE_EQ(traffic.at(1, t).station, 5.0 * t);
    }
    EXPECT_DOUBLE_EQ(traffic.at(0, 500.0).station, 200.0);
    EXPECT_DOUBLE_EQ(traffic.duration(), 40.0);
    EXPECT_DOUBLE_EQ(traffic.secondsAt(0, 43.0), 5.0);
}

TEST(Timetable, AFasterCarFallsInBehindASlowerOneAndKeepsItsDistance) {
    const auto road = line({{0, 0, 0}, {300, 0, 0}});
    const Traffic traffic =
        settled({drive("fast", "car", road, 12.0, 10.0), drive("slow", "car", road, 4.0, 40.0)});
    EXPECT_EQ(firstOverlap(traffic, 90.0), -1.0);
    const double length = vehicle("car")->length();
    for (double t = 0.0; t < 60.0; t += 0.5) {
        const double gap = traffic.at(1, t).station - traffic.at(0, t).station - length;
        EXPECT_GT(gap, 0.9) << t;
    }
    // It goes as fast as the other once it is behind it, and not slower.
    const double later = traffic.at(0, 40.0).station - traffic.at(0, 30.0).station;
    EXPECT_NEAR(later, 40.0, 1.0);
    // The other one is not held up.
    EXPECT_NEAR(traffic.at(1, 30.0).station, 160.0, 1e-6);
}

TEST(Timetable, WhereRoutesCrossTheFirstToComeGoesFirstAndTheOtherAfterIt) {
    const auto east = line({{-60, 0, 0}, {60, 0, 0}});
    const auto north = line({{0, -60, 0}, {0, 60, 0}});
    const Traffic traffic =
        settled({drive("east", "car", east, 8.0, 10.0), drive("north", "bus", north, 8.0, 12.0)});
    EXPECT_EQ(firstOverlap(traffic, 60.0), -1.0);
    // Both arrive in the end, and one of them as if alone.
    EXPECT_NEAR(traffic.at(0, 60.0).station, 120.0, 1e-6);
    EXPECT_NEAR(traffic.at(1, 60.0).station, 120.0, 1e-6);
    const double steadyEast = 110.0 / 8.0;
    const double steadyNorth = 108.0 / 8.0;
    const double lost[] = {traffic.secondsAt(0, 120.0) - steadyEast,
                           traffic.secondsAt(1, 120.0) - steadyNorth};
    EXPECT_LT(std::min(lost[0], lost[1]), 0.2);
    EXPECT_GT(std::max(lost[0], lost[1]), 1.0);
    EXPECT_LT(std::max(lost[0], lost[1]), 15.0);
}

TEST(Timetable, ACarStopsBeforeACrossingWhileSomebodyIsOnItAndGoesOnAfterwards) {
    const auto road = line({{0, 0, 0}, {200, 0, 0}});
    const auto crossing = line({{120, -8, 0}, {120, 8, 0}});
    const Traffic traffic =
        settled({drive("car", "car", road, 8.0, 30.0), drive("anna", "woman", crossing, 0.7)});
    EXPECT_EQ(firstOverlap(traffic, 60.0), -1.0);
    // She is not kept waiting.
    EXPECT_NEAR(traffic.secondsAt(1, 16.0), 16.0 / 0.7, 0.2);
    const double half = 0.5 * vehicle("car")->length();
    bool stood = false;
    for (double t = 0.0; t < 30.0; t += 0.1) {
        const double y = -8.0 + traffic.at(1, t).station;
        const double nose = traffic.at(0, t).station + half;
        if (std::abs(y) < 1.3) {
            EXPECT_TRUE(nose < 119.0 || nose - 2.0 * half > 120.5) << t;
        }
        const double moved = traffic.at(0, t + 0.1).station - traffic.at(0, t).station;
        stood = stood || (nose > 110.0 && nose < 119.5 && moved < 1e-4);
    }
    EXPECT_TRUE(stood);
    EXPECT_NEAR(traffic.at(0, 60.0).station, 200.0, 1e-6);
}

TEST(Timetable, SomebodyWaitsForACarThatCanNoLongerStop) {
    const auto road = line({{0, 0, 0}, {120, 0, 0}});
    const auto crossing = line({{30, -3, 0}, {30, 8, 0}});
    // Two seconds from the crossing at 14 m/s: braking takes 49 m.
    const Traffic traffic =
        settled({drive("car", "car", road, 14.0, 10.0), drive("ben", "man", crossing, 1.3)});
    EXPECT_EQ(firstOverlap(traffic, 60.0), -1.0);
    EXPECT_NEAR(traffic.secondsAt(0, 120.0), 110.0 / 14.0, 0.2);
    EXPECT_GT(traffic.secondsAt(1, 11.0), 11.0 / 1.3 + 0.3);
    EXPECT_NEAR(traffic.at(1, 60.0).station, 11.0, 1e-6);
}

TEST(Timetable, WhoStandWithinEachOtherAtFirstArePartedAgain) {
    const auto road = line({{0, 0, 0}, {200, 0, 0}});
    const Traffic traffic =
        settled({drive("a", "car", road, 9.0, 20.0), drive("b", "car", road, 4.0, 21.0)});
    EXPECT_NEAR(traffic.at(0, 60.0).station, 200.0, 1e-6);
    EXPECT_EQ(overlap(traffic.at(0, 3.0), traffic.at(1, 3.0)), false);
}

TEST(Timetable, AWhaleOverheadHoldsNobodyUp) {
    const auto road = line({{-60, 0, 0}, {60, 0, 0}});
    const auto flight = line({{0, -60, 12}, {0, 60, 12}});
    const Traffic traffic =
        settled({drive("car", "car", road, 8.0, 0.0), drive("whale", "whale", flight, 8.0, 0.0)});
    EXPECT_DOUBLE_EQ(traffic.at(0, 7.5).station, 60.0);
    EXPECT_DOUBLE_EQ(traffic.at(1, 7.5).station, 60.0);
}

TEST(Timetable, NobodyEverDrivesIntoSomebodyOnRandomRoutes) {
    std::mt19937 random(7);
    const auto between = [&](double a, double b) {
        return a + (b - a) * double(random()) / double(random.max());
    };
    const char* names[] = {"car", "car", "bus", "woman", "man"};
    int tried = 0, held = 0;
    for (int scene = 0; scene < 40; ++scene) {
        std::vector<Drive> drives;
        for (int k = 0; k < 5; ++k) {
            std::vector<glm::dvec3> points;
            const double heading = between(0.0, 6.28);
            glm::dvec3 p(between(-40, 40), between(-40, 40), 0.0);
            double turned = heading;
            for (int i = 0; i < 4; ++i) {
                points.push_back(p);
                turned += between(-0.7, 0.7);
                p += between(30.0, 45.0) * glm::dvec3(std::cos(turned), std::sin(turned), 0.0);
            }
            const bool person = k > 2;
            drives.push_back(drive("d" + std::to_string(k), names[k], line(points, 20.0),
                                   person ? between(0.8, 1.8) : between(2.0, 14.0),
                                   between(0.0, 15.0)));
        }
        Traffic alone;
        for (const Drive& d : drives)
            alone.add(d);
        if (firstOverlap(alone, 0.0) == 0.0)
            continue;
        const Traffic traffic = settled(drives);
        EXPECT_EQ(firstOverlap(traffic, 120.0), -1.0) << "scene " << scene;
        held += firstOverlap(alone, 120.0) >= 0.0 ? 1 : 0;
        ++tried;
        for (std::size_t i = 0; i < traffic.size(); ++i) {
            for (double t = 0.0; t < 60.0; t += 0.5) {
                const double moved = traffic.at(i, t + 0.5).station - traffic.at(i, t).station;
                EXPECT_GE(moved, -1e-9);
                EXPECT_LE(moved, 0.5 * drives[i].speed + 1e-6);
            }
        }
    }
    EXPECT_GT(tried, 20);
    EXPECT_GT(held, 5);  // without rules they would have met
}

TEST(Timetable, IsTheSameEveryTime) {
    const auto east = line({{-60, 0, 0}, {60, 0, 0}});
    const auto north = line({{0, -60, 0}, {0, 60, 0}});
    const std::vector<Drive> drives{drive("e", "car", east, 8.0), drive("n", "car", north, 8.0)};
    const Traffic a = settled(drives);
    const Traffic b = settled(drives);
    for (double t = 0.0; t < 40.0; t += 0.37) {
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_EQ(a.at(i, t).station, b.at(i, t).station);
    }
}

TEST(People, SwingTheirLegsAsTheyWalkAndStandOnTheGround) {
    for (const char* name : {"woman", "man", "child"}) {
        const auto person = vehicle(name);
        EXPECT_TRUE(person->walks);
        const Route way({{0, 0, 0}, {20, 0, 2}});
        double widest = 0.0;
        for (double s = 1.0; s < 4.0; s += 0.05) {
            const auto poses = bodyPoses(*person, way, s);
            double lowest = 1e9, first = -1e9, last = 1e9;
            for (std::size_t i = 0; i < poses.size(); ++i) {
                for (const glm::vec3& v : person->bodies[i].vertices) {
                    const glm::dvec3 p = poses[i] * glm::dvec3(v);
                    if (p.z - way.at(s).z < 0.12) {
                        first = std::max(first, p.x);
                        last = std::min(last, p.x);
                    }
                    lowest = std::min(lowest, p.z - way.at(s).z);
                }
            }
            EXPECT_NEAR(lowest, 0.0, 0.07) << name << " at " << s;
            widest = std::max(widest, first - last);
        }
        EXPECT_GT(widest, 0.5 * person->bodies[1].hinge.z) << name;
        const auto standing = bodyPoses(*person, way, 1.37, 0.0);
        for (const RigidTransform& pose : standing)
            EXPECT_LT(glm::distance(pose.rotation[2], glm::dvec3(0, 0, 1)), 1e-9);
    }
}

}  // namespace
}  // namespace reflet
