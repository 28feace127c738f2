// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/StageTimer.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

TEST(StageCost, IsThatOfTheCallsAndOfWhatTheGpuTakesLonger) {
    StageCost cost;
    EXPECT_EQ(cost.took(2.0, true), 2.0);  // nothing is known of the GPU yet
    cost.told(9.0, 16.0);
    EXPECT_EQ(cost.took(2.0, true), 9.0);
    EXPECT_EQ(cost.took(3.0, false), 10.0);  // 7 ms longer than the calls, as last known
    cost.told(1.0, 16.0);
    EXPECT_EQ(cost.took(2.0, true), 2.0);  // never less than the calls
}

TEST(StageCost, CallsThatWereSlowOnceAreNotSlowAgainWhenTheGpuTellsOfThem) {
    StageCost cost;
    static_cast<void>(cost.took(2.0, true));
    cost.told(5.0, 16.0);
    EXPECT_EQ(cost.took(690.0, true), 693.0);  // a shader was compiled
    cost.told(694.0, 710.0);
    EXPECT_EQ(cost.took(2.0, true), 6.0);
}

TEST(StageCost, TheGpuCannotTakeLongerThanWhatHasPassed) {
    StageCost cost;
    static_cast<void>(cost.took(2.0, true));
    cost.told(2.6e6, 16.0);
    EXPECT_EQ(cost.took(2.0, true), 16.0);
}

}  // namespace
}  // namespace reflet
