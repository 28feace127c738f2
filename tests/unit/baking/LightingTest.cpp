// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/Lighting.h"
#include "tests/unit/baking/BakingScenes.h"

namespace reflet::testing {
namespace {

glm::vec3 toward(double azimuthDegrees, double elevationDegrees) {
    return glm::vec3(sunAt(elevationDegrees, azimuthDegrees).sunDirection);
}

TEST(Lighting, TheSkyIsFiniteAndNeverNegativeForAnySunAndHaze) {
    int looked = 0;
    for (double sun = -90.0; sun <= 90.0; sun += 9.0) {
        for (const float turbidity : {2.0F, 2.5F, 4.0F, 7.0F, 10.0F}) {
            Lighting lighting = sunAt(sun, 137.0);
            lighting.turbidity = turbidity;
            const Sky sky(lighting);
            for (double elevation = -90.0; elevation <= 90.0; elevation += 7.5) {
                for (double azimuth = 0.0; azimuth < 360.0; azimuth += 22.5) {
                    const glm::vec3 c = sky.radiance(toward(azimuth, elevation));
                    for (int i = 0; i < 3; ++i) {
                        ASSERT_TRUE(std::isfinite(c[i])) << sun << " " << turbidity;
                        ASSERT_GE(c[i], 0.0F) << sun << " " << turbidity;
                        ASSERT_GE(sky.sunRadiance()[i], 0.0F);
                        ASSERT_GE(sky.ambient(toward(azimuth, elevation))[i], 0.0F);
                    }
                    ++looked;
                }
            }
        }
    }
    EXPECT_EQ(looked, 21 * 5 * 25 * 16);
}

TEST(Lighting, AWhiteSquareInClearNoonSunHasARadianceNearOne) {
    const Sky sky(sunAt(65.0));
    const glm::dvec3 white =
        skyOn(sky, {0.0, 0.0, 1.0}) + glm::dvec3(sky.sunRadiance()) * std::sin(65.0 * kPi / 180.0);
    EXPECT_NEAR(luminance(glm::vec3(white)), 1.0, 0.1);
}

TEST(Lighting, TheSunOutshinesTheSkyAtNoonByALot) {
    const Sky sky(sunAt(50.0));
    const double sun = luminance(sky.sunRadiance()) * std::sin(50.0 * kPi / 180.0);
    const double shade = luminance(sky.ambient({0.0F, 0.0F, 1.0F}));
    EXPECT_GT(sun / shade, 1.5);
    EXPECT_LT(sun / shade, 6.0);
}

TEST(Lighting, AmbientLightIsTheQuadratureOfTheSkyOverTheHemisphere) {
    for (const double elevation : {70.0, 40.0, 15.0, 2.0, -5.0, -30.0}) {
        const Sky sky(sunAt(elevation, 200.0));
        const glm::dvec3 up = skyOn(sky, {0.0, 0.0, 1.0});
        for (const glm::vec3& normal :
             {toward(0, 90), toward(20, 0), toward(110, 0), toward(200, 0), toward(250, 45)}) {
            const glm::dvec3 truth = skyOn(sky, glm::dvec3(normal));
            const glm::vec3 ours = sky.ambient(normal);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(ours[i], truth[i], 0.01 * up[i] + 1e-5)
                    << "sun " << elevation << " channel " << i;
            }
        }
    }
}

TEST(Lighting, TheSkyIsContinuousAcrossTheHorizon) {
    for (const double elevation : {60.0, 10.0, -3.0}) {
        const Sky sky(sunAt(elevation, 90.0));
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0) {
            const glm::vec3 above = sky.radiance(toward(azimuth, 0.05));
            const glm::vec3 below = sky.radiance(toward(azimuth, -0.05));
            EXPECT_LT(glm::distance(above, below), 0.02F * luminance(above) + 1e-4F);
        }
    }
}

TEST(Lighting, DayTurnsToNightWithoutAJumpAndWithoutEverGettingBrighter) {
    float before = luminance(Sky(sunAt(30.0)).ambient({0, 0, 1}));
    float sunBefore = luminance(Sky(sunAt(30.0)).sunRadiance());
    const float noon = before;
    for (double elevation = 29.9; elevation >= -20.0; elevation -= 0.25) {
        const Sky sky(sunAt(elevation));
        const float now = luminance(sky.ambient({0, 0, 1}));
        const float sun = luminance(sky.sunRadiance());
        ASSERT_LE(now, before * 1.002F) << elevation;
        ASSERT_GT(now, before * 0.85F) << elevation;
        ASSERT_LT(std::abs(sun - sunBefore), 0.04F) << elevation;
        before = now;
        sunBefore = sun;
    }
    EXPECT_LT(before, 0.1F * noon);
    EXPECT_EQ(sunBefore, 0.0F);
}

TEST(Lighting, ALowSunIsRedderAndWeakerThanAHighOne) {
    float ratio = 0.0F;
    float strength = 2.0F;
    for (const double elevation : {60.0, 30.0, 12.0, 5.0, 1.0}) {
        const glm::vec3 sun = Sky(sunAt(elevation)).sunRadiance();
        EXPECT_GT(sun.r / sun.b, ratio) << elevation;
        EXPECT_LT(luminance(sun), strength) << elevation;
        ratio = sun.r / sun.b;
        strength = luminance(sun);
    }
}

TEST(Lighting, ASunsetIsRedderThanTheNoonSkyAndTheNightIsBlue) {
    const glm::vec3 noon = Sky(sunAt(60.0, 180.0)).radiance(toward(270.0, 8.0));
    const glm::vec3 sunset = Sky(sunAt(1.0, 270.0)).radiance(toward(270.0, 8.0));
    const glm::vec3 night = Sky(sunAt(-30.0, 270.0)).radiance(toward(270.0, 60.0));
    EXPECT_GT(noon.b, noon.r);
    EXPECT_GT(sunset.r, 1.5F * sunset.b);
    EXPECT_GT(night.b, 1.5F * night.r);
    EXPECT_GT(night.r, 0.0F);
    EXPECT_LT(luminance(night), 0.05F);
}

TEST(Lighting, NonsenseInTheSettingsStillGivesASky) {
    Lighting lighting;
    lighting.sunDirection = {0.0, 0.0, 0.0};
    lighting.turbidity = std::nanf("");
    const glm::vec3 c = Sky(lighting).radiance({0.0F, 0.6F, 0.8F});
    EXPECT_TRUE(std::isfinite(c.r + c.g + c.b));
    EXPECT_GT(luminance(c), 0.0F);
}

}  // namespace
}  // namespace reflet::testing
