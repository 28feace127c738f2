// SPDX-License-Identifier: GPL-3.0-or-later
// Vehicles in local maps: drawn by OpenGL against drawn by rays.
#include "core/environment/ImageMetrics.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/reflection/MapBodiesPass.h"
#include "core/rendering/MapBodies.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr int kEdge = 64;
const glm::dvec3 kCenter(0.0, 0.0, 1.5);

/// An upright pane of 6 m × 3 m that glows, facing -x.
Vehicle glowingPane() {
    Vehicle vehicle;
    VehicleMaterial material;
    material.baseColor = glm::vec3(0.0F);
    material.emission = {0.25F, 0.5F, 2.0F};
    vehicle.materials.push_back(material);
    VehicleBody body;
    body.vertices = {{0, 3, 0}, {0, -3, 0}, {0, -3, 3}, {0, 3, 3}};
    body.normals.assign(4, {-1, 0, 0});
    body.triangles = {{0, 1, 2}, {0, 2, 3}};
    body.triangleMaterial = {0, 0};
    body.center = {0, 0, 1.5F};
    vehicle.bodies.push_back(body);
    return vehicle;
}

class MapBodiesOnGpu : public test::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped() || HasFatalFailure())
            return;
        const auto take = [](auto& part, auto made) {
            ASSERT_TRUE(made) << made.error().message();
            part = std::move(*made);
        };
        take(m_cityPass, CityPass::create());
        take(m_bodyPass, BodyPass::create());
        take(m_localMaps, LocalMapPass::create());
        take(m_pass, MapBodiesPass::create());
        m_lighting.sunDirection = glm::normalize(glm::dvec3(-0.5, -0.4, 0.6));
        m_cityPass->setLighting(m_lighting);
        m_bodyPass->setLighting(m_lighting);
    }
    void TearDown() override {
        m_pass.reset();
        m_localMaps.reset();
        m_bodyPass.reset();
        m_cityPass.reset();
        m_meshes = {};
        GlFixture::TearDown();
    }

    /// A grey surface at some distance to all sides.
    static std::shared_ptr<LocalEnvironmentMap> room(float distance) {
        auto map = std::make_shared<LocalEnvironmentMap>();
        map->center = kCenter;
        map->radiance = CubeMap<glm::vec3>(kEdge, glm::vec3(0.4F, 0.35F, 0.3F));
        map->distance = CubeMap<float>(kEdge, distance);
        map->uncovered = CubeMap<unsigned char>(kEdge);
        return map;
    }
    [[nodiscard]] GpuLocalMap upload(const std::shared_ptr<const LocalEnvironmentMap>& map) {
        const LocalMapRequest request{Method::RayTrace, kCenter, {}, map};
        return m_localMaps->draw({&request, 1}, nullptr).front();
    }
    void place(Vehicle vehicle, const glm::dvec3& at) {
        m_vehicle = std::make_shared<const Vehicle>(std::move(vehicle));
        m_pose.translation = at;
        const double a = 0.3;
        m_pose.rotation =
            glm::dmat3(std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1);
    }
    [[nodiscard]] std::vector<MapBodiesPass::Other> others(const std::string& reflector = "other") {
        const VehicleMesh& mesh = m_meshes.of(m_vehicle);
        std::vector<MapBodiesPass::Other> all;
        for (std::size_t i = 0; i < mesh.bodies.size(); ++i) {
            all.push_back({reflector,
                           {m_vehicle.get(), &mesh.bodies[i], {}, &mesh.materials, i, m_pose},
                           {}});
        }
        return all;
    }
    [[nodiscard]] GpuLocalMap draw(const GpuLocalMap& city, bool isNew = true, int samples = 2,
                                   const Hiding* hiding = nullptr) {
        static_cast<void>(m_cityPass->prepareShadows(kCenter, {}));
        m_cityPass->bindLight();
        const MapBodiesPass::CityMap map{"own", 0, 0, city, isNew};
        return m_pass->draw({&map, 1}, others(), *m_bodyPass, samples, hiding).front();
    }
    /// PSNR of what either map shows of a vehicle, 200 where they are the same.
    [[nodiscard]] static double likeness(const LocalEnvironmentMap& found,
                                         const LocalEnvironmentMap& expected,
                                         const glm::vec3& wall) {
        // Only where either shows the vehicle: else the figure would be that of the room.
        DisplayImage ours{1, 0, {}}, reference{1, 0, {}};
        for (std::size_t i = 0; i < found.radiance.texels().size(); ++i) {
            const glm::vec3 a = found.radiance.texels()[i];
            const glm::vec3 b = expected.radiance.texels()[i];
            if (glm::distance(a, wall) < 1e-3F && glm::distance(b, wall) < 1e-3F)
                continue;
            ours.pixels.push_back(toDisplay(a, 1.0F));
            reference.pixels.push_back(toDisplay(b, 1.0F));
        }
        ours.height = reference.height = int(ours.pixels.size());
        PsnrAccumulator psnr;
        psnr.add(ours, reference);
        return psnr.decibels().value_or(200.0);
    }
    /// The same by rays.
    [[nodiscard]] LocalEnvironmentMap traced(const LocalEnvironmentMap& city) {
        LocalEnvironmentMap map = city;
        std::vector<PlacedBody> bodies;
        std::vector<std::vector<glm::vec3>> vertices;
        std::vector<Occluder> occluders;
        for (std::size_t i = 0; i < m_vehicle->bodies.size(); ++i)
            bodies.push_back({m_vehicle.get(), i, m_pose, &city, nullptr, 1});
        for (const PlacedBody& body : bodies)
            vertices.push_back(projectVertices(body));
        for (std::size_t i = 0; i < bodies.size(); ++i)
            occluders.push_back({vertices[i], m_vehicle->bodies[i].triangles});
        const CityModel nothing;
        const auto scene = RadianceScene::create(nothing, {}, m_lighting, occluders, {});
        EXPECT_TRUE(scene.has_value());
        const auto drawn = drawIntoMap(map, 0, {scene->get(), bodies, nullptr, 2}, {});
        EXPECT_TRUE(drawn.has_value());
        m_texels = drawn.value_or(0);
        return map;
    }

    Lighting m_lighting;
    std::unique_ptr<CityPass> m_cityPass;
    std::unique_ptr<BodyPass> m_bodyPass;
    std::unique_ptr<LocalMapPass> m_localMaps;
    std::unique_ptr<MapBodiesPass> m_pass;
    VehicleMeshes m_meshes;
    std::shared_ptr<const Vehicle> m_vehicle;
    RigidTransform m_pose;
    std::size_t m_texels = 0;  ///< that rays drew
};

TEST_F(MapBodiesOnGpu, AGlowingPaneFillsTheTexelsThatRaysGiveIt) {
    for (const glm::dvec3& at : {glm::dvec3(4, 0.5, 0), glm::dvec3(-1, 5, -1), glm::dvec3(2, -3, 2),
                                 glm::dvec3(0.7, 0, 0)}) {
        place(glowingPane(), at);
        const auto city = room(6.0F);
        const LocalEnvironmentMap expected = traced(*city);
        const LocalEnvironmentMap found = LocalMapPass::read(draw(upload(city)));
        EXPECT_GT(m_texels, 100U);
        std::size_t lit = 0, radiance = 0, distance = 0;
        for (std::size_t i = 0; i < found.radiance.texels().size(); ++i) {
            const glm::vec3 e = expected.radiance.texels()[i];
            lit += e.z > 0.5F ? 1 : 0;
            radiance += glm::distance(found.radiance.texels()[i], e) > 0.01F ? 1 : 0;
            // Of texels that the pane fills; those on its rim show the nearer surface or the other.
            const float d = expected.distance.texels()[i];
            distance += e.z > 1.99F && std::abs(found.distance.texels()[i] - d) > 0.01F * d ? 1 : 0;
        }
        EXPECT_GT(lit, 100U);
        // Rasterisation may decide otherwise for samples on the rim.
        EXPECT_LE(radiance, m_texels / 50);
        EXPECT_LE(distance, m_texels / 100);
    }
}

TEST_F(MapBodiesOnGpu, VehiclesLookAsByRays) {
    for (const char* name : {"car", "bus", "sphere"}) {
        place(builtInVehicle(name).value(), {5.0, 1.0, 0.0});
        const auto city = room(30.0F);
        const LocalEnvironmentMap expected = traced(*city);
        const LocalEnvironmentMap found = LocalMapPass::read(draw(upload(city)));
        EXPECT_GT(m_texels, 100U) << name;
        const double decibels = likeness(found, expected, city->radiance.texels()[0]);
        RecordProperty(name, std::to_string(decibels));
        EXPECT_GT(decibels, 20.0) << name;
    }
}

/// With a sample a texel, coarser meshes and, in small ones, reflections without parallax.
TEST_F(MapBodiesOnGpu, VehiclesLookAboutAsByRaysWhileSomethingMoves) {
    for (const double away : {5.0, 15.0}) {
        place(builtInVehicle("car").value(), {away, 1.0, 0.0});
        const auto city = room(30.0F);
        const LocalEnvironmentMap expected = traced(*city);
        const LocalEnvironmentMap found = LocalMapPass::read(draw(upload(city), true, 1));
        EXPECT_GT(m_texels, 10U);
        const double decibels = likeness(found, expected, city->radiance.texels()[0]);
        RecordProperty("decibels", std::to_string(decibels));
        EXPECT_GT(decibels, 15.0) << away;
    }
}

TEST_F(MapBodiesOnGpu, WhatTheCityHidesFromTheMapIsLeftOut) {
    test::BoxCity houses(-20.0, -20.0, 80, 80, 0.5);
    houses.addBox(5.0, -15.0, 8.0, 15.0, 12.0F);
    const Hiding hiding(houses.heightfield());
    const auto city = room(20.0F);
    const GpuLocalMap map = upload(city);
    place(builtInVehicle("car").value(), {12.0, 0.0, 0.0});
    EXPECT_EQ(draw(map, true, 2, &hiding).texture->id(), map.texture->id());
    EXPECT_EQ(m_pass->drawn(), 0U);
    EXPECT_NE(draw(map).texture->id(), map.texture->id());
    EXPECT_EQ(m_pass->drawn(), 1U);
    // Before the house it is in the map, and the same as if nothing hid anything.
    m_pass->nextFrame();
    m_pose.translation.x = -12.0;
    const LocalEnvironmentMap seen = LocalMapPass::read(draw(map, true, 2, &hiding));
    EXPECT_EQ(m_pass->drawn(), 1U);
    EXPECT_EQ(likeness(seen, LocalMapPass::read(draw(map)), glm::vec3(-1.0F)), 200.0);
}

TEST_F(MapBodiesOnGpu, WhatTheMapShowsNearerHidesTheVehicle) {
    place(glowingPane(), {4.0, 0.0, 0.0});
    const auto city = room(2.0F);
    const LocalEnvironmentMap found = LocalMapPass::read(draw(upload(city)));
    for (std::size_t i = 0; i < found.radiance.texels().size(); ++i) {
        ASSERT_LT(glm::distance(found.radiance.texels()[i], city->radiance.texels()[i]), 1e-3F);
        ASSERT_NEAR(found.distance.texels()[i], 2.0F, 0.002F);
    }
}

TEST_F(MapBodiesOnGpu, ACopyIsKeptUntilABodyMovesAndTheMapOfTheCityIsNeverTouched) {
    place(glowingPane(), {4.0, 0.0, 0.0});
    const auto city = room(20.0F);
    const GpuLocalMap map = upload(city);
    const GpuLocalMap first = draw(map);
    EXPECT_EQ(m_pass->drawn(), 1U);
    EXPECT_NE(first.texture->id(), map.texture->id());
    m_pass->nextFrame();
    EXPECT_EQ(draw(map, false).texture->id(), first.texture->id());
    EXPECT_EQ(m_pass->drawn(), 0U);
    m_pose.translation.x += 0.1;
    static_cast<void>(draw(map, false));
    EXPECT_EQ(m_pass->drawn(), 1U);
    const LocalEnvironmentMap still = LocalMapPass::read(map);
    EXPECT_LT(glm::distance(still.radiance.texels()[0], city->radiance.texels()[0]), 1e-3F);
    // Too far to fill a texel: the city's own map.
    m_pose.translation.x = 5000.0;
    EXPECT_EQ(draw(map, false).texture->id(), map.texture->id());
}

}  // namespace
}  // namespace reflet
