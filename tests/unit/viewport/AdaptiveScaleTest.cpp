// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/AdaptiveScale.h"

#include <gtest/gtest.h>

#include <set>

namespace reflet {
namespace {

/// Cost of a picture: a part that goes with the area and one that does not.
double cost(double scale, double area, double fixed = 0.0) {
    return fixed + area * scale * scale;
}

TEST(AdaptiveScale, StaysAtFullSizeWhileThePaceIsKept) {
    AdaptiveScale scale(30.0);
    for (int k = 0; k < 100; ++k) {
        scale.took(20.0, scale.scale());
    }
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(AdaptiveScale, IsWithinTheBudgetAfterTwoPicturesOfAHeavyScene) {
    AdaptiveScale scale(30.0);
    for (int k = 0; k < 2; ++k) {
        scale.took(cost(scale.scale(), 150.0), scale.scale());
    }
    EXPECT_LE(cost(scale.scale(), 150.0), scale.budget() * 1.15);
    EXPECT_LT(scale.scale(), 1.0);
}

TEST(AdaptiveScale, DoesNotFlickerBetweenSizes) {
    for (double area = 5.0; area < 400.0; area *= 1.07) {
        AdaptiveScale scale(30.0);
        for (int k = 0; k < 100; ++k) {
            scale.took(cost(scale.scale(), area, 4.0), scale.scale());
        }
        std::set<double> seen;
        for (int k = 0; k < 200; ++k) {
            scale.took(cost(scale.scale(), area, 4.0), scale.scale());
            seen.insert(scale.scale());
        }
        EXPECT_EQ(seen.size(), 1U) << "with " << area << " ms at full size";
    }
}

TEST(AdaptiveScale, GrowsAgainWhenTheSceneGetsLight) {
    AdaptiveScale scale(30.0);
    for (int k = 0; k < 5; ++k) {
        scale.took(200.0, scale.scale());
    }
    EXPECT_EQ(scale.scale(), AdaptiveScale::kSmallest);
    for (int k = 0; k < 100; ++k) {
        scale.took(cost(scale.scale(), 10.0), scale.scale());
    }
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(AdaptiveScale, LetsOneSlowPicturePass) {
    AdaptiveScale scale(30.0);
    scale.took(45.0, 1.0);
    scale.took(20.0, 1.0);
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(AdaptiveScale, IgnoresPicturesOfAnotherSize) {
    AdaptiveScale scale(30.0);
    scale.took(900.0, 0.5);
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(AdaptiveScale, TakesSenselessTargetsForTheNearestSound) {
    EXPECT_DOUBLE_EQ(AdaptiveScale(0.0).budget(), 200.0);
    EXPECT_DOUBLE_EQ(AdaptiveScale(1e9).budget(), 1000.0 / 120.0);
}

}  // namespace
}  // namespace reflet
