// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/FrameDirector.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

using std::chrono::milliseconds;

/// A director with a clock that the test turns, and a machine that draws a full picture in a given
/// time.
class Rig {
public:
    explicit Rig(int fullMilliseconds) : m_full(fullMilliseconds) {
        state.width = 1000;
        state.height = 600;
        state.visible = true;
        state.motion = 1;
        director.update(state, now);
    }
    void changed() { director.update(state, now); }
    /// Draws whatever becomes due during this time; the plans in order.
    std::vector<FramePlan> run(int duration) {
        std::vector<FramePlan> plans;
        const auto end = now + milliseconds(duration);
        for (;;) {
            const auto next = director.nextDue();
            if (!next || *next > end) {
                break;
            }
            now = std::max(now, *next);
            const std::optional<FramePlan> plan = director.due(now);
            if (!plan) {
                ADD_FAILURE() << "nothing was due when something should have been";
                break;
            }
            const auto started = now;
            const double samples = plan->samplesPerEdge * plan->samplesPerEdge;
            now += std::chrono::microseconds(
                long(1000.0 * m_full * plan->scale * plan->scale * samples));
            director.drawn(*plan, started, now);
            plans.push_back(*plan);
        }
        now = std::max(now, end);
        return plans;
    }

    FrameDirector director;
    SceneState state;
    FrameDirector::Clock::time_point now{std::chrono::hours(1)};

private:
    int m_full;
};

std::shared_ptr<const Traffic> driveOf(double seconds) {
    auto traffic = std::make_shared<Traffic>();
    Drive drive;
    drive.id = "car";
    drive.vehicle = std::make_shared<const Vehicle>();
    drive.route = std::make_shared<const Route>(Route({{0, 0, 0}, {10.0 * seconds, 0, 0}}));
    drive.speed = 10.0;
    traffic->add(drive);
    return traffic;
}

TEST(FrameDirector, RefinesAPictureThatRestsAndThenStops) {
    Rig rig(60);
    rig.run(100);
    const std::vector<FramePlan> later = rig.run(5000);
    ASSERT_FALSE(later.empty());
    EXPECT_TRUE(later.back().settled);
    EXPECT_EQ(later.back().scale, 1.0);
    EXPECT_EQ(later.back().samplesPerEdge, 2);
    EXPECT_FALSE(rig.director.nextDue());
    EXPECT_TRUE(rig.run(5000).empty());
}

TEST(FrameDirector, ShowsAChangeOfAMovementInTheNextPicture) {
    Rig rig(60);
    rig.run(5000);
    ++rig.state.motion;
    rig.changed();
    EXPECT_TRUE(rig.director.due(rig.now)) << "a picture that nobody waits for is drawn";
}

TEST(FrameDirector, KeepsThePaceByDrawingSmallerWhileSomethingMoves) {
    Rig rig(90);
    int pictures = 0;
    std::vector<FramePlan> last;
    for (int k = 0; k < 60; ++k) {
        ++rig.state.motion;
        rig.changed();
        last = rig.run(33);
        pictures += int(last.size());
    }
    ASSERT_FALSE(last.empty());
    EXPECT_LT(last.back().scale, 0.7);
    EXPECT_GT(pictures, 40);
}

TEST(FrameDirector, ShowsASingleChangeAtFullSizeAtOnce) {
    Rig rig(90);
    rig.run(5000);
    ++rig.state.touch;
    rig.changed();
    const std::vector<FramePlan> plans = rig.run(2000);
    ASSERT_EQ(plans.size(), 2U);
    EXPECT_EQ(plans[0].scale, 1.0);
    EXPECT_EQ(plans[0].samplesPerEdge, 1);
    EXPECT_TRUE(plans[1].settled);
}

TEST(FrameDirector, DrivesWithTheClockAndBeginsAgainAtTheEnd) {
    Rig rig(10);
    rig.state.traffic = driveOf(8.0);
    rig.state.playing = true;
    rig.state.seconds = 3.0;
    ++rig.state.clock;
    rig.changed();
    const std::vector<FramePlan> plans = rig.run(2000);
    ASSERT_GT(plans.size(), 50U);
    EXPECT_NEAR(plans.front().seconds, 3.0, 0.05);
    EXPECT_NEAR(plans.back().seconds, 5.0, 0.05);
    rig.run(3500);
    const double duration = rig.state.traffic->duration();
    const std::vector<FramePlan> again = rig.run(500);
    EXPECT_NEAR(again.back().seconds, 9.0 - duration, 0.1);
    EXPECT_FALSE(again.back().settled);
}

TEST(FrameDirector, HasNothingToMoveBeforeThereIsADrive) {
    Rig rig(10);
    rig.state.playing = true;
    ++rig.state.clock;
    rig.changed();
    const std::vector<FramePlan> plans = rig.run(2000);
    ASSERT_FALSE(plans.empty());
    EXPECT_TRUE(plans.back().settled);
    EXPECT_LE(plans.size(), 4U);
    EXPECT_FALSE(rig.director.nextDue()) << "the same picture over and over helps nobody";
    rig.state.traffic = driveOf(10.0);
    ++rig.state.touch;
    rig.changed();
    EXPECT_GT(rig.run(1000).size(), 10U);
}

TEST(FrameDirector, StandsStillAtTheTimeThatItIsTold) {
    Rig rig(10);
    rig.state.traffic = driveOf(8.0);
    rig.state.seconds = 4.5;
    ++rig.state.clock;
    ++rig.state.motion;
    rig.changed();
    for (const FramePlan& plan : rig.run(2000)) {
        EXPECT_EQ(plan.seconds, 4.5);
    }
}

TEST(FrameDirector, DrawsNothingForAHiddenWindow) {
    Rig rig(10);
    rig.state.playing = true;
    ++rig.state.clock;
    rig.state.visible = false;
    ++rig.state.touch;
    rig.changed();
    EXPECT_TRUE(rig.run(3000).empty());
    rig.state.visible = true;
    ++rig.state.motion;
    rig.changed();
    EXPECT_FALSE(rig.run(100).empty());
}

TEST(FrameDirector, TellsThePaceOfAMovement) {
    Rig rig(20);
    rig.state.playing = true;
    rig.state.traffic = driveOf(8.0);
    ++rig.state.clock;
    rig.changed();
    rig.run(3000);
    EXPECT_NEAR(rig.director.framesPerSecond(), 50.0, 5.0);
}

}  // namespace
}  // namespace reflet
