// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"
#include "tests/gpu/CityPictures.h"

namespace reflet::test {
namespace {

using testing::SceneBuilder;
using testing::sunAt;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

CityView viewFrom(const glm::dvec3& eye, const glm::dvec3& target, int width = kWidth,
                  int height = kHeight) {
    CityView view = cityView({eye, target, 0.9}, width, height);
    view.spread = kViewSpread;
    return view;
}

void expectNear(const glm::vec3& value, const glm::vec3& expected, float share) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(value[i], expected[i], share * expected[i] + 1e-4F) << "channel " << i;
    }
}

SceneBuilder plainGround(const glm::vec3& colour) {
    SceneBuilder b;
    const auto m = b.material("plain ground", colour);
    b.level(b.surface(b.object("ground", CityObjectType::Generic), m), -400, -400, 400, 400, 0);
    return b;
}

/// A street of houses with façades between pavements and lawns, under a low roof of tiles.
SceneBuilder street() {
    SceneBuilder b;
    const auto ground = [&](CityObjectType type, SurfaceType surface, float x0, float x1) {
        const auto id = "strip" + std::to_string(int(x0));
        b.level(b.surface(b.object(id, type), kNone, surface), x0, -60, x1, 120, 0);
    };
    ground(CityObjectType::LandUse, SurfaceType::Unknown, -60, -9);
    ground(CityObjectType::Road, SurfaceType::AuxiliaryTrafficArea, -9, -5);
    ground(CityObjectType::Road, SurfaceType::TrafficArea, -5, 5);
    ground(CityObjectType::TransportSquare, SurfaceType::Unknown, 5, 9);
    ground(CityObjectType::PlantCover, SurfaceType::Unknown, 9, 60);
    for (int i = 0; i < 7; ++i) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto house = b.object("house" + std::to_string(i) + (side < 0 ? "w" : "e"),
                                        CityObjectType::Building);
            const float y = -30.0F + 15.0F * float(i);
            const float x0 = side < 0 ? -22.0F : 9.0F;
            b.box(house, {x0, y, 0}, {x0 + 13.0F, y + 14.0F, 9.0F + 2.7F * float((i * 5) % 8)});
        }
    }
    return b;
}

using CityPassTest = CityPictures;

TEST_F(CityPassTest, WithoutACityTheSkyOfTheCpuIsSeen) {
    for (const double elevation : {60.0, 5.0, -20.0}) {
        const Lighting lighting = sunAt(elevation, 140.0);
        m_pass->setLighting(lighting);
        const Sky sky(lighting);
        for (int face = 0; face < 6; ++face) {
            const RadiancePicture seen = drawn(cityFaceView({3.0, 4.0, 5.0}, face, 32));
            double error = 0.0;
            double sum = 0.0;
            for (int row = 0; row < 32; ++row) {
                for (int column = 0; column < 32; ++column) {
                    const glm::vec3 expected = sky.radiance(
                        glm::vec3(glm::normalize(texelDirection(32, face, column, row))));
                    error += glm::length(seen.at(column, 31 - row) - expected);
                    sum += glm::length(expected);
                }
            }
            EXPECT_LT(error, 0.01 * sum) << "face " << face << " at " << elevation;
            EXPECT_EQ(seen.distance.front(), kInfinity);
        }
    }
}

TEST_F(CityPassTest, ACityOfNoTrianglesIsAllSky) {
    CityModel empty;
    show(empty, sunAt(40.0));
    const RadiancePicture seen = drawn(viewFrom({0, 0, 2}, {10, 0, 3}));
    EXPECT_EQ(m_statistics.triangles, 0U);
    EXPECT_EQ(seen.distance, std::vector<float>(seen.distance.size(), kInfinity));
}

TEST_F(CityPassTest, BrokenTrianglesAreLeftOut) {
    SceneBuilder b = plainGround(glm::vec3(0.5F));
    const std::size_t sound = b.city.triangles.size();
    b.city.triangles.push_back({{0, 1, 999'999}, 0});
    b.city.triangles.push_back({{0, 0, 1}, 0});
    b.city.vertices.emplace_back(std::nanf(""), 0.0F, 0.0F);
    b.city.triangles.push_back({{0, 1, std::uint32_t(b.city.vertices.size() - 1)}, 0});
    b.city.triangles.push_back({{0, 1, 2}, 999'999});
    show(b.city, sunAt(40.0));
    (void)drawn(viewFrom({0, 0, 9}, {1, 0, 0}));
    EXPECT_EQ(m_statistics.triangles, sound + 1) << "one has no surface, but a place";
}

TEST_F(CityPassTest, AnOpenPlaneSendsBackSunAndSkyByItsColour) {
    const glm::vec3 colour{0.7F, 0.4F, 0.2F};
    for (const double elevation : {65.0, 30.0, 8.0, -30.0}) {
        show(plainGround(colour).city, sunAt(elevation));
        const Sky& sky = m_scene->sky();
        const glm::vec3 light =
            sky.ambient({0, 0, 1}) +
            sky.sunRadiance() * float(std::max(std::sin(elevation * kPi / 180.0), 0.0));
        const RadiancePicture seen = drawn(viewFrom({0, 0, 3}, {4, 3, 0}));
        expectNear(seen.at(kWidth / 2, kHeight / 2), colour * light, 0.01F);
        expectNear(seen.at(5, kHeight - 5), colour * light, 0.01F);
    }
}

TEST_F(CityPassTest, DistancesAreEuclideanFromTheEye) {
    SceneBuilder b = plainGround(glm::vec3(0.5F));
    b.box(b.object("box", CityObjectType::Generic), {10, -4, 0}, {14, 4, 6});
    show(b.city, sunAt(40.0));
    const CityView view = viewFrom({0, 1, 3}, {12, 0, 2});
    const RadiancePicture seen = drawn(view);
    const RadiancePicture truth = traced(view);
    std::size_t close = 0;
    for (std::size_t i = 0; i < seen.distance.size(); ++i) {
        close += seen.distance[i] == truth.distance[i] ||
                 std::abs(seen.distance[i] - truth.distance[i]) < 1e-4F * truth.distance[i];
    }
    EXPECT_GT(double(close), 0.99 * double(seen.distance.size())) << "all but pixels of edges";
}

TEST_F(CityPassTest, FacesOfACubeAreThoseOfTheCpu) {
    SceneBuilder b = plainGround(glm::vec3(0.3F));
    const auto tower = [&](const char* name, const glm::vec3& at, const glm::vec3& colour) {
        b.box(b.object(name, CityObjectType::Generic), at, at + glm::vec3(3, 3, 9),
              b.material(name, colour));
    };
    tower("plain red", {8, 0, 0}, {0.8F, 0.05F, 0.05F});
    tower("plain green", {-9, -2, 0}, {0.05F, 0.8F, 0.05F});
    tower("plain blue", {1, 7, 0}, {0.05F, 0.05F, 0.8F});
    tower("plain white", {-2, -9, 2}, {0.8F, 0.8F, 0.8F});
    show(b.city, sunAt(50.0, 130.0));
    gatherLight(50'000);
    const glm::dvec3 center{0.4, 0.2, 3.0};
    constexpr int kEdge = 48;
    for (int face = 0; face < 6; ++face) {
        const CityView view = cityFaceView(center, face, kEdge);
        const RadiancePicture seen = drawn(view);
        RadiancePicture truth{kEdge, kEdge, {}, {}};
        for (int row = kEdge - 1; row >= 0; --row) {  // the target's first row lies at the bottom
            for (int column = 0; column < kEdge; ++column) {
                const glm::vec3 d(glm::normalize(texelDirection(kEdge, face, column, row)));
                const glm::vec3 eye(center);
                truth.radiance.push_back(
                    m_scene->shade(m_scene->intersect(eye, d), eye, d, view.spread));
            }
        }
        EXPECT_GT(decibels(seen, truth), 28.0) << "face " << face;
    }
}

TEST_F(CityPassTest, AStreetLooksAsItIsBaked) {
    show(street().city, sunAt(48.0, 215.0));
    gatherLight(60'000);
    for (const auto& [eye, target] :
         {std::pair{glm::dvec3(1.0, -25.0, 1.7), glm::dvec3(-6.0, 10.0, 6.0)},
          std::pair{glm::dvec3(-3.0, 20.0, 1.7), glm::dvec3(9.0, 34.0, 4.0)},
          std::pair{glm::dvec3(40.0, -50.0, 60.0), glm::dvec3(0.0, 20.0, 0.0)}}) {
        const CityView view = viewFrom(eye, target, 320, 200);
        EXPECT_GT(decibels(drawn(view), traced(view)), 28.0) << eye.x << ' ' << eye.y;
    }
}

TEST_F(CityPassTest, AtNightTheSameWindowsAreLit) {
    show(street().city, sunAt(-25.0, 215.0));
    gatherLight(60'000);
    const CityView view = viewFrom({1.0, -25.0, 1.7}, {-6.0, 10.0, 6.0}, 320, 200);
    const RadiancePicture seen = drawn(view);
    EXPECT_GT(decibels(seen, traced(view)), 28.0);
    const auto lit = std::count_if(seen.radiance.begin(), seen.radiance.end(),
                                   [](const glm::vec3& r) { return r.r > 0.25F; });
    EXPECT_GT(lit, 100);
}

TEST_F(CityPassTest, LeavingOutSmallPartsIsNotSeen) {
    SceneBuilder b = street();
    for (int i = 0; i < 400; ++i) {
        const float x = -4.9F + 0.17F * float((i * 37) % 57);
        const float y = -50.0F + 0.4F * float(i);
        const float size = 0.02F + 0.001F * float(i % 90);
        b.box(b.object("stone" + std::to_string(i), CityObjectType::CityFurniture), {x, y, 0},
              {x + size, y + size, size});
    }
    show(b.city, sunAt(48.0, 215.0));
    CityView view = viewFrom({1.0, -55.0, 3.0}, {0.0, 30.0, 0.0}, 640, 400);
    const RadiancePicture culled = drawn(view);
    const std::size_t fewer = m_statistics.triangles;
    view.smallestPart = 0.0F;
    const RadiancePicture whole = drawn(view);
    EXPECT_LT(fewer, m_statistics.triangles) << "something is left out at all";
    EXPECT_GT(decibels(culled, whole), 42.0);
}

TEST_F(CityPassTest, WhatLiesBehindTheCameraIsNotHandedOver) {
    show(street().city, sunAt(48.0));
    (void)drawn(viewFrom({0, 200, 2}, {0, 300, 2}));
    EXPECT_EQ(m_statistics.triangles, 0U);
}

}  // namespace
}  // namespace reflet::test
