// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/LevelOfDetail.h"
#include "core/reconstruction/Surroundings.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace reflet {
namespace {

BodyView car(double pixels) {
    return {pixels, 0.8, 1.0, 6.0};
}

/// The largest step of detail is 0.
double texelsAQuad(const Detail& detail) {
    return detail.blend ? 1e9 : std::exp2(detail.quadStep);
}

TEST(LevelOfDetail, CountsTheTexelsOfAPixelAsTheDesignSays) {
    EXPECT_DOUBLE_EQ(texelsPerPixel(128, {64.0, 2.5, 1.0, 1.0}), 5.0);
    EXPECT_DOUBLE_EQ(texelsPerPixel(256, {1024.0, 0.4, 1.0, 1.0}), 0.1);
}

TEST(LevelOfDetail, ShowsALargeVehicleAsFinelyAsItIsTuned) {
    for (const int resolution : {8, 32, 100, 128, 512}) {
        MemSettings tuned;
        tuned.resolution = resolution;
        const Detail detail = chooseDetail(car(2000.0), tuned, 0);
        EXPECT_FALSE(detail.blend);
        EXPECT_EQ(detail.resolution, resolution);
        EXPECT_EQ(detail.quadStep, 0);
        MemSettings drawn = settingsOf(detail, tuned);
        drawn.meshSize = tuned.meshSize;
        EXPECT_EQ(drawn, tuned);
    }
}

TEST(LevelOfDetail, GivesFarVehiclesTheBlendOfTwoProbes) {
    EXPECT_TRUE(chooseDetail(car(12.0), {}, 0).blend);
    EXPECT_TRUE(chooseDetail(car(1e-9), {}, 0).blend);
    EXPECT_TRUE(chooseDetail({400.0, 0.8, 0.0, 6.0}, {}, 0).blend) << "of no interest at all";
    EXPECT_FALSE(chooseDetail(car(60.0), {}, 0).blend);
}

TEST(LevelOfDetail, NeverGetsFinerForSmallerOrLessInterestingBodiesOrUnderPressure) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 20000; ++n) {
        MemSettings tuned;
        tuned.resolution = 16 << int(6.0 * unit(random));
        tuned.smallestQuad = 1.0 + 3.0 * unit(random);
        const BodyView view{std::exp(8.0 * unit(random)), 4.0 * unit(random), 3.0 * unit(random),
                            0.5 + 40.0 * unit(random)};
        const int coarse = int(unit(random) * kMostCoarse);
        const Detail detail = chooseDetail(view, tuned, coarse);
        const auto expectNoFiner = [&](const Detail& other, const char* why) {
            ASSERT_TRUE(detail.atLeast(other)) << why << ", " << view.pixels << " pixels";
            ASSERT_GE(other.reuse, detail.reuse * (1.0 - 1e-12)) << why;
            ASSERT_LE(unitsOf(other), unitsOf(detail)) << why;
        };
        BodyView smaller = view, duller = view, farther = view;
        smaller.pixels *= unit(random);
        duller.interest *= unit(random);
        expectNoFiner(chooseDetail(smaller, tuned, coarse), "smaller");
        expectNoFiner(chooseDetail(duller, tuned, coarse), "duller");
        expectNoFiner(chooseDetail(view, tuned, coarse + 1), "under pressure");
        farther.nearest *= 1.0 + unit(random);
        const Detail free = chooseDetail(farther, tuned, coarse);
        ASSERT_TRUE(free.sameQuality(detail)) << "surroundings decide how long a map serves only";
        ASSERT_GE(free.reuse, detail.reuse);
    }
}

TEST(LevelOfDetail, NeverDividesQuadsBelowATexelOrAPixelNorBeyondWhatIsTuned) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 20000; ++n) {
        MemSettings tuned;
        tuned.resolution = 8 << int(7.0 * unit(random));
        tuned.smallestQuad = 1.0 + 7.0 * unit(random);
        const BodyView view{std::exp(8.0 * unit(random)), 5.0 * unit(random), 1.0, 5.0};
        const Detail detail = chooseDetail(view, tuned, 0);
        const MemSettings drawn = settingsOf(detail, tuned);
        ASSERT_GE(drawn.smallestQuad, 1.0);
        ASSERT_GE(drawn.smallestQuad, tuned.smallestQuad);
        ASSERT_LE(drawn.resolution, tuned.resolution);
        ASSERT_LE(drawn.meshSize, drawn.resolution);
        // No map is made coarser than the picture shows it: a quad step is no larger than what a
        // pixel covers, and a texel of a reduced map is never larger than a pixel.
        if (detail.blend)
            continue;
        ASSERT_LE(texelsAQuad(detail),
                  std::max(1.0, texelsPerPixel(drawn.resolution, view)) * (1.0 + 1e-9));
        if (drawn.resolution < tuned.resolution) {
            ASSERT_GE(drawn.resolution / view.pixels * std::max(view.squeeze, 0.5), 1.0 - 1e-9);
        }
    }
}

TEST(LevelOfDetail, KeepsWhatIsTunedOnceAndForAll) {
    MemSettings tuned;
    tuned.depthRatio = std::numeric_limits<double>::infinity();
    const Detail coarse = chooseDetail(car(40.0), tuned, 4);
    EXPECT_TRUE(std::isinf(settingsOf(coarse, tuned).depthRatio));
    tuned.depthRatio = 0.0;
    EXPECT_EQ(settingsOf(coarse, tuned).depthRatio, 0.0);
    tuned.lod.frameBudget = 7.0;
    EXPECT_EQ(settingsOf(coarse, tuned).lod, LodSettings{}) << "a map must not depend on it";
}

TEST(LevelOfDetail, LetsABodyMoveByATexelOfParallaxBeforeItsMapIsOld) {
    // A texel of 128 along a face is sqrt(4π / 6) / 128 radians on average.
    const double texel = std::sqrt(4.0 * 3.14159265358979 / 6.0) / 128.0;
    const Detail near = chooseDetail({3000.0, 0.1, 1.0, 2.0}, {}, 0);
    EXPECT_NEAR(near.reuse, 2.0 * texel, 1e-9);
    // Far away a pixel is more than a texel: 40 pixels of a sphere are its 2.76 · 128 texels.
    const double squeeze = std::sqrt(24.0 / 3.14159265358979);
    const Detail far = chooseDetail({40.0, squeeze, 1.0, 2.0}, {}, 0);
    const double pixel = std::sqrt(4.0 * 3.14159265358979 / (6.0 * 40.0 * 40.0)) * squeeze;
    EXPECT_NEAR(far.reuse, 2.0 * pixel, 1e-9);
}

TEST(LevelOfDetail, DoesNotFlickerForABodyOnTheBorderBetweenTwoLevels) {
    for (double middle = 10.0; middle < 1000.0; middle *= 1.03) {
        std::optional<Detail> held = chooseDetail(car(middle), {}, 3);
        int changes = 0;
        for (int frame = 0; frame < 200; ++frame) {
            const double pixels = middle * (1.0 + 0.05 * std::sin(0.7 * frame));
            const Detail now = chooseDetail(car(pixels), {}, 3, held);
            changes += now.sameQuality(*held) ? 0 : 1;
            held = now;
        }
        EXPECT_LE(changes, 2) << middle << " pixels";
    }
}

TEST(LevelOfDetail, FollowsWhenABodyComesNearThoughOneWasHeld) {
    std::optional<Detail> held = chooseDetail(car(8.0), {}, 0);
    for (double pixels = 8.0; pixels < 2000.0; pixels *= 1.1)
        held = chooseDetail(car(pixels), {}, 0, held);
    EXPECT_TRUE(held->sameQuality(chooseDetail(car(2000.0), {}, 0)));
}

TEST(MapUpdates, DrawTheWorstOfThoseThatAreDueAsFarAsTheyFit) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 2000; ++n) {
        std::vector<MapUpdate> updates(std::size_t(20.0 * unit(random)));
        for (MapUpdate& update : updates)
            update = {3.0 * unit(random), 100.0 * unit(random), 1.0 + 10.0 * unit(random),
                      unit(random) < 0.1};
        const double allowed = 40.0 * unit(random);
        const auto chosen = chooseUpdates(updates, allowed);
        const std::set<std::size_t> set(chosen.begin(), chosen.end());
        ASSERT_EQ(set.size(), chosen.size());
        double units = 0.0;
        for (const std::size_t i : chosen) {
            ASSERT_TRUE(updates[i].missing || updates[i].error >= 1.0) << "it was not due";
            units += updates[i].units;
        }
        ASSERT_TRUE(units <= allowed || chosen.size() <= 1);
        // None that is left out would have fitted, and none that is more urgent than the first.
        for (std::size_t i = 0; i < updates.size(); ++i) {
            const MapUpdate& left = updates[i];
            if (set.contains(i) || !(left.missing || left.error >= 1.0))
                continue;
            ASSERT_FALSE(chosen.empty());
            ASSERT_GT(units + left.units, allowed);
            const MapUpdate& first = updates[chosen.front()];
            ASSERT_TRUE(first.missing || !left.missing);
            if (first.missing == left.missing && !left.missing) {
                ASSERT_GE(first.error * first.weight, left.error * left.weight);
            }
        }
    }
}

TEST(MapUpdates, ReachEveryMapInTheEnd) {
    // Ten maps, room for one a picture, all move alike: each is drawn once in ten pictures or so.
    std::vector<MapUpdate> updates;
    for (int i = 0; i < 10; ++i)
        updates.push_back({1.0, 10.0 + 3.0 * i, 5.0, false});
    std::vector<int> last(10, 0);
    for (int frame = 1; frame < 300; ++frame) {
        for (const std::size_t i : chooseUpdates(updates, 5.0)) {
            updates[i].error = 0.0;
            last[i] = frame;
        }
        for (std::size_t i = 0; i < updates.size(); ++i) {
            updates[i].error += 0.5;
            EXPECT_LT(frame - last[i], 60) << i;
        }
    }
}

TEST(Surroundings, AreAsFarAsTheNearestWall) {
    test::BoxCity city(-60.0, -60.0, 240, 240, 0.5);
    city.addBox(-60.0, 7.0, 60.0, 20.0, 15.0F);
    city.addBox(-60.0, -30.0, 60.0, -12.0, 15.0F);
    const HeightfieldTracer tracer(city.heightfield());
    const double nearest = nearestSurroundings(tracer, {0.0, 0.0, 1.3}, 100.0);
    EXPECT_GE(nearest, 7.0 - 1e-9);
    EXPECT_LE(nearest, 7.0 * 1.05) << "a few rays meet the wall almost square";
    EXPECT_LE(nearestSurroundings(tracer, {0.0, 6.0, 1.3}, 100.0), 1.1);
    EXPECT_EQ(nearestSurroundings(tracer, {0.0, 0.0, 500.0}, 100.0), 100.0);
}

}  // namespace
}  // namespace reflet
