// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SurfaceLook.h"
#include "tests/unit/baking/BakingScenes.h"

namespace reflet::testing {
namespace {

constexpr float kAlbedo = 0.5F;

/// A wide level ground of one plain colour.
SceneBuilder plain(const glm::vec3& colour = glm::vec3(kAlbedo)) {
    SceneBuilder b;
    const auto m = b.material("plain ground", colour);
    b.level(b.surface(b.object("ground", CityObjectType::Generic), m), -500, -500, 500, 500, 0);
    return b;
}

TEST(RadianceScene, AGeneratedGroundIsWornAsphaltThatIsLighterThanItsShadows) {
    SceneBuilder b;
    b.level(b.surface(b.object("house", CityObjectType::Building), b.material("roof", {})), 0, 0,
            10, 10, 6);
    CityModel city = b.city;
    ASSERT_TRUE(addGeneratedGround(city, 50.0));
    const SurfaceLook look = SurfaceLooks(city).surface(city.triangles.back().surface);
    EXPECT_EQ(look.kind, LookKind::Asphalt) << "with grain and seams, not one plain colour";
    for (int k = 0; k < 3; ++k) {
        EXPECT_GT(look.colour[k], 0.15F);
        EXPECT_LT(look.colour[k], 0.30F);
    }
}

TEST(RadianceScene, AnOpenLevelPlaneSendsBackSunAndSkyByItsAlbedo) {
    const SceneBuilder b = plain({0.7F, 0.4F, 0.2F});
    for (const double elevation : {65.0, 30.0, 8.0}) {
        const auto scene = sceneOf(b.city, sunAt(elevation));
        const Sky& sky = scene->sky();
        const glm::dvec3 light = skyOn(sky, {0, 0, 1}) +
                                 glm::dvec3(sky.sunRadiance()) * std::sin(elevation * kPi / 180.0);
        const glm::vec3 seen = look(*scene, {3, 2, 9}, {1, 1, 0});
        EXPECT_NEAR(seen.r, 0.7 * light.r, 0.015 * 0.7 * light.r);
        EXPECT_NEAR(seen.g, 0.4 * light.g, 0.015 * 0.4 * light.g);
        EXPECT_NEAR(seen.b, 0.2 * light.b, 0.015 * 0.2 * light.b);
    }
}

TEST(RadianceScene, ASunShadowEndsWhereTheHeightAndTheElevationSay) {
    SceneBuilder b = plain();
    const auto m = b.material("plain black", glm::vec3(0.0F));
    b.box(b.object("tower", CityObjectType::Generic), {-2, 0, 0}, {2, 2, 10}, m);
    const double elevation = 35.0;
    const auto scene = sceneOf(b.city, sunAt(elevation, 180.0));        // the sun in the south
    const double tip = 2.0 + 10.0 / std::tan(elevation * kPi / 180.0);  // the shadow falls north
    const auto at = [&](double x, double y) {
        return look(*scene, {float(x), float(y), 3.0F}, {float(x), float(y), 0.0F});
    };
    const glm::vec3 sun =
        kAlbedo * scene->sky().sunRadiance() * float(std::sin(elevation * kPi / 180.0));
    for (const auto& [lit, shaded] :
         {std::pair{at(0.3, tip + 0.02), at(0.3, tip - 0.02)},
          std::pair{at(2.02, 9.0), at(1.98, 9.0)}, std::pair{at(-2.02, 9.0), at(-1.98, 9.0)}}) {
        // The two places are 4 cm apart, so that only the sun can differ.
        EXPECT_NEAR(lit.r - shaded.r, sun.r, 0.03F * sun.r);
        EXPECT_NEAR(lit.g - shaded.g, sun.g, 0.03F * sun.g);
        EXPECT_NEAR(lit.b - shaded.b, sun.b, 0.03F * sun.b);
    }
}

TEST(RadianceScene, TheFootOfAnEndlessWallSeesHalfOfTheSky) {
    SceneBuilder b = plain();
    const auto black = b.material("plain black", glm::vec3(0.0F));
    const auto wall = b.surface(b.object("wall", CityObjectType::Generic), black);
    b.quad(wall, {-400, 0, 0}, {400, 0, 0}, {400, 0, 400}, {-400, 0, 400});
    // Deep night: the same sky in every azimuth, and no sun.
    const auto scene = sceneOf(b.city, sunAt(-60.0));
    const float open = kAlbedo * luminance(scene->sky().ambient({0, 0, 1}));
    const auto brightnessAt = [&](float y) {
        return luminance(look(*scene, {1.3F, y, 2.0F}, {1.3F, y, 0.0F})) / open;
    };
    EXPECT_NEAR(brightnessAt(-0.05F), 0.5F, 0.04F);
    EXPECT_NEAR(brightnessAt(0.05F), 0.5F, 0.04F);
    EXPECT_NEAR(brightnessAt(-200.0F), 1.0F, 0.02F) << "far away it does not matter";
    // In between the light grows steadily.
    float before = 0.0F;
    for (float y = -0.1F; y > -24.0F; y -= 0.7F) {
        const float now = brightnessAt(y);
        EXPECT_GT(now, before - 0.02F) << y;
        before = std::max(before, now);
    }
}

TEST(RadianceScene, ASunlitWallThrowsItsColourOnTheGroundBeforeIt) {
    SceneBuilder red = plain();
    SceneBuilder black = red;
    for (auto* b : {&red, &black}) {
        const auto m =
            b->material("plain wall", b == &red ? glm::vec3(0.8F, 0.05F, 0.05F) : glm::vec3(0.0F));
        b->quad(b->surface(b->object("wall", CityObjectType::Generic), m), {-20, 0, 0}, {20, 0, 0},
                {20, 0, 15}, {-20, 0, 15});
    }
    const Lighting south = sunAt(40.0, 180.0);
    const auto withRed = sceneOf(red.city, south);
    const auto withBlack = sceneOf(black.city, south);
    const glm::vec3 gain =
        look(*withRed, {0, -1, 2}, {0, -1, 0}) - look(*withBlack, {0, -1, 2}, {0, -1, 0});
    EXPECT_GT(gain.r, 0.03F);
    EXPECT_LT(gain.g, 0.15F * gain.r);
}

TEST(RadianceScene, APointOfTheCityLooksTheSameFromEverywhere) {
    SceneBuilder b = plain();
    b.box(b.object("house", CityObjectType::Building), {-10, 10, 0}, {10, 20, 14});
    b.box(b.object("other", CityObjectType::Building), {-10, -20, 0}, {4, -12, 9});
    const auto scene = sceneOf(b.city, sunAt(40.0, 200.0));
    constexpr float kFine = 1e-7F;  // both see the point itself
    std::size_t compared = 0;
    std::size_t different = 0;
    float least = 1e9F;
    float most = 0.0F;
    for (float x = -9.37F; x < 9.5F; x += 0.61F) {
        for (float z = 0.43F; z < 13.9F; z += 0.53F) {
            const glm::vec3 a = look(*scene, {-6, -6, 2}, {x, 10, z}, kFine);
            const glm::vec3 c = look(*scene, {8, 3, 3}, {x, 10, z}, kFine);
            // Rounding moves the hit by micrometres, which matters on the edge of a window only.
            different += glm::distance(a, c) > 0.01F * luminance(a) + 1e-4F ? 1U : 0U;
            ++compared;
            least = std::min(least, luminance(a));
            most = std::max(most, luminance(a));
        }
    }
    EXPECT_GT(compared, 700U);
    EXPECT_LT(different, compared / 200);
    EXPECT_GT(most, 3.0F * least) << "a façade has dark windows in a light wall";
}

TEST(RadianceScene, AWallInLooseTrianglesHasTheWindowsOfAWallInOnePiece) {
    SceneBuilder whole = plain();
    whole.box(whole.object("house", CityObjectType::Building), {-10, 10, 0}, {10, 20, 14});
    SceneBuilder loose = whole;
    for (CityTriangle& triangle : loose.city.triangles) {
        loose.city.surfaces.push_back(loose.city.surfaces[triangle.surface]);
        triangle.surface = std::uint32_t(loose.city.surfaces.size() - 1);
    }
    const auto expected = sceneOf(whole.city, sunAt(40.0, 200.0));
    const auto actual = sceneOf(loose.city, sunAt(40.0, 200.0));
    std::size_t compared = 0;
    std::size_t different = 0;
    for (float x = -9.37F; x < 9.5F; x += 0.61F) {
        for (float z = 0.43F; z < 13.9F; z += 0.53F) {
            const float a = luminance(look(*expected, {0, -8, 4}, {x, 10, z}));
            const float b = luminance(look(*actual, {0, -8, 4}, {x, 10, z}));
            // Ambient light is kept on a lattice of each surface: it may differ by a little.
            different += std::abs(a - b) > 0.1F * a ? 1U : 0U;
            ++compared;
        }
    }
    EXPECT_GT(compared, 700U);
    EXPECT_LT(different, compared / 50);
}

TEST(RadianceScene, FarAwayAFacadeHasTheMeanOfWhatItHasNearBy) {
    SceneBuilder b = plain();
    b.box(b.object("house", CityObjectType::Building), {-15, 10, 0}, {15, 20, 16});
    const auto scene = sceneOf(b.city, sunAt(40.0, 90.0));  // the wall in even shade
    // 8 m × 6 m of the wall's middle: fine samples, and coarse ones that see 1.6 m each.
    const auto meanOf = [&](int columns, int rows, float footprint) {
        glm::dvec3 sum(0.0);
        const glm::vec3 eye(0, -100, 8);
        for (int i = 0; i < columns; ++i) {
            for (int j = 0; j < rows; ++j) {
                const glm::vec3 at(-4.0F + 8.0F * (float(i) + 0.5F) / float(columns), 10.0F,
                                   5.0F + 6.0F * (float(j) + 0.5F) / float(rows));
                sum += glm::dvec3(look(*scene, eye, at, footprint / glm::distance(eye, at)));
            }
        }
        return sum / double(columns * rows);
    };
    const glm::dvec3 fine = meanOf(400, 300, 0.02F);
    const glm::dvec3 coarse = meanOf(5, 4, 1.5F);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(coarse[i], fine[i], 0.06 * fine[i]);
    }
}

TEST(RadianceScene, LightOnAVehicleIsSunAndSkyUnlessSomethingStandsInTheWay) {
    SceneBuilder b = plain();
    const auto open = sceneOf(b.city, sunAt(50.0));
    const glm::dvec3 expected =
        skyOn(open->sky(), {0, 0, 1}) +
        glm::dvec3(open->sky().sunRadiance()) * std::sin(50.0 * kPi / 180.0);
    const glm::vec3 light = open->diffuseLight({0, 0, 1.5F}, {0, 0, 1});
    EXPECT_NEAR(light.g, expected.g, 0.03 * expected.g);

    const std::vector<glm::vec3> roof{{-9, -9, 3}, {9, -9, 3}, {9, 9, 3}, {-9, 9, 3}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 2, 3}};
    const std::vector<Occluder> occluders{{roof, triangles}};
    const auto covered = sceneOf(b.city, sunAt(50.0), {}, occluders);
    EXPECT_LT(covered->diffuseLight({0, 0, 1.5F}, {0, 0, 1}).g, 0.2 * expected.g);
    // And the ground below it lies in its shadow.
    EXPECT_LT(luminance(look(*covered, {0, -4, 1}, {0, 0, 0})),
              0.4F * luminance(look(*open, {0, -4, 1}, {0, 0, 0})));
}

TEST(RadianceScene, AtNightWindowsAreLitAndByDayTheyAreNot) {
    SceneBuilder b = plain();
    b.box(b.object("house", CityObjectType::Building), {-30, 10, 0}, {30, 20, 20});
    const auto brightest = [&](double elevation) {
        const auto scene = sceneOf(b.city, sunAt(elevation, 0.0));  // behind the house
        float most = 0.0F;
        for (float x = -29.0F; x < 29.0F; x += 0.4F) {
            for (float z = 0.5F; z < 19.0F; z += 0.4F) {
                most = std::max(most, luminance(look(*scene, {0, -20, 5}, {x, 10, z})));
            }
        }
        return most / luminance(scene->sky().ambient({0, -1, 0}));
    };
    EXPECT_GT(brightest(-20.0), 5.0F);
    EXPECT_LT(brightest(30.0), 1.5F);
}

/// What a wall of a building with this material looks like: its darkest and lightest luminance.
std::pair<float, float> wallRange(const std::string& name) {
    SceneBuilder b = plain();
    const auto m = b.material(name, {0.2F, 0.5F, 0.2F});
    b.box(b.object("house", CityObjectType::Building), {-15, 10, 0}, {15, 20, 16}, m);
    const auto scene = sceneOf(b.city, sunAt(40.0, 0.0));
    float least = 1e9F;
    float most = 0.0F;
    for (float x = -14.0F; x < 14.0F; x += 0.23F) {
        const float seen = luminance(look(*scene, {0, -60, 8}, {x, 10, 6.3F}));
        least = std::min(least, seen);
        most = std::max(most, seen);
    }
    return {least, most};
}

TEST(RadianceScene, AFacadeMaterialTintsThePatternAndAPlainOneReplacesIt) {
    for (const std::string name : {"", "facade", "Facade ochre"}) {
        const auto [least, most] = wallRange(name);
        EXPECT_GT(most, 2.0F * least) << name;
    }
    for (const std::string name : {"plain", "plain render", "brick"}) {
        const auto [least, most] = wallRange(name);
        EXPECT_LT(most, 1.2F * least) << name;  // the shade varies
    }
}

TEST(RadianceScene, AnEmittingMaterialShinesByItself) {
    SceneBuilder b = plain();
    const auto m = b.material("lamp", glm::vec3(0.0F));
    b.city.materials[m].emission = {2.0F, 1.0F, 0.5F};
    b.level(b.surface(b.object("lamp", CityObjectType::CityFurniture), m), -1, -1, 1, 1, 3);
    const auto scene = sceneOf(b.city, sunAt(-30.0));
    EXPECT_EQ(look(*scene, {0, 0, 5}, {0, 0, 3}), glm::vec3(2.0F, 1.0F, 0.5F));
}

TEST(RadianceScene, MaterialsFromBrokenFilesGiveNoNegativeOrInfiniteLight) {
    SceneBuilder b;
    const auto m = b.material("odd", {std::nanf(""), -3.0F, kInfinity});
    b.city.materials[m].emission = {-1.0F, std::nanf(""), 0.5F};
    b.level(b.surface(b.object("odd", CityObjectType::Generic), m), -9, -9, 9, 9, 0);
    const glm::vec3 c = look(*sceneOf(b.city, sunAt(40.0)), {0, 0, 5}, {1, 1, 0});
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(std::isfinite(c[i]));
        EXPECT_GE(c[i], 0.0F);
    }
}

}  // namespace
}  // namespace reflet::testing
