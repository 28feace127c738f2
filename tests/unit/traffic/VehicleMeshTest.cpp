// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Vehicle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace reflet {
namespace {

class VehicleMesh : public ::testing::TestWithParam<const char*> {
protected:
    static const Vehicle& vehicle() {
        static std::map<std::string, Vehicle> made;
        const std::string name = GetParam();
        if (!made.contains(name)) {
            made[name] = builtInVehicle(name).value();
        }
        return made[name];
    }
};

INSTANTIATE_TEST_SUITE_P(BuiltIn, VehicleMesh, ::testing::Values("tram", "bus", "car", "sphere"));

glm::vec3 crossOf(const VehicleBody& body, const glm::uvec3& t) {
    return glm::cross(body.vertices[t.y] - body.vertices[t.x],
                      body.vertices[t.z] - body.vertices[t.x]);
}

Box boundsOf(const VehicleBody& body) {
    Box box;
    for (const glm::vec3& v : body.vertices) {
        box.add(glm::dvec3(v));
    }
    return box;
}

TEST_P(VehicleMesh, HasFiniteVerticesUnitNormalsAndValidIndices) {
    ASSERT_FALSE(vehicle().bodies.empty());
    for (const VehicleBody& body : vehicle().bodies) {
        ASSERT_GT(body.triangles.size(), 1000U);
        ASSERT_EQ(body.vertices.size(), body.normals.size());
        ASSERT_EQ(body.triangles.size(), body.triangleMaterial.size());
        for (std::size_t i = 0; i < body.vertices.size(); ++i) {
            ASSERT_TRUE(std::isfinite(glm::length(body.vertices[i])));
            ASSERT_NEAR(glm::length(body.normals[i]), 1.0F, 1e-4F);
        }
        for (std::size_t i = 0; i < body.triangles.size(); ++i) {
            const glm::uvec3 t = body.triangles[i];
            ASSERT_LT(std::max({t.x, t.y, t.z}), body.vertices.size());
            ASSERT_LT(body.triangleMaterial[i], vehicle().materials.size());
        }
    }
}

TEST_P(VehicleMesh, HasNormalsOnTheSideThatItsTrianglesFace) {
    for (const VehicleBody& body : vehicle().bodies) {
        double area = 0.0;
        double wrong = 0.0;
        for (const glm::uvec3& t : body.triangles) {
            const glm::vec3 cross = crossOf(body, t);
            const glm::vec3 mean = body.normals[t.x] + body.normals[t.y] + body.normals[t.z];
            area += double(glm::length(cross));
            wrong += glm::dot(cross, mean) <= 0.0F ? double(glm::length(cross)) : 0.0;
        }
        EXPECT_GT(area, 1.0);
        EXPECT_LT(wrong, 1e-4 * area);
    }
}

TEST_P(VehicleMesh, IsOrientedConsistently) {
    // No edge runs the same way in two triangles: that would mean one of them is turned over.
    for (const VehicleBody& body : vehicle().bodies) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const glm::uvec3& t : body.triangles) {
            for (int k = 0; k < 3; ++k) {
                EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second);
            }
        }
    }
}

TEST_P(VehicleMesh, KeepsEachBodyWithinEightMetresAndAboveTheGround) {
    double lowest = 1e300;
    for (const VehicleBody& body : vehicle().bodies) {
        const Box box = boundsOf(body);
        EXPECT_LE(box.size().x, 8.0);
        EXPECT_GE(box.min.z, -1e-4);
        EXPECT_GT(box.max.z, double(body.center.z));
        EXPECT_LT(box.min.z, double(body.center.z));
        lowest = std::min(lowest, box.min.z);
    }
    EXPECT_NEAR(lowest, std::string(GetParam()) == "sphere" ? 0.2 : 0.0, 1e-4);  // wheels touch it
}

TEST_P(VehicleMesh, ListsBodiesFromTheFrontToTheRearWithoutOverlap) {
    const auto& bodies = vehicle().bodies;
    for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
        EXPECT_GT(bodies[i].offset, bodies[i + 1].offset + 1.0);
    }
}

TEST_P(VehicleMesh, IsTheSameEveryTimeItIsMade) {
    const Vehicle again = builtInVehicle(GetParam()).value();
    for (std::size_t i = 0; i < again.bodies.size(); ++i) {
        EXPECT_EQ(again.bodies[i].vertices, vehicle().bodies[i].vertices);
        EXPECT_EQ(again.bodies[i].triangles, vehicle().bodies[i].triangles);
    }
}

double areaOf(const Vehicle& vehicle, const std::string& material, const glm::vec3& facing) {
    double area = 0.0;
    for (const VehicleBody& body : vehicle.bodies) {
        for (std::size_t i = 0; i < body.triangles.size(); ++i) {
            if (vehicle.materials[body.triangleMaterial[i]].name == material) {
                area += std::max(0.0F, 0.5F * glm::dot(crossOf(body, body.triangles[i]), facing));
            }
        }
    }
    return area;
}

TEST(BuiltInVehicles, AreNamedAndUnknownNamesAreUsageErrors) {
    EXPECT_EQ(builtInVehicleNames(),
              (std::vector<std::string>{"tram", "bus", "car", "sphere", "woman", "man", "child",
                                        "whale", "mirror-tree"}));
    const auto none = builtInVehicle("zeppelin");
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().code, ErrorCode::Usage);
    EXPECT_EQ(none.error().subject, "zeppelin");
}

TEST(BuiltInVehicles, HaveTheStatedLengths) {
    EXPECT_NEAR(builtInVehicle("tram")->length(), 33.5, 0.5);
    EXPECT_NEAR(builtInVehicle("bus")->length(), 12.05, 0.1);
    EXPECT_NEAR(builtInVehicle("car")->length(), 4.45, 0.05);
    EXPECT_NEAR(builtInVehicle("sphere")->length(), 2.0, 1e-5);
}

TEST(BuiltInVehicles, HaveWindowsOnBothSidesAndInFront) {
    for (const char* name : {"tram", "bus", "car"}) {
        const Vehicle vehicle = builtInVehicle(name).value();
        const double left = areaOf(vehicle, "window", {0, 1, 0});
        const double right = areaOf(vehicle, "window", {0, -1, 0});
        EXPECT_GT(left, 0.13 * vehicle.length()) << name;
        EXPECT_GT(right, 0.13 * vehicle.length()) << name;
        EXPECT_GT(areaOf(vehicle, "window", {1, 0, 0}), 0.3) << name;
        EXPECT_GT(areaOf(vehicle, "headlight", {1, 0, 0}), 0.002) << name;
        EXPECT_GT(areaOf(vehicle, "tail light", {-1, 0, 0}), 0.02) << name;
        EXPECT_EQ(areaOf(vehicle, "tail light", {1, 0, 0}), 0.0) << name;
    }
}

TEST(BuiltInVehicles, KeepTheTramWithinItsGauge) {
    const Vehicle tram = builtInVehicle("tram").value();
    ASSERT_EQ(tram.bodies.size(), 5U);
    for (const VehicleBody& body : tram.bodies) {
        for (std::size_t i = 0; i < body.triangles.size(); ++i) {
            const std::string& material = tram.materials[body.triangleMaterial[i]].name;
            const glm::vec3 v = body.vertices[body.triangles[i].x];
            if (material == "petrol paint" || material == "window" || material == "silver paint") {
                ASSERT_LE(std::abs(v.y), 1.326F);
                ASSERT_LE(v.z, 3.51F);
            }
        }
    }
}

TEST(BuiltInVehicles, MakeTheSphereAClosedUnitBall) {
    const Vehicle sphere = builtInVehicle("sphere").value();
    const VehicleBody& body = sphere.bodies.front();
    EXPECT_FLOAT_EQ(body.center.z, 1.2F);
    double volume = 0.0;
    std::map<std::array<std::int64_t, 6>, int> edges;  // by position: +1 one way, -1 the other
    const auto key = [](const glm::vec3& v) {
        return std::array<std::int64_t, 3>{std::llround(v.x * 1e6), std::llround(v.y * 1e6),
                                           std::llround(v.z * 1e6)};
    };
    for (const glm::uvec3& t : body.triangles) {
        const glm::dvec3 a(body.vertices[t.x]);
        volume += glm::dot(a, glm::cross(glm::dvec3(body.vertices[t.y]),
                                         glm::dvec3(body.vertices[t.z]))) /
                  6.0;
        for (int k = 0; k < 3; ++k) {
            const auto p = key(body.vertices[t[k]]);
            const auto q = key(body.vertices[t[(k + 1) % 3]]);
            const bool ordered = p < q;
            const auto& lo = ordered ? p : q;
            const auto& hi = ordered ? q : p;
            edges[{lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]}] += ordered ? 1 : -1;
        }
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * kPi, 0.002);
    EXPECT_GT(edges.size(), 10000U);
    EXPECT_TRUE(
        std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; }));
    for (std::size_t i = 0; i < body.vertices.size(); ++i) {
        const glm::vec3 radial = body.vertices[i] - glm::vec3(0, 0, 1.2F);
        ASSERT_NEAR(glm::length(radial), 1.0F, 1e-5F);
        ASSERT_GT(glm::dot(body.normals[i], radial), 0.99999F);
    }
}

}  // namespace
}  // namespace reflet
