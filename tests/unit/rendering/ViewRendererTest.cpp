// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/math/Geometry.h"
#include "core/rendering/CameraRays.h"
#include "core/rendering/Fresnel.h"
#include "core/rendering/ViewRenderer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

namespace reflet {
namespace {

Lighting night() {
    Lighting lighting;
    lighting.sunDirection = glm::normalize(glm::dvec3(0.2, 0.1, -0.9));
    return lighting;
}

void addQuad(CityModel& city, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
             const glm::vec3& d, CityObjectType type, SurfaceType surface) {
    CityObject object;
    object.id = "object" + std::to_string(city.objects.size());
    object.type = type;
    city.objects.push_back(object);
    CitySurface s;
    s.object = std::uint32_t(city.objects.size() - 1);
    s.type = surface;
    s.material = 0;
    city.surfaces.push_back(s);
    const auto first = std::uint32_t(city.vertices.size());
    city.vertices.insert(city.vertices.end(), {a, b, c, d});
    const auto index = std::uint32_t(city.surfaces.size() - 1);
    city.triangles.push_back({{first, first + 1, first + 2}, index});
    city.triangles.push_back({{first, first + 2, first + 3}, index});
}

CityModel cityWithGround() {
    CityModel city;
    city.materials.emplace_back();
    addQuad(city, {-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0},
            CityObjectType::TinRelief, SurfaceType::Ground);
    return city;
}

/// Vehicles standing in a city, with what they need to stay alive.
struct Stage {
    CityModel city;
    std::vector<Vehicle> vehicles;
    std::vector<PlacedBody> bodies;
    std::vector<std::vector<glm::vec3>> vertices;
    std::vector<Occluder> occluders;
    std::unique_ptr<RadianceScene> scene;

    void build(const Lighting& lighting) {
        vertices.clear();
        occluders.clear();
        for (const PlacedBody& body : bodies) {
            vertices.push_back(projectVertices(body));
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            occluders.push_back({vertices[i], bodies[i].vehicle->bodies[bodies[i].body].triangles});
        }
        auto made = RadianceScene::create(city, {}, lighting, occluders, {});
        ASSERT_TRUE(made.has_value()) << made.error().message();
        scene = std::move(made.value());
    }
    void place(std::size_t vehicle, const glm::dvec3& at, const LocalEnvironmentMap* map) {
        PlacedBody body;
        body.vehicle = &vehicles[vehicle];
        body.project_from_body.translation = at;
        body.map = map;
        bodies.push_back(body);
    }
};

constexpr double kCenterHeight = 1.2;

Vehicle mirrorBall() {
    Vehicle ball = builtInVehicle("sphere").value();
    ball.materials[0].baseColor = glm::vec3(1.0F);
    return ball;
}

/// A square pane of 8 m across x = 0, facing -x, of one material.
Vehicle pane(const VehicleMaterial& material) {
    Vehicle vehicle;
    vehicle.materials.push_back(material);
    VehicleBody body;
    body.vertices = {{0, 4, 0}, {0, -4, 0}, {0, -4, 8}, {0, 4, 8}};
    body.normals.assign(4, {-1, 0, 0});
    body.triangles = {{0, 1, 2}, {0, 2, 3}};
    body.triangleMaterial = {0, 0};
    body.center = {0, 0, 4};
    vehicle.bodies.push_back(body);
    return vehicle;
}

template <class Radiance>
LocalEnvironmentMap mapOf(int resolution, Radiance radiance) {
    LocalEnvironmentMap map;
    map.center = {0, 0, kCenterHeight};
    map.radiance = CubeMap<glm::vec3>(resolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                map.radiance.at(face, column, row) = radiance(
                    glm::vec3(glm::normalize(texelDirection(resolution, face, column, row))));
            }
        }
    }
    return map;
}

Camera ballCamera() {
    Camera camera;
    camera.position = {-6, 1.5, 2.4};
    camera.target = {0, 0, kCenterHeight};
    camera.verticalFov = 0.45;
    return camera;
}

/// Where a ray meets the unit ball, analytically; nothing when it misses or grazes it.
std::optional<glm::dvec3> ballNormal(const glm::dvec3& origin, const glm::dvec3& d) {
    const glm::dvec3 center(0, 0, kCenterHeight);
    const double b = glm::dot(origin - center, d);
    const double c = glm::dot(origin - center, origin - center) - 1.0;
    const double root = b * b - c;
    if (root < 0.15) {
        return std::nullopt;
    }
    return origin + d * (-b - std::sqrt(root)) - center;
}

RenderedView render(const Stage& stage, const Camera& camera, int width, int height, int samples) {
    auto view = renderView(*stage.scene, stage.bodies, camera, {width, height, samples}, {});
    EXPECT_TRUE(view.has_value());
    return view.value();
}

TEST(ViewRenderer, ShowsAConstantEnvironmentInAMirrorBallAsThatConstant) {
    const LocalEnvironmentMap map =
        mapOf(8, [](const glm::vec3&) { return glm::vec3(0.3F, 0.7F, 2.5F); });
    Stage stage;
    stage.vehicles.push_back(mirrorBall());
    stage.place(0, {0, 0, 0}, &map);
    stage.build(night());
    const RenderedView view = render(stage, ballCamera(), 96, 96, 3);
    const CameraRays rays(ballCamera(), 96, 96);
    int inside = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            if (ballNormal(rays.position(), rays.through(x + 0.5, y + 0.5))) {
                const glm::vec3 c = view.radiance[std::size_t(y * 96 + x)];
                EXPECT_NEAR(c.x, 0.3F, 1e-5F);
                EXPECT_NEAR(c.y, 0.7F, 1e-5F);
                EXPECT_NEAR(c.z, 2.5F, 1e-5F);
                EXPECT_EQ(view.reflector[std::size_t(y * 96 + x)], 1);
                ++inside;
            }
        }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_EQ(view.reflector.front(), 0);
}

TEST(ViewRenderer, MirrorsDirectionsAsTheClosedFormOfTheBallSays) {
    // Radiance tells the direction: what arrives at a pixel is 0.5 + 0.5 r.
    const LocalEnvironmentMap map = mapOf(256, [](const glm::vec3& d) { return 0.5F + 0.5F * d; });
    Stage stage;
    stage.vehicles.push_back(mirrorBall());
    stage.place(0, {0, 0, 0}, &map);
    stage.build(night());
    const int size = 128;
    const RenderedView view = render(stage, ballCamera(), size, size, 1);
    const CameraRays rays(ballCamera(), size, size);
    int inside = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::dvec3 d = rays.through(x + 0.5, y + 0.5);
            const auto n = ballNormal(rays.position(), d);
            if (!n) {
                continue;
            }
            const glm::dvec3 r = d - 2.0 * glm::dot(d, *n) * *n;
            const glm::dvec3 seen =
                glm::dvec3(view.radiance[std::size_t(y * size + x)]) * 2.0 - 1.0;
            EXPECT_LT(glm::distance(r, seen), 0.003) << x << "," << y;
            ++inside;
        }
    }
    EXPECT_GT(inside, 2000);
}

TEST(ViewRenderer, DrawsAMapOfADistantEnvironmentLikeRaysIntoIt) {
    Stage stage;
    stage.vehicles.push_back(mirrorBall());
    Lighting dusk;
    dusk.sunDirection = glm::normalize(glm::dvec3(0.9, 0.3, 0.25));
    stage.place(0, {0, 0, 0}, nullptr);
    stage.build(dusk);
    const RenderedView traced = render(stage, ballCamera(), 64, 64, 2);
    const LocalEnvironmentMap map =
        mapOf(256, [&](const glm::vec3& d) { return stage.scene->sky().radiance(d); });
    stage.bodies[0].map = &map;
    const RenderedView mapped = render(stage, ballCamera(), 64, 64, 2);
    double brightness = 0.0;
    for (std::size_t i = 0; i < traced.radiance.size(); ++i) {
        const glm::vec3 scale = glm::max(traced.radiance[i], glm::vec3(0.05F));
        EXPECT_LT(glm::length((mapped.radiance[i] - traced.radiance[i]) / scale), 0.02F);
        brightness += double(traced.radiance[i].y);
    }
    EXPECT_GT(brightness, 10.0);
}

TEST(ViewRenderer, ReflectsThePaneByFresnelAndLetsItsTintThrough) {
    const LocalEnvironmentMap map = mapOf(8, [](const glm::vec3&) { return glm::vec3(1.0F); });
    VehicleMaterial glass;
    glass.baseColor = glm::vec3(0.25F, 0.5F, 0.75F);
    glass.glass = 1.0F;
    Stage stage;
    stage.vehicles.push_back(pane(glass));
    stage.place(0, {5, 0, 0}, &map);
    stage.build(night());
    Camera camera;
    camera.position = {0, 0, 4};
    camera.target = {5, 0, 4};
    camera.verticalFov = 0.01;
    const glm::vec3 through = stage.scene->sky().radiance({1, 0, 0});
    const glm::vec3 expected =
        glm::vec3(kGlazingF0) + glass.baseColor * (1.0F - kGlazingF0) * through;
    const glm::vec3 seen = render(stage, camera, 5, 5, 1).radiance[12];
    EXPECT_LT(glm::distance(seen, expected), 1e-4F);
}

TEST(ViewRenderer, AddsTheClearCoatsShareOfTheMirrorToTheColourBelow) {
    VehicleMaterial paint;
    paint.baseColor = glm::vec3(0.0F);
    paint.clearCoat = 0.5F;
    paint.emission = glm::vec3(0.0F, 0.125F, 0.0F);
    const LocalEnvironmentMap map = mapOf(8, [](const glm::vec3&) { return glm::vec3(3.0F); });
    Stage stage;
    stage.vehicles.push_back(pane(paint));
    stage.place(0, {0, 0, 0}, &map);
    stage.build(night());
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        const double a = degrees * kPi / 180.0;
        Camera camera;
        camera.target = {0, 0, 4};
        camera.position = camera.target + 10.0 * glm::dvec3(-std::cos(a), std::sin(a), 0);
        camera.verticalFov = 0.01;
        const double schlick = 0.04 + 0.96 * std::pow(1.0 - std::cos(a), 5.0);
        const glm::vec3 seen = render(stage, camera, 3, 3, 1).radiance[4];
        EXPECT_NEAR(seen.x, 3.0 * 0.5 * schlick, 1e-3);
        EXPECT_NEAR(seen.y, 3.0 * 0.5 * schlick + 0.125, 1e-3);
    }
}

TEST(ViewRenderer, PutsNorthOnTheLeftWhenLookingEast) {
    const LocalEnvironmentMap map = mapOf(8, [](const glm::vec3&) { return glm::vec3(1.0F); });
    Stage stage;
    stage.vehicles.push_back(mirrorBall());
    stage.place(0, {0, 3, 0}, &map);
    stage.build(night());
    Camera camera;
    camera.position = {-10, 0, 1.2};
    camera.target = {0, 0, 1.2};
    camera.verticalFov = 1.0;
    const RenderedView view = render(stage, camera, 64, 36, 2);
    int left = 0;
    int right = 0;
    for (int y = 0; y < 36; ++y) {
        for (int x = 0; x < 64; ++x) {
            (x < 32 ? left : right) += view.reflector[std::size_t(y * 64 + x)];
        }
    }
    EXPECT_GT(left, 20);
    EXPECT_EQ(right, 0);
}

TEST(ViewRenderer, CastsTheVehiclesShadowOnTheGround) {
    Lighting noon;
    noon.sunDirection = glm::normalize(glm::dvec3(0.0, -0.2, 1.0));
    Stage stage;
    stage.city = cityWithGround();
    stage.vehicles.push_back(mirrorBall());
    stage.place(0, {0, 0, 0}, nullptr);
    stage.build(noon);
    Camera camera;
    camera.position = {-9, 0, 9};
    camera.target = {0, 0.24, 0};
    camera.verticalFov = 0.9;
    const CameraRays rays(camera, 200, 200);
    const RenderedView view = render(stage, camera, 200, 200, 2);
    const auto at = [&](const glm::dvec3& p) {
        const glm::dvec2 q = rays.project(p).value();
        return view.radiance[std::size_t(q.y) * 200 + std::size_t(q.x)].y;
    };
    // The shadow of the ball's middle falls 0.24 m to the north; look just in front of the ball.
    EXPECT_LT(at({-0.75, 0.24, 0}), 0.6F * at({-4, 4, 0}));
}

TEST(ViewRenderer, LeavesAVehiclesOwnBodiesOutOfTracedReflections) {
    Stage alone;
    alone.vehicles.push_back(mirrorBall());
    alone.place(0, {0, 0, 0}, nullptr);
    Lighting dusk;
    dusk.sunDirection = glm::normalize(glm::dvec3(0.9, 0.3, 0.1));
    alone.build(dusk);
    Stage pair;
    pair.vehicles.push_back(mirrorBall());
    pair.place(0, {0, 0, 0}, nullptr);
    pair.place(0, {0.5, 2.4, 0}, nullptr);
    pair.build(dusk);
    const RenderedView a = render(alone, ballCamera(), 96, 96, 1);
    const RenderedView b = render(pair, ballCamera(), 96, 96, 1);
    const CameraRays rays(ballCamera(), 96, 96);
    int compared = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            if (ballNormal(rays.position(), rays.through(x + 0.5, y + 0.5))) {
                const auto i = std::size_t(y * 96 + x);
                EXPECT_LT(glm::distance(a.radiance[i], b.radiance[i]), 1e-4F);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 1000);
}

TEST(ViewRenderer, ShowsAnotherVehicleInTracedReflectionsWhereTheClosedFormHasIt) {
    VehicleMaterial glow;
    glow.baseColor = glm::vec3(0.0F);
    glow.emission = glm::vec3(0.25F, 0.5F, 2.0F);
    Stage stage;
    stage.vehicles = {mirrorBall(), pane(glow)};
    stage.place(0, {0, 0, 0}, nullptr);
    stage.place(1, {-8, 0, -2}, nullptr);
    // Behind the camera, its glowing side towards the ball.
    stage.bodies[1].project_from_body.rotation = glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1);
    stage.bodies[1].reflector = 1;
    stage.build(night());
    const RenderedView view = render(stage, ballCamera(), 96, 96, 1);
    const CameraRays rays(ballCamera(), 96, 96);
    int shown = 0, hidden = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const glm::dvec3 d = rays.through(x + 0.5, y + 0.5);
            const auto n = ballNormal(rays.position(), d);
            if (!n)
                continue;
            const glm::dvec3 r = d - 2.0 * glm::dot(d, *n) * *n;
            const glm::dvec3 from = glm::dvec3(0, 0, kCenterHeight) + *n;
            const double t = (-8.0 - from.x) / r.x;
            const glm::dvec3 at = from + t * r;
            const double reach = t > 0.0 ? std::max(std::abs(at.y), std::abs(at.z - 2.0)) : 1e9;
            const glm::vec3 c = view.radiance[std::size_t(y * 96 + x)];
            if (reach < 3.9) {
                EXPECT_LT(glm::distance(c, glow.emission), 0.02F);
                ++shown;
            } else if (reach > 4.1) {
                EXPECT_GT(glm::distance(c, glow.emission), 0.1F);
                ++hidden;
            }
        }
    }
    EXPECT_GT(shown, 200);
    EXPECT_GT(hidden, 300);
}

TEST(ViewRenderer, FadesTheMapsOfRigidlyCoupledBodiesIntoOneAnother) {
    VehicleMaterial mirror;
    mirror.baseColor = glm::vec3(1.0F);
    mirror.metallic = 1.0F;
    // A wall of 16 m along x that faces south, cut into two bodies at its middle.
    Vehicle wall;
    wall.materials.push_back(mirror);
    for (const double side : {1.0, -1.0}) {
        VehicleBody body;
        body.vertices = {{-4, 0, 0}, {4, 0, 0}, {4, 0, 8}, {-4, 0, 8}};
        body.normals.assign(4, {0, -1, 0});
        body.triangles = {{0, 1, 2}, {0, 2, 3}};
        body.triangleMaterial = {0, 0};
        body.center = {0, 0, 4};
        body.offset = 4.0 * side;
        body.pivotMiddle = -4.0 * side;
        body.pivotSpan = 6.0;
        wall.bodies.push_back(body);
    }
    LocalEnvironmentMap dark = mapOf(8, [](const glm::vec3&) { return glm::vec3(0.0F); });
    LocalEnvironmentMap bright = mapOf(8, [](const glm::vec3&) { return glm::vec3(1.0F); });
    bright.center = {4, 0, 4};
    dark.center = {-4, 0, 4};
    Stage stage;
    stage.vehicles.push_back(wall);
    stage.place(0, {4, 0, 0}, &bright);
    stage.place(0, {-4, 0, 0}, &dark);
    stage.bodies[1].body = 1;
    stage.build(night());
    Camera camera;
    camera.position = {0, -20, 4};
    camera.target = {0, 0, 4};
    camera.verticalFov = 0.035;
    const int width = 401;
    const RenderedView view = render(stage, camera, width, 21, 1);
    const float* last = nullptr;
    for (int x = 0; x < width; ++x) {
        const float& value = view.radiance[std::size_t(10 * width + x)].x;
        if (last != nullptr) {
            EXPECT_GE(value, *last - 1e-5F);
            EXPECT_LT(value - *last, 0.15F);  // no seam
        }
        last = &value;
    }
    EXPECT_NEAR(view.radiance[std::size_t(10 * width)].x, 0.0F, 1e-5F);
    EXPECT_NEAR(view.radiance[std::size_t(10 * width + width / 2)].x, 0.5F, 0.05F);
    EXPECT_NEAR(view.radiance[std::size_t(11 * width - 1)].x, 1.0F, 1e-5F);
}

TEST(ViewRenderer, GivesTheSameBitsOnAnyNumberOfThreads) {
    Stage stage;
    stage.city = cityWithGround();
    stage.vehicles.push_back(builtInVehicle("car").value());
    stage.place(0, {0, 0, 0}, nullptr);
    stage.build(Lighting{});
    Camera camera;
    camera.position = {5, -4, 1.6};
    camera.target = {0, 0, 0.6};
    setThreadLimit(1);
    const RenderedView one = render(stage, camera, 80, 45, 2);
    setThreadLimit(4);
    const RenderedView four = render(stage, camera, 80, 45, 2);
    setThreadLimit(0);
    EXPECT_EQ(one.radiance, four.radiance);
    EXPECT_EQ(one.reflector, four.reflector);
}

TEST(ViewRenderer, StopsWhenItIsCancelled) {
    Stage stage;
    stage.vehicles.push_back(mirrorBall());
    stage.place(0, {0, 0, 0}, nullptr);
    stage.build(night());
    std::stop_source stop;
    stop.request_stop();
    const auto view = renderView(*stage.scene, stage.bodies, ballCamera(), {},
                                 JobContext(nullptr, stop.get_token()));
    ASSERT_FALSE(view.has_value());
    EXPECT_EQ(view.error().code, ErrorCode::Cancelled);
}

TEST(ViewRenderer, RefusesViewsThatCannotBe) {
    Stage stage;
    stage.build(night());
    const auto codeOf = [&](const Camera& camera, const ViewSettings& settings) {
        const auto view = renderView(*stage.scene, {}, camera, settings, {});
        return view ? std::optional<ErrorCode>() : std::optional(view.error().code);
    };
    EXPECT_EQ(codeOf(Camera{}, {0, 10, 1}), ErrorCode::Usage);
    EXPECT_EQ(codeOf(Camera{}, {10, -1, 1}), ErrorCode::Usage);
    EXPECT_EQ(codeOf(Camera{}, {10, 10, 0}), ErrorCode::Usage);
    EXPECT_EQ(codeOf(Camera{}, {100000, 100000, 1}), ErrorCode::ResourceLimit);
    Camera nowhere;
    nowhere.target = nowhere.position;
    EXPECT_EQ(codeOf(nowhere, {10, 10, 1}), ErrorCode::Usage);
    Camera wide;
    wide.verticalFov = 4.0;
    EXPECT_EQ(codeOf(wide, {10, 10, 1}), ErrorCode::Usage);
    EXPECT_EQ(codeOf(Camera{}, {10, 10, 1}), std::nullopt);
}

}  // namespace
}  // namespace reflet
