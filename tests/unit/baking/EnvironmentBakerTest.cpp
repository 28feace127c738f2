// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/EnvironmentBaker.h"
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "tests/unit/baking/BakingScenes.h"

#include <cstring>
#include <mutex>

namespace reflet::testing {
namespace {

const BakeSettings kSmall{32, 2};

/// A street between two rows of houses.
SceneBuilder street() {
    SceneBuilder b;
    b.level(b.surface(b.object("road", CityObjectType::Road)), -80, -40, 80, 40, 0);
    for (int i = 0; i < 6; ++i) {
        const float x = -60.0F + 20.0F * float(i);
        b.box(b.object("n" + std::to_string(i), CityObjectType::Building), {x, 8, 0},
              {x + 17, 20, 9.0F + float(i)});
        b.box(b.object("s" + std::to_string(i), CityObjectType::Building), {x, -20, 0},
              {x + 19, -8, 12.0F - float(i)});
    }
    return b;
}

Heightfield flatGround(float height) {
    Heightfield field;
    field.grid.x0 = -100.0;
    field.grid.y0 = -100.0;
    field.grid.columns = 200;
    field.grid.rows = 200;
    field.ground.assign(field.grid.cellCount(), height);
    field.topMax = field.topCenter = field.ground;
    return field;
}

ReferenceEnvironmentMap bake(const RadianceScene& scene, const glm::dvec3& at,
                             const BakeSettings& settings = kSmall) {
    auto map = bakeEnvironmentMap(scene, nullptr, "rem", at, settings, {});
    EXPECT_TRUE(map.has_value()) << (map ? "" : map.error().message());
    return map ? *std::move(map) : ReferenceEnvironmentMap{};
}

bool sameBits(const ReferenceEnvironmentMap& a, const ReferenceEnvironmentMap& b) {
    const auto& ra = a.radiance.texels();
    const auto& rb = b.radiance.texels();
    const auto& da = a.distance.texels();
    const auto& db = b.distance.texels();
    return ra.size() == rb.size() && da.size() == db.size() &&
           std::memcmp(ra.data(), rb.data(), ra.size() * sizeof(ra[0])) == 0 &&
           std::memcmp(da.data(), db.data(), da.size() * sizeof(da[0])) == 0;
}

TEST(EnvironmentBaker, DistancesInABoxRoomAreThoseOfTheSlabs) {
    SceneBuilder b;
    const glm::dvec3 low(-4, -7, 0);
    const glm::dvec3 high(9, 6, 5);
    b.box(b.object("room", CityObjectType::Generic), glm::vec3(low), glm::vec3(high));
    const auto scene = sceneOf(b.city, sunAt(45));
    const glm::dvec3 eye(1.25, -2.5, 1.6);
    const auto map = bake(*scene, eye);
    ASSERT_EQ(map.distance.resolution(), 32);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < 32; ++row) {
            for (int column = 0; column < 32; ++column) {
                const glm::dvec3 d = glm::normalize(texelDirection(32, face, column, row));
                double nearest = 1e9;
                for (int i = 0; i < 3; ++i) {
                    if (std::abs(d[i]) > 1e-12) {
                        nearest =
                            std::min(nearest, ((d[i] > 0 ? high[i] : low[i]) - eye[i]) / d[i]);
                    }
                }
                ASSERT_NEAR(map.distance.at(face, column, row), nearest, 2e-5 * nearest)
                    << face << " " << column << " " << row;
            }
        }
    }
    EXPECT_EQ(map.id, "rem");
    EXPECT_EQ(map.center, eye);
}

TEST(EnvironmentBaker, ADistanceIsNeverAveragedAcrossAnEdge) {
    SceneBuilder b;
    b.box(b.object("room", CityObjectType::Generic), {-50, -50, -50}, {50, 50, 50});
    b.quad(b.surface(b.object("card", CityObjectType::Generic)), {4, -1.1F, -0.9F},
           {4, 1.3F, -0.9F}, {4, 1.3F, 1.2F}, {4, -1.1F, 1.2F});
    const auto map = bake(*sceneOf(b.city, sunAt(45)), {0, 0, 0}, {64, 3});
    int card = 0;
    for (int row = 0; row < 64; ++row) {
        for (int column = 0; column < 64; ++column) {
            const glm::dvec3 d = texelDirection(64, 0, column, row);  // 1 along +x
            const double length = glm::length(d);
            const bool onCard = 4 * d.y > -1.1 && 4 * d.y < 1.3 && 4 * d.z > -0.9 && 4 * d.z < 1.2;
            EXPECT_NEAR(map.distance.at(0, column, row), (onCard ? 4 : 50) * length, 1e-3);
            card += onCard ? 1 : 0;
        }
    }
    EXPECT_GT(card, 200);
}

TEST(EnvironmentBaker, RadianceIsTheMeanOfTheShadesOnASubGrid) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45, 170));
    const auto map = bake(*scene, {1.5, 0.5, 1.7}, {32, 2});
    const float spread = float(0.5 * kPi / 32 / 2);
    std::size_t close = 0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 32; ++i) {
            const int column = (7 * i + face) % 32;
            glm::vec3 sum(0.0F);
            for (int k = 0; k < 4; ++k) {
                const glm::dvec2 st(2.0 * (column + 0.25 + 0.5 * (k & 1)) / 32 - 1.0,
                                    2.0 * (i + 0.25 + 0.5 * (k >> 1)) / 32 - 1.0);
                const glm::vec3 eye(1.5F, 0.5F, 1.7F);
                const glm::vec3 d(glm::normalize(faceDirection(face, st)));
                sum += scene->shade(scene->intersect(eye, d), eye, d, spread);
            }
            close += glm::distance(0.25F * sum, map.radiance.at(face, column, i)) < 2e-3F ? 1U : 0U;
        }
    }
    EXPECT_GE(close, 6U * 32U - 4U);  // a packet's ray may fall to the other side of an edge
}

TEST(EnvironmentBaker, ThreadsDoNotChangeABit) {
    const SceneBuilder b = street();
    const glm::dvec3 at(3.3, 0.4, 1.7);
    setThreadLimit(1);
    const auto scene = sceneOf(b.city, sunAt(45, 170));
    const auto alone = bake(*scene, at, {40, 2});
    setThreadLimit(4);
    const auto other = sceneOf(b.city, sunAt(45, 170));
    (void)bake(*other, at + glm::dvec3(9, 0, 0), {40, 2});  // fills the cache from elsewhere
    const auto together = bake(*other, at, {40, 2});
    const auto again = bake(*scene, at, {40, 2});
    setThreadLimit(0);
    EXPECT_TRUE(sameBits(alone, together));
    EXPECT_TRUE(sameBits(alone, again));
}

TEST(EnvironmentBaker, EverythingBakedIsFiniteAndNeverNegative) {
    SceneBuilder b = street();
    b.triangle(0, {0, 0, 3}, {0, 0, 3}, {0, 0, 3});
    for (const double elevation : {60.0, 3.0, -10.0}) {
        const auto map = bake(*sceneOf(b.city, sunAt(elevation)), {0, 0, 1.7}, {64, 1});
        std::size_t sky = 0;
        std::size_t lit = 0;
        for (std::size_t i = 0; i < map.radiance.texels().size(); ++i) {
            const glm::vec3& c = map.radiance.texels()[i];
            const float distance = map.distance.texels()[i];
            ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
            ASSERT_TRUE(c.r >= 0.0F && c.g >= 0.0F && c.b >= 0.0F);
            ASSERT_TRUE(distance > 0.0F);
            sky += std::isinf(distance) ? 1U : 0U;
            lit += luminance(c) > 0.0F ? 1U : 0U;
        }
        EXPECT_GT(sky, 1000U);
        EXPECT_EQ(lit, map.radiance.texels().size());
    }
}

TEST(EnvironmentBaker, ASurfacePointHasTheSameRadianceInTwoMaps) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45, 170));
    const glm::dvec3 centerA(-4, 0, 1.7);
    const glm::dvec3 centerB(4, 0, 1.7);
    const auto a = bake(*scene, centerA, {256, 2});
    const auto c = bake(*scene, centerB, {256, 2});
    double error = 0.0;
    int points = 0;
    for (double x = -15.5; x < 15.5; x += 0.37) {
        for (double z = 0.3; z < 8.0; z += 0.37) {
            const glm::dvec3 p(x, 8.0, z);
            const double distance =
                a.distance.at(facePoint(p - centerA).face, texelAt(256, p - centerA).column,
                              texelAt(256, p - centerA).row);
            if (std::abs(distance - glm::distance(p, centerA)) > 0.3) {
                continue;  // a gap between two houses
            }
            const glm::vec3 one = sampleBilinear(a.radiance, p - centerA);
            const glm::vec3 two = sampleBilinear(c.radiance, p - centerB);
            error += std::abs(luminance(one) - luminance(two));
            ++points;
        }
    }
    ASSERT_GT(points, 1000);
    EXPECT_LT(error / points, 0.02);  // of a white square in the sun
}

TEST(EnvironmentBaker, ResolutionsOutOfRangeAreRefusedAsUsage) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45));
    for (const BakeSettings& settings :
         {BakeSettings{31, 2}, BakeSettings{2049, 2}, BakeSettings{0, 2}, BakeSettings{-128, 2},
          BakeSettings{128, 0}, BakeSettings{128, 99}}) {
        const auto map = bakeEnvironmentMap(*scene, nullptr, "rem", {0, 0, 1.7}, settings, {});
        ASSERT_FALSE(map.has_value());
        EXPECT_EQ(map.error().code, ErrorCode::Usage);
        EXPECT_EQ(map.error().subject, "rem");
        EXPECT_FALSE(map.error().remedy.empty());
    }
}

TEST(EnvironmentBaker, APositionInsideABuildingIsRefusedAndAFreeOneNamed) {
    SceneBuilder b = street();
    b.city.frame.origin = {90000.0, 435000.0, 0.0};
    const auto scene = sceneOf(b.city, sunAt(45));
    const Heightfield ground = flatGround(0.0F);
    const glm::dvec3 inside(8.0, 10.5, 1.7);  // 2.5 m behind the northern front
    const auto map = bakeEnvironmentMap(*scene, &ground, "rem-3", inside, kSmall, {});
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::Refused);
    EXPECT_NE(map.error().what.find("inside a building"), std::string::npos);
    EXPECT_EQ(map.error().subject, "rem-3");
    const auto free = nearestFreePosition(*scene, &ground, inside);
    ASSERT_TRUE(free.has_value());
    EXPECT_LT(glm::distance(*free, inside), 3.6);
    EXPECT_LT(free->y, 8.0) << "out on the street";
    EXPECT_NEAR(free->z, 1.7, 1e-9);
    EXPECT_NE(map.error().remedy.find(std::to_string(int(90000.0 + free->x))), std::string::npos)
        << map.error().remedy;
    EXPECT_TRUE(bakeEnvironmentMap(*scene, &ground, "rem-3", *free, kSmall, {}).has_value());
}

TEST(EnvironmentBaker, APositionBelowTheGroundIsRefusedAndTheWayUpNamed) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45));
    const Heightfield ground = flatGround(0.0F);
    const auto map = bakeEnvironmentMap(*scene, &ground, "rem", {0, 0, -1.5}, kSmall, {});
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::Refused);
    EXPECT_NE(map.error().what.find("1.50 m below the ground"), std::string::npos)
        << map.error().what;
    const auto free = nearestFreePosition(*scene, &ground, {0, 0, -1.5});
    ASSERT_TRUE(free.has_value());
    EXPECT_EQ(glm::dvec2(*free), glm::dvec2(0.0));
    EXPECT_GT(free->z, 0.0);
    EXPECT_LT(free->z, 1.0);
    EXPECT_TRUE(bakeEnvironmentMap(*scene, nullptr, "rem", {0, 0, -1.5}, kSmall, {}).has_value())
        << "without a heightfield nobody knows";
}

TEST(EnvironmentBaker, DeepInABlockNoPlaceIsOffered) {
    SceneBuilder b;
    b.box(b.object("hall", CityObjectType::Building), {-40, -40, 0}, {40, 40, 40});
    const auto scene = sceneOf(b.city, sunAt(45));
    EXPECT_FALSE(nearestFreePosition(*scene, nullptr, {0, 0, 2}).has_value());
    const auto map = bakeEnvironmentMap(*scene, nullptr, "rem", {0, 0, 2}, kSmall, {});
    ASSERT_FALSE(map.has_value());
    EXPECT_NE(map.error().remedy.find("no free place"), std::string::npos);
}

TEST(EnvironmentBaker, APositionThatIsNotANumberIsRefused) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45));
    const auto map = bakeEnvironmentMap(*scene, nullptr, "rem", {0, std::nan(""), 2}, kSmall, {});
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::Refused);
}

TEST(EnvironmentBaker, ACancelledBakeStopsAndSaysSo) {
    const SceneBuilder b = street();
    const auto scene = sceneOf(b.city, sunAt(45));
    std::stop_source stop;
    double last = 0.0;
    std::mutex mutex;
    const JobContext job(
        [&](double fraction, const std::string&) {
            const std::scoped_lock lock(mutex);
            last = std::max(last, fraction);
            stop.request_stop();
        },
        stop.get_token());
    const auto map = bakeEnvironmentMap(*scene, nullptr, "rem", {0, 0, 1.7}, {256, 2}, job);
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::Cancelled);
    EXPECT_GT(last, 0.0);
}

}  // namespace
}  // namespace reflet::testing
