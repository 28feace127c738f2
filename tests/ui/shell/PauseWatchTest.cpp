// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/PauseWatch.h"

#include <gtest/gtest.h>

#include <QEvent>
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
    [[nodiscard]] PauseWatch::Clock::time_point at(int ms) const {
        return PauseWatch::Clock::time_point() + milliseconds(ms);
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

}  // namespace
}  // namespace reflet
