// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/PauseWatch.h"

#include <gtest/gtest.h>

#include <QEvent>
#include <QTest>
#include <QTimerEvent>
#include <vector>

namespace reflet {
namespace {

using std::chrono::milliseconds;

class PauseWatchTest : public testing::Test {
protected:
    void SetUp() override {
        outer.setObjectName(QStringLiteral("outer"));
        inner.setObjectName(QStringLiteral("inner"));
    }
    [[nodiscard]] static PauseWatch::Moment at(int ms, int work = 0) {
        return {PauseWatch::Clock::time_point() + milliseconds(ms), milliseconds(work)};
    }

    QObject outer, inner;
    QEvent paint{QEvent::Paint};
    QEvent show{QEvent::Show};
    std::vector<PauseWatch::Pause> told;
    PauseWatch watch{50.0, [this](const PauseWatch::Pause& pause) { told.push_back(pause); }};
};

TEST_F(PauseWatchTest, TellsOfWhatTakesLongerThanTheLimitAndOfNothingElse) {
    watch.begin(outer, paint, at(0));
    watch.end(at(50));
    EXPECT_TRUE(told.empty()) << "that is just not longer";
    watch.begin(outer, paint, at(100));
    watch.end(at(151));
    ASSERT_EQ(told.size(), 1U);
    EXPECT_DOUBLE_EQ(told[0].milliseconds, 51.0);
    EXPECT_EQ(told[0].what, QStringLiteral("Paint to QObject “outer”"));
    EXPECT_DOUBLE_EQ(watch.longest().milliseconds, 51.0);
}

TEST_F(PauseWatchTest, CountsEventsWithinAnEventOnceAndNamesTheOneThatTookMostOfIt) {
    watch.begin(outer, show, at(0));
    watch.begin(inner, paint, at(5));
    watch.end(at(75));
    watch.begin(inner, show, at(75));
    watch.end(at(80));
    EXPECT_TRUE(told.empty()) << "the pause goes on";
    watch.end(at(90));
    ASSERT_EQ(told.size(), 1U);
    EXPECT_DOUBLE_EQ(told[0].milliseconds, 90.0);
    EXPECT_EQ(told[0].what, QStringLiteral("Show to QObject “outer” > Paint to QObject “inner”"));
}

TEST_F(PauseWatchTest, DoesNotBlameAShortEventWithinALongOne) {
    watch.begin(outer, show, at(0));
    watch.begin(inner, paint, at(10));
    watch.end(at(20));
    watch.end(at(100));
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].what, QStringLiteral("Show to QObject “outer”"));
}

TEST_F(PauseWatchTest, KnowsTheLongestAlsoWhenNoneWasTooLong) {
    watch.begin(outer, paint, at(0));
    watch.end(at(20));
    watch.begin(inner, show, at(30));
    watch.end(at(40));
    EXPECT_TRUE(told.empty());
    EXPECT_DOUBLE_EQ(watch.longest().milliseconds, 20.0);
    EXPECT_TRUE(watch.longest().what.contains(QStringLiteral("outer")));
}

TEST_F(PauseWatchTest, TellsWorkFromWaiting) {
    watch.begin(outer, paint, at(0, 100));
    watch.end(at(90, 103));
    watch.begin(inner, show, at(100, 103));
    watch.begin(inner, paint, at(101, 104));
    watch.end(at(140, 140));
    watch.end(at(160, 143));
    ASSERT_EQ(told.size(), 2U);
    EXPECT_DOUBLE_EQ(told[0].milliseconds, 90.0);
    EXPECT_DOUBLE_EQ(told[0].work, 3.0);
    EXPECT_DOUBLE_EQ(told[1].milliseconds, 60.0);
    EXPECT_DOUBLE_EQ(told[1].work, 40.0) << "with the events within";
    EXPECT_TRUE(watch.longest().what.contains(QStringLiteral("outer")));
    EXPECT_TRUE(watch.hardest().what.contains(QStringLiteral("inner")));
    watch.forget();
    EXPECT_DOUBLE_EQ(watch.longest().milliseconds, 0.0);
    EXPECT_DOUBLE_EQ(watch.hardest().work, 0.0);
}

TEST_F(PauseWatchTest, ASleepingThreadIsNotAtWorkAndABusyOneIs) {
    const auto before = PauseWatch::Moment::now();
    QTest::qSleep(40);
    const auto slept = PauseWatch::Moment::now();
    EXPECT_GE(slept.time - before.time, milliseconds(40));
    EXPECT_LT(slept.work - before.work, milliseconds(20));
    auto busy = slept;
    for (volatile unsigned sum = 0; busy.work - slept.work < milliseconds(10);
         busy = PauseWatch::Moment::now())
        sum = sum + 1;
    EXPECT_GE(busy.time - slept.time, milliseconds(9)) << "a thread works no faster than time";
}

}  // namespace
}  // namespace reflet
