// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/BackgroundWork.h"
#include "core/base/ParallelFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace reflet {
namespace {

class ParallelFor : public testing::Test {
protected:
    ~ParallelFor() override { setThreadLimit(0); }
};

TEST_F(ParallelFor, VisitsEachIndexExactlyOnceForAnyGrain) {
    for (const std::size_t grain : {0U, 1U, 3U, 64U, 1000U, 5000U}) {
        std::vector<std::atomic<int>> visits(1003);
        parallelFor(3, visits.size(), grain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                ++visits[i];
        });
        for (std::size_t i = 0; i < visits.size(); ++i)
            ASSERT_EQ(visits[i].load(), i < 3 ? 0 : 1) << "index " << i << ", grain " << grain;
    }
}

TEST_F(ParallelFor, GivesPiecesThatAreNotEmptyAndLieInTheRange) {
    std::mutex mutex;
    std::vector<std::pair<std::size_t, std::size_t>> pieces;
    parallelFor(10, 200, 7, [&](std::size_t first, std::size_t last) {
        const std::scoped_lock lock(mutex);
        pieces.emplace_back(first, last);
    });
    std::sort(pieces.begin(), pieces.end());
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.front().first, 10U);
    EXPECT_EQ(pieces.back().second, 200U);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_LT(pieces[i].first, pieces[i].second);
        if (i > 0) {
            EXPECT_EQ(pieces[i].first, pieces[i - 1].second);
        }
    }
}

TEST_F(ParallelFor, DoesNothingForAnEmptyOrReversedRange) {
    int calls = 0;
    parallelFor(5, 5, 1, [&](std::size_t, std::size_t) { ++calls; });
    parallelFor(6, 5, 1, [&](std::size_t, std::size_t) { ++calls; });
    EXPECT_EQ(calls, 0);
}

TEST_F(ParallelFor, WritesOfItsBodiesAreSeenByTheCaller) {
    std::vector<std::size_t> squares(10000);
    parallelFor(0, squares.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            squares[i] = i * i;
    });
    const auto sum = std::accumulate(squares.begin(), squares.end(), std::size_t{0});
    EXPECT_EQ(sum, 9999ULL * 10000ULL * 19999ULL / 6ULL);
}

TEST_F(ParallelFor, CanBeNested) {
    std::atomic<int> sum{0};
    parallelFor(0, 8, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            parallelFor(0, 100, 10,
                        [&](std::size_t a, std::size_t b) { sum += static_cast<int>(b - a); });
        }
    });
    EXPECT_EQ(sum.load(), 800);
}

TEST_F(ParallelFor, HandsAnExceptionOfABodyToTheCaller) {
    const auto loop = [] {
        parallelFor(0, 1000, 1, [](std::size_t first, std::size_t last) {
            if (first <= 500 && 500 < last)
                throw std::runtime_error("body 500");
        });
    };
    EXPECT_THROW(loop(), std::runtime_error);
}

TEST_F(ParallelFor, KeepsToOneThreadWhenToldTo) {
    setThreadLimit(1);
    EXPECT_EQ(threadLimit(), 1);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> elsewhere{0};
    parallelFor(0, 1000, 1, [&](std::size_t, std::size_t) {
        elsewhere += std::this_thread::get_id() == caller ? 0 : 1;
    });
    EXPECT_EQ(elsewhere.load(), 0);
}

TEST_F(ParallelFor, UsesNoMoreThreadsAtOnceThanAllowed) {
    setThreadLimit(2);
    std::atomic<int> inside{0};
    std::atomic<int> most{0};
    parallelFor(0, 2000, 1, [&](std::size_t, std::size_t) {
        const int now = ++inside;
        for (int seen = most.load(); seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        --inside;
    });
    EXPECT_GE(most.load(), 1);
    EXPECT_LE(most.load(), 2);
}

TEST_F(ParallelFor, OfBackgroundWorkLeavesACoreAndTheCallersThread) {
    setThreadLimit(2);
    const auto caller = std::this_thread::get_id();
    std::mutex mutex;
    std::set<std::thread::id> seen;
    inBackground([&] {
        EXPECT_EQ(threadLimit(), 1);
        parallelFor(0, 2000, 1, [&](std::size_t, std::size_t) {
            const std::scoped_lock lock(mutex);
            seen.insert(std::this_thread::get_id());
        });
    });
    EXPECT_EQ(seen.size(), 1U);
    EXPECT_FALSE(seen.contains(caller)) << "its priority would be lowered for good";
    EXPECT_EQ(threadLimit(), 2) << "for the caller nothing has changed";
}

TEST_F(ParallelFor, OfBackgroundWorkStillHasOneThreadOfOne) {
    setThreadLimit(1);
    int sum = 0;
    inBackground([&] {
        parallelFor(0, 10, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                sum += int(i);
        });
    });
    EXPECT_EQ(sum, 45);
}

TEST_F(ParallelFor, OfBackgroundWorkGivesItsResultAndItsException) {
    EXPECT_EQ(resultInBackground([] { return std::string("baked"); }), "baked");
    EXPECT_THROW(inBackground([] {
                     parallelFor(0, 100, 1, [](std::size_t first, std::size_t) {
                         if (first == 50)
                             throw std::runtime_error("stop");
                     });
                 }),
                 std::runtime_error);
}

TEST_F(ParallelFor, HasAtLeastOneThreadAndGoesBackToAllCores) {
    setThreadLimit(3);
    EXPECT_EQ(threadLimit(), 3);
    setThreadLimit(0);
    EXPECT_EQ(threadLimit(), std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    setThreadLimit(-5);
    EXPECT_GE(threadLimit(), 1);
}

}  // namespace
}  // namespace reflet
