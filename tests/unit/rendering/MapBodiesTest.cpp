// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/rendering/MapBodies.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

constexpr int kEdge = 64;
const glm::dvec3 kCenter(0.0, 0.0, 4.0);
const glm::vec3 kGlow(0.25F, 0.5F, 2.0F);
const glm::vec3 kBehind(7.0F, 8.0F, 9.0F);

Lighting night() {
    Lighting lighting;
    lighting.sunDirection = glm::normalize(glm::dvec3(0.2, 0.1, -0.9));
    return lighting;
}

VehicleMaterial glowing() {
    VehicleMaterial material;
    material.baseColor = glm::vec3(0.0F);
    material.emission = kGlow;
    return material;
}

/// An upright pane of 8 m × 8 m about the middle of its body, facing -x.
Vehicle pane(const VehicleMaterial& material) {
    Vehicle vehicle;
    vehicle.materials.push_back(material);
    VehicleBody body;
    body.vertices = {{0, 4, -4}, {0, -4, -4}, {0, -4, 4}, {0, 4, 4}};
    body.normals.assign(4, {-1, 0, 0});
    body.triangles = {{0, 1, 2}, {0, 2, 3}};
    body.triangleMaterial = {0, 0};
    vehicle.bodies.push_back(body);
    return vehicle;
}

LocalEnvironmentMap mapAt(float distance, const glm::vec3& radiance = kBehind) {
    LocalEnvironmentMap map;
    map.center = kCenter;
    map.radiance = CubeMap<glm::vec3>(kEdge, radiance);
    map.distance = CubeMap<float>(kEdge, distance);
    map.uncovered = CubeMap<unsigned char>(kEdge, 1);
    return map;
}

/// Panes standing in a city without anything else.
struct Stage {
    CityModel city;
    std::vector<Vehicle> vehicles;
    std::vector<PlacedBody> bodies;
    std::vector<std::vector<glm::vec3>> vertices;
    std::unique_ptr<RadianceScene> alone, scene;

    void add(std::size_t vehicle, const glm::dvec3& at, std::size_t reflector) {
        PlacedBody body;
        body.vehicle = &vehicles[vehicle];
        body.project_from_body.translation = at;
        body.reflector = reflector;
        bodies.push_back(body);
    }
    void build() {
        std::vector<Occluder> occluders;
        for (const PlacedBody& body : bodies)
            vertices.push_back(projectVertices(body));
        for (std::size_t i = 0; i < bodies.size(); ++i)
            occluders.push_back({vertices[i], bodies[i].vehicle->bodies[0].triangles});
        scene = std::move(RadianceScene::create(city, {}, night(), occluders, {}).value());
        alone = std::move(RadianceScene::create(city, {}, night(), {}, {}).value());
    }
    std::size_t draw(LocalEnvironmentMap& map, bool reference = false) const {
        const MapBodies drawing{scene.get(), bodies, reference ? alone.get() : nullptr, 2};
        return drawIntoMap(map, 0, drawing, {}).value();
    }
};

/// Calls with each texel, the place of its centre on the plane x = 5 (relative to the map's centre,
/// nothing where its ray goes elsewhere), and the length of half a texel there.
template <class Visit>
void eachTexel(const Visit& visit) {
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kEdge; ++row) {
            for (int column = 0; column < kEdge; ++column) {
                const glm::dvec3 d = texelDirection(kEdge, face, column, row);
                const bool towards = d.x > 1e-9;
                visit(face, column, row, towards, towards ? d * (5.0 / d.x) : d);
            }
        }
    }
}

TEST(MapBodies, AGlowingPaneFillsTheTexelsThatTheClosedFormGivesIt) {
    Stage stage;
    stage.vehicles.push_back(pane(glowing()));
    stage.add(0, {5.0, 0.0, 4.0}, 1);
    stage.build();
    LocalEnvironmentMap map = mapAt(kInfinity);
    const std::size_t drawn = stage.draw(map);
    int inside = 0, outside = 0;
    eachTexel([&](int face, int column, int row, bool towards, const glm::dvec3& p) {
        // The pane ends at 4 m to each side; texels at its rim hold a mixture.
        const double reach = towards ? std::max(std::abs(p.y), std::abs(p.z)) : 1e9;
        const glm::vec3 radiance = map.radiance.at(face, column, row);
        const float distance = map.distance.at(face, column, row);
        const double texel = 2.0 * 5.0 / kEdge;
        if (reach < 4.0 - texel) {
            EXPECT_LT(glm::distance(radiance, kGlow), 1e-5F);
            EXPECT_NEAR(distance, float(glm::length(p)), 1e-3F);
            EXPECT_EQ(map.uncovered.at(face, column, row), 0);
            ++inside;
        } else if (reach > 4.0 + texel) {
            EXPECT_EQ(radiance, kBehind);
            EXPECT_EQ(distance, kInfinity);
            EXPECT_EQ(map.uncovered.at(face, column, row), 1);
            ++outside;
        }
    });
    // It takes (8 / 10)² of the face.
    EXPECT_NEAR(double(drawn), 0.64 * kEdge * kEdge, 0.03 * kEdge * kEdge);
    EXPECT_GT(inside, 2000);
    EXPECT_GT(outside, 5 * kEdge * kEdge);
}

TEST(MapBodies, TheRimOfAPaneIsMixedByTheSamplesThatMeetIt) {
    Stage stage;
    stage.vehicles.push_back(pane(glowing()));
    stage.add(0, {5.0, 0.0, 4.0}, 1);
    stage.build();
    LocalEnvironmentMap map = mapAt(kInfinity);
    stage.draw(map);
    double sum = 0.0;
    eachTexel([&](int face, int column, int row, bool, const glm::dvec3&) {
        const float share =
            (kBehind.x - map.radiance.at(face, column, row).x) / (kBehind.x - kGlow.x);
        // Quarters: of four samples.
        EXPECT_NEAR(share * 4.0F, std::round(share * 4.0F), 1e-4F);
        sum += double(share);
    });
    EXPECT_NEAR(sum, 0.64 * kEdge * kEdge, 0.02 * kEdge * kEdge);
}

TEST(MapBodies, WhatTheMapShowsNearerHidesThePaneAndWhatIsFartherDoesNot) {
    Stage stage;
    stage.vehicles.push_back(pane(glowing()));
    stage.add(0, {5.0, 0.0, 4.0}, 1);
    stage.build();
    LocalEnvironmentMap near = mapAt(4.9F);
    EXPECT_EQ(stage.draw(near), 0U);
    eachTexel([&](int face, int column, int row, bool, const glm::dvec3&) {
        EXPECT_EQ(near.radiance.at(face, column, row), kBehind);
        EXPECT_EQ(near.distance.at(face, column, row), 4.9F);
    });
    LocalEnvironmentMap far = mapAt(7.0F);
    EXPECT_GT(stage.draw(far), 2000U);
    eachTexel([&](int face, int column, int row, bool towards, const glm::dvec3& p) {
        if (towards && glm::length(p) > 7.1) {
            EXPECT_EQ(far.radiance.at(face, column, row), kBehind);
        }
    });
}

TEST(MapBodies, AReflectorsOwnBodiesAreLeftOut) {
    Stage stage;
    stage.vehicles.push_back(pane(glowing()));
    stage.add(0, {5.0, 0.0, 4.0}, 0);
    stage.build();
    LocalEnvironmentMap map = mapAt(kInfinity);
    EXPECT_EQ(stage.draw(map), 0U);
    EXPECT_EQ(map.radiance.at(0, kEdge / 2, kEdge / 2), kBehind);
}

TEST(MapBodies, OfTwoPanesTheNearerIsSeenWhicheverComesFirst) {
    VehicleMaterial other = glowing();
    other.emission = glm::vec3(5.0F);
    for (const bool nearFirst : {true, false}) {
        Stage stage;
        stage.vehicles = {pane(glowing()), pane(other)};
        stage.add(nearFirst ? 0 : 1, {nearFirst ? 5.0 : 9.0, 0.0, 4.0}, 1);
        stage.add(nearFirst ? 1 : 0, {nearFirst ? 9.0 : 5.0, 0.0, 4.0}, 2);
        stage.build();
        LocalEnvironmentMap map = mapAt(kInfinity);
        stage.draw(map);
        EXPECT_LT(glm::distance(map.radiance.at(0, kEdge / 2, kEdge / 2), kGlow), 1e-5F);
        EXPECT_NEAR(map.distance.at(0, kEdge / 2, kEdge / 2), 5.0F, 0.01F);
    }
}

TEST(MapBodies, AMirroredMirrorShowsTheCityAndNoThirdVehicle) {
    VehicleMaterial chrome;
    chrome.baseColor = glm::vec3(1.0F);
    chrome.metallic = 1.0F;
    Stage stage;
    stage.vehicles = {pane(chrome), pane(glowing())};
    stage.add(0, {5.0, 0.0, 4.0}, 1);
    stage.add(1, {-6.0, 0.0, 4.0}, 2);  // behind the map's centre, in view of the mirror
    stage.bodies[1].project_from_body.rotation = glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1);
    stage.build();
    const glm::vec3 sky = stage.alone->sky().radiance({-1.0F, 0.0F, 0.0F});
    LocalEnvironmentMap traced = mapAt(kInfinity);
    stage.draw(traced);
    const glm::vec3 seen = traced.radiance.at(0, kEdge / 2, kEdge / 2);
    EXPECT_LT(glm::distance(seen, sky), 0.1F * glm::length(sky) + 1e-4F);
    // The glowing pane itself is in the map all the same.
    EXPECT_LT(glm::distance(traced.radiance.at(1, kEdge / 2, kEdge / 2), kGlow), 1e-5F);

    const LocalEnvironmentMap mirrored = mapAt(kInfinity, glm::vec3(0.5F, 0.25F, 0.125F));
    stage.bodies[0].map = &mirrored;
    LocalEnvironmentMap map = mapAt(kInfinity);
    stage.draw(map);
    EXPECT_LT(
        glm::distance(map.radiance.at(0, kEdge / 2, kEdge / 2), glm::vec3(0.5F, 0.25F, 0.125F)),
        1e-4F);
}

TEST(MapBodies, TheReferenceAgreesWhereTheMapIsExact) {
    Stage stage;
    stage.vehicles.push_back(pane(glowing()));
    stage.add(0, {5.0, 1.0, 5.0}, 1);
    stage.build();
    LocalEnvironmentMap ours = mapAt(kInfinity, glm::vec3(0.0F));
    eachTexel([&](int face, int column, int row, bool, const glm::dvec3&) {
        ours.radiance.at(face, column, row) =
            stage.alone->sky().radiance(glm::normalize(texelDirection(kEdge, face, column, row)));
    });
    LocalEnvironmentMap truth = ours;
    stage.draw(ours);
    stage.draw(truth, true);
    eachTexel([&](int face, int column, int row, bool, const glm::dvec3&) {
        EXPECT_EQ(ours.distance.at(face, column, row), truth.distance.at(face, column, row));
        EXPECT_LT(glm::distance(ours.radiance.at(face, column, row),
                                truth.radiance.at(face, column, row)),
                  0.01F);
    });
}

TEST(MapBodies, ABodyCountsFromTheSizeOfATexelOn) {
    const Box cube{glm::dvec3(-1.0), glm::dvec3(1.0)};
    // The ball around it has a radius of √3; a texel of 128 takes π/256.
    const double limit = std::sqrt(3.0) / std::sin(kPi / 512.0);
    RigidTransform pose;
    pose.translation = {0.99 * limit, 0.0, 0.0};
    EXPECT_TRUE(fillsTexel(cube, pose, glm::dvec3(0.0), 128));
    pose.translation = {1.01 * limit, 0.0, 0.0};
    EXPECT_FALSE(fillsTexel(cube, pose, glm::dvec3(0.0), 128));
    EXPECT_TRUE(fillsTexel(cube, pose, pose.translation, 128));  // from within
    EXPECT_FALSE(fillsTexel(Box{}, pose, glm::dvec3(0.0), 128));
}

TEST(MapBodies, AnyNumberOfThreadsGivesTheSameBits) {
    Stage stage;
    stage.vehicles.push_back(builtInVehicle("car").value());
    stage.add(0, {4.0, 0.5, 3.0}, 1);
    stage.build();
    LocalEnvironmentMap one = mapAt(kInfinity);
    LocalEnvironmentMap four = one;
    setThreadLimit(1);
    const std::size_t drawn = stage.draw(one);
    setThreadLimit(4);
    EXPECT_EQ(stage.draw(four), drawn);
    setThreadLimit(0);
    EXPECT_GT(drawn, 400U);
    EXPECT_EQ(one.radiance.texels(), four.radiance.texels());
    EXPECT_EQ(one.distance.texels(), four.distance.texels());
}

}  // namespace
}  // namespace reflet
