// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/AmbientVolume.h"
#include "core/base/ParallelFor.h"
#include "tests/unit/baking/BakingScenes.h"

#include <atomic>

namespace reflet::testing {
namespace {

constexpr std::size_t kNodes = 20'000;
constexpr glm::vec3 kUp{0.0F, 0.0F, 1.0F};

AmbientVolume gathered(const RadianceScene& scene, std::size_t nodes = kNodes) {
    auto volume = gatherAmbient(scene, nodes, {});
    EXPECT_TRUE(volume.has_value());
    return volume ? std::move(*volume) : AmbientVolume{};
}

/// A level ground of one colour, 60 m across.
SceneBuilder ground(const glm::vec3& colour) {
    SceneBuilder b;
    const auto m = b.material("plain ground", colour);
    b.level(b.surface(b.object("ground", CityObjectType::TinRelief), m), -30, -30, 30, 30, 0);
    return b;
}

void expectNear(const glm::vec3& value, const glm::vec3& expected, float share) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(value[i], expected[i], share * expected[i] + 1e-5F) << "channel " << i;
    }
}

/// Nodes 2 m apart whose side s holds 1 + s + x + 10 y + 100 z.
AmbientVolume linearVolume() {
    AmbientVolume v;
    v.origin = {5.0, -3.0, 1.0};
    v.spacing = {2.0, 2.0, 4.0};
    v.columns = 4;
    v.rows = 3;
    v.layers = 3;
    for (int k = 0; k < v.layers; ++k) {
        for (int j = 0; j < v.rows; ++j) {
            for (int i = 0; i < v.columns; ++i) {
                for (int side = 0; side < 6; ++side) {
                    v.light.emplace_back(float(1 + side + 2 * i + 20 * j + 400 * k));
                }
            }
        }
    }
    return v;
}

TEST(AmbientVolume, BetweenNodesItIsLinear) {
    const AmbientVolume v = linearVolume();
    for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(1.3, 2.2, 5.0),
                                    glm::dvec3(6.0, 4.0, 8.0), glm::dvec3(5.9, 0.1, 7.7)}) {
        const double expected = 1.0 + 4.0 + offset.x + 10.0 * offset.y + 100.0 * offset.z;
        EXPECT_NEAR(v.at(v.origin + offset, kUp).r, expected, 1e-4 * expected);
    }
}

TEST(AmbientVolume, OutsideItIsAsAtItsNearestEdge) {
    const AmbientVolume v = linearVolume();
    EXPECT_EQ(v.at(v.origin - glm::dvec3(50.0, 0.0, 0.0), kUp), v.at(v.origin, kUp));
    EXPECT_EQ(v.at(v.origin + glm::dvec3(1e6), kUp),
              v.at(v.origin + glm::dvec3(6.0, 4.0, 8.0), kUp));
}

TEST(AmbientVolume, ANormalTakesTheSidesThatItFacesByItsSquares) {
    const AmbientVolume v = linearVolume();
    EXPECT_FLOAT_EQ(v.at(v.origin, {1.0F, 0.0F, 0.0F}).r, 1.0F);
    EXPECT_FLOAT_EQ(v.at(v.origin, {-1.0F, 0.0F, 0.0F}).r, 2.0F);
    EXPECT_FLOAT_EQ(v.at(v.origin, {0.0F, -1.0F, 0.0F}).r, 4.0F);
    const glm::vec3 slanted = glm::normalize(glm::vec3(1.0F, 0.0F, -2.0F));
    EXPECT_FLOAT_EQ(v.at(v.origin, slanted).r, 0.2F * 1.0F + 0.8F * 6.0F);
}

TEST(AmbientVolume, WithoutNodesItIsDark) {
    EXPECT_EQ(AmbientVolume{}.at({1.0, 2.0, 3.0}, kUp), glm::vec3(0.0F));
}

TEST(GatherAmbient, UnderTheOpenSkyALevelSurfaceGetsAllOfIt) {
    for (const double elevation : {60.0, 15.0, -40.0}) {
        const SceneBuilder b = ground(glm::vec3(0.5F));
        const auto scene = sceneOf(b.city, sunAt(elevation));
        expectNear(gathered(*scene).at({1.0, 2.0, 1.5}, kUp), scene->sky().ambient(kUp), 0.01F);
    }
}

TEST(GatherAmbient, OverBlackGroundAWallGetsTheUpperHalfOfTheSky) {
    const SceneBuilder b = ground(glm::vec3(0.0F));
    const auto scene = sceneOf(b.city, sunAt(-40.0));
    const AmbientVolume volume = gathered(*scene);
    for (const glm::vec3 normal : {glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, -1.0F, 0.0F)}) {
        const glm::dvec3 upper =
            skyOn(scene->sky(), glm::dvec3(normal), [](const glm::dvec3& d) { return d.z > 0.0; });
        // Ground more than 12 m away hides less and less: some haze comes through near the horizon.
        expectNear(volume.at({0.0, 0.0, 0.5}, normal), glm::vec3(upper), 0.1F);
    }
}

TEST(GatherAmbient, LookingDownOneSeesTheGroundInItsColour) {
    const SceneBuilder b = ground({0.6F, 0.3F, 0.1F});
    const auto scene = sceneOf(b.city, sunAt(50.0));
    const glm::vec3 below = gathered(*scene).at({0.0, 0.0, 0.4}, -kUp);
    // Sun and sky on the ground are about white: what comes up has the ratios of its colour.
    const glm::vec3 sun = scene->sky().sunRadiance() * float(std::sin(50.0 * kPi / 180.0));
    EXPECT_GT(below.r, 0.6F * sun.r);
    EXPECT_LT(below.r, 0.6F * (sun.r + scene->sky().ambient(kUp).r));
    const glm::vec3 light = below / glm::vec3(0.6F, 0.3F, 0.1F);
    EXPECT_NEAR(light.g / light.r, sun.g / sun.r, 0.2F);
}

TEST(GatherAmbient, InAClosedBlackRoomItIsDark) {
    SceneBuilder b = ground(glm::vec3(0.0F));
    const auto black = b.material("plain black", glm::vec3(0.0F));
    b.box(b.object("room", CityObjectType::Generic), {-4, -4, 0.5F}, {4, 4, 8.5F}, black);
    const auto scene = sceneOf(b.city, sunAt(50.0));
    const AmbientVolume volume = gathered(*scene);
    for (const glm::vec3& normal : {kUp, -kUp, glm::vec3(1.0F, 0.0F, 0.0F)}) {
        EXPECT_EQ(luminance(volume.at({0.0, 0.0, 4.5}, normal)), 0.0F);
    }
    EXPECT_GT(luminance(volume.at({20.0, 0.0, 4.5}, kUp)), 0.01F);
}

TEST(GatherAmbient, TheFootOfAnEndlessWallSeesHalfOfTheSky) {
    SceneBuilder b = ground(glm::vec3(0.0F));
    const auto black = b.material("plain black", glm::vec3(0.0F));
    const auto wall = b.surface(b.object("wall", CityObjectType::Generic), black);
    b.quad(wall, {-400, 0, 0}, {400, 0, 0}, {400, 0, 400}, {-400, 0, 400});
    b.level(b.surface(b.object("far", CityObjectType::TinRelief), black), -30, -90, 30, -30, 0);
    const auto scene = sceneOf(b.city, sunAt(-60.0));  // the same sky in every azimuth, no sun
    const AmbientVolume volume = gathered(*scene, 400'000);
    const float open = luminance(scene->sky().ambient(kUp));
    EXPECT_NEAR(luminance(volume.at({1.0, -1.0, 1.0}, kUp)) / open, 0.5F, 0.1F);
    EXPECT_NEAR(luminance(volume.at({1.0, -60.0, 1.0}, kUp)) / open, 1.0F, 0.02F);
}

TEST(GatherAmbient, WhatIsInsideAHouseOrInTheGroundTakesTheLightBesideIt) {
    SceneBuilder b = ground(glm::vec3(0.3F));
    const auto m = b.material("plain wall", glm::vec3(0.5F));
    b.box(b.object("house", CityObjectType::Building), {-9, -9, -1}, {9, 9, 12}, m);
    const auto scene = sceneOf(b.city, sunAt(50.0));
    const AmbientVolume volume = gathered(*scene);
    const float roof = luminance(volume.at({0.0, 0.0, 14.0}, kUp));
    for (const double z : {-1.0, 1.0, 6.0, 11.0}) {
        EXPECT_GT(luminance(volume.at({0.0, 0.0, z}, kUp)), 0.2F * roof) << z;
        EXPECT_LT(luminance(volume.at({0.0, 0.0, z}, kUp)), 1.05F * roof) << z;
    }
}

TEST(GatherAmbient, TheLatticeCoversTheCityAndKeepsToItsNodes) {
    const SceneBuilder b = ground(glm::vec3(0.3F));
    const auto scene = sceneOf(b.city, sunAt(50.0));
    for (const std::size_t limit : {std::size_t(8), std::size_t(500), std::size_t(30'000)}) {
        const AmbientVolume v = gathered(*scene, limit);
        EXPECT_LE(std::size_t(v.columns) * std::size_t(v.rows) * std::size_t(v.layers), limit);
        EXPECT_EQ(v.light.size(),
                  6 * std::size_t(v.columns) * std::size_t(v.rows) * std::size_t(v.layers));
        EXPECT_LE(v.origin.x, -30.0);
        EXPECT_GE(v.origin.x + v.spacing.x * (v.columns - 1), 30.0);
    }
}

TEST(GatherAmbient, AnyNumberOfThreadsGivesTheSame) {
    SceneBuilder b = ground(glm::vec3(0.3F));
    b.box(b.object("house", CityObjectType::Building), {-9, -9, -1}, {9, 9, 12});
    const auto scene = sceneOf(b.city, sunAt(35.0));
    setThreadLimit(1);
    const AmbientVolume one = gathered(*scene, 3000);
    setThreadLimit(4);
    const AmbientVolume four = gathered(*scene, 3000);
    setThreadLimit(0);
    EXPECT_EQ(one.light, four.light);
}

TEST(GatherAmbient, AnEmptyCityHasTheOpenSky) {
    const CityModel empty;
    const auto scene = sceneOf(empty, sunAt(35.0));
    const AmbientVolume volume = gathered(*scene);
    expectNear(volume.at({0.0, 0.0, 0.0}, kUp), scene->sky().ambient(kUp), 0.01F);
}

TEST(GatherAmbient, ACancelledJobReturnsSo) {
    const SceneBuilder b = ground(glm::vec3(0.3F));
    const auto scene = sceneOf(b.city, sunAt(35.0));
    std::stop_source stop;
    stop.request_stop();
    const auto volume = gatherAmbient(*scene, kNodes, JobContext({}, stop.get_token()));
    ASSERT_FALSE(volume.has_value());
    EXPECT_EQ(volume.error().code, ErrorCode::Cancelled);
}

TEST(GatherAmbient, ProgressGrowsToOne) {
    const SceneBuilder b = ground(glm::vec3(0.3F));
    const auto scene = sceneOf(b.city, sunAt(35.0));
    std::atomic<double> most{0.0};
    const JobContext job(
        [&](double fraction, const std::string&) {
            double known = most;
            while (fraction > known && !most.compare_exchange_weak(known, fraction)) {
            }
        },
        {});
    EXPECT_TRUE(gatherAmbient(*scene, 2000, job).has_value());
    EXPECT_DOUBLE_EQ(most, 1.0);
}

}  // namespace
}  // namespace reflet::testing
