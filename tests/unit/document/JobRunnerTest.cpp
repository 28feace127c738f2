// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/JobRunner.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QThread>
#include <atomic>
#include <chrono>
#include <latch>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

namespace reflet {
namespace {

/// How long a test waits for what must happen: generous, for a busy machine.
constexpr int kPatience = 60'000;

/// Work that goes on until it is cancelled.
Result<int> untilCancelled(const JobContext& job) {
    while (!job.cancelled())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return tl::unexpected(JobContext::cancelledError());
}

std::function<Result<int>(const JobContext&)> giving(int value) {
    return [value](const JobContext&) -> Result<int> { return value; };
}

/// Collects results in the order in which they come.
struct Results {
    std::vector<Result<int>> all;
    std::function<void(Result<int>)> collect() {
        return [this](Result<int> result) { all.push_back(std::move(result)); };
    }
};

TEST(JobRunner, WorksOnAnotherThreadAndDeliversOnThisOne) {
    JobRunner runner;
    QThread* worker = nullptr;
    QThread* delivery = nullptr;
    int value = 0;
    runner.run<int>(
        {QStringLiteral("add")},
        [&](const JobContext&) -> Result<int> {
            worker = QThread::currentThread();
            return 42;
        },
        nullptr,
        [&](Result<int> result) {
            delivery = QThread::currentThread();
            value = result.value();
        });
    EXPECT_EQ(value, 0) << "never from inside run()";
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_EQ(value, 42);
    EXPECT_NE(worker, delivery);
    EXPECT_EQ(delivery, QThread::currentThread());
}

TEST(JobRunner, CarriesValuesThatCannotBeCopiedAndResultsWithoutValue) {
    JobRunner runner;
    std::unique_ptr<int> got;
    bool done = false;
    runner.run<std::unique_ptr<int>>(
        {},
        [](const JobContext&) -> Result<std::unique_ptr<int>> { return std::make_unique<int>(7); },
        nullptr, [&](Result<std::unique_ptr<int>> result) { got = std::move(result).value(); });
    runner.run<void>(
        {}, [](const JobContext&) -> Result<void> { return {}; }, nullptr,
        [&](Result<void> result) { done = result.has_value(); });
    ASSERT_TRUE(runner.wait(kPatience));
    ASSERT_NE(got, nullptr);
    EXPECT_EQ(*got, 7);
    EXPECT_TRUE(done);
}

TEST(JobRunner, ReplacesTheOlderJobsOfALane) {
    JobRunner runner;
    Results results;
    const JobRunner::Options lane{QStringLiteral("bake"), QStringLiteral("bake")};
    runner.run<int>(lane, untilCancelled, nullptr, results.collect());
    runner.run<int>(lane, giving(2), nullptr, results.collect());
    runner.run<int>(lane, giving(3), nullptr, results.collect());
    ASSERT_TRUE(runner.wait(kPatience));
    ASSERT_EQ(results.all.size(), 3U);
    int cancelled = 0;
    int value = 0;
    for (const auto& result : results.all) {
        if (result) {
            value = *result;
        } else {
            EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
            ++cancelled;
        }
    }
    EXPECT_EQ(cancelled, 2);
    EXPECT_EQ(value, 3) << "the newest wins";
}

TEST(JobRunner, DropsTheResultOfAJobThatFinishedWhileItWasReplaced) {
    JobRunner runner;
    Results results;
    const JobRunner::Options lane{QStringLiteral("x"), QStringLiteral("x")};
    std::latch finished(1);
    runner.run<int>(
        lane,
        [&](const JobContext&) -> Result<int> {
            finished.count_down();
            return 1;
        },
        nullptr, results.collect());
    finished.wait();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    runner.run<int>(lane, giving(2), nullptr, results.collect());
    ASSERT_TRUE(runner.wait(kPatience));
    ASSERT_EQ(results.all.size(), 2U);
    ASSERT_FALSE(results.all[0].has_value());
    EXPECT_EQ(results.all[0].error().code, ErrorCode::Cancelled);
    EXPECT_EQ(*results.all[1], 2);
}

TEST(JobRunner, QueuesBehindTheLaneWhenAskedAndNeverRunsTwoAtOnce) {
    constexpr int kJobs = 20;
    JobRunner runner;
    std::atomic<int> atOnce = 0;
    std::atomic<int> most = 0;
    std::vector<int> order;
    for (int i = 0; i < kJobs; ++i) {
        runner.run<int>(
            {QStringLiteral("film"), QStringLiteral("film"), false},
            [&, i](const JobContext&) -> Result<int> {
                most = std::max(most.load(), ++atOnce);
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                --atOnce;
                return i;
            },
            nullptr, [&](Result<int> result) { order.push_back(result.value()); });
    }
    EXPECT_TRUE(runner.isBusy(QStringLiteral("film")));
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_EQ(most, 1);
    ASSERT_EQ(order.size(), std::size_t(kJobs));
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(JobRunner, RunsLanesBesideEachOther) {
    JobRunner runner;
    std::latch both(2);
    Results results;
    for (const char* lane : {"a", "b"}) {
        runner.run<int>(
            {QString(), QString::fromLatin1(lane)},
            [&](const JobContext&) -> Result<int> {
                both.arrive_and_wait();  // goes on only when the other lane runs too
                return 1;
            },
            nullptr, results.collect());
    }
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_EQ(results.all.size(), 2U);
}

TEST(JobRunner, CancelsWhatRunsAndWhatWaits) {
    JobRunner runner;
    Results results;
    const JobRunner::Options queue{QStringLiteral("q"), QStringLiteral("q"), false};
    const quint64 first = runner.run<int>(queue, untilCancelled, nullptr, results.collect());
    const quint64 second = runner.run<int>(queue, giving(2), nullptr, results.collect());
    runner.run<int>(queue, giving(3), nullptr, results.collect());
    runner.cancel(second);
    runner.cancel(second);
    runner.cancel(first);
    runner.cancel(12345);
    EXPECT_TRUE(results.all.empty()) << "never from inside cancel()";
    ASSERT_TRUE(runner.wait(kPatience));
    ASSERT_EQ(results.all.size(), 3U);
    int cancelled = 0;
    for (const auto& result : results.all)
        cancelled += result ? 0 : 1;
    EXPECT_EQ(cancelled, 2);
}

TEST(JobRunner, ContainsExceptionsAsErrors) {
    JobRunner runner;
    Results results;
    runner.run<int>(
        {}, [](const JobContext&) -> Result<int> { throw std::runtime_error("oops"); }, nullptr,
        results.collect());
    ASSERT_TRUE(runner.wait(kPatience));
    runner.run<int>(
        {}, [](const JobContext&) -> Result<int> { throw 7; }, nullptr, results.collect());
    ASSERT_TRUE(runner.wait(kPatience));
    runner.run<int>(
        {}, [](const JobContext&) -> Result<int> { throw std::bad_alloc(); }, nullptr,
        results.collect());
    ASSERT_TRUE(runner.wait(kPatience));
    ASSERT_EQ(results.all.size(), 3U);
    EXPECT_EQ(results.all[0].error().code, ErrorCode::Internal);
    EXPECT_NE(results.all[0].error().what.find("oops"), std::string::npos);
    EXPECT_EQ(results.all[1].error().code, ErrorCode::Internal);
    EXPECT_EQ(results.all[2].error().code, ErrorCode::ResourceLimit);
}

TEST(JobRunner, CancelsTheJobsOfAnOwnerThatGoesAndTellsItNothing) {
    JobRunner runner;
    bool told = false;
    auto owner = std::make_unique<QObject>();
    runner.run<int>({}, untilCancelled, owner.get(), [&](Result<int>) { told = true; });
    runner.run<int>({}, giving(1), owner.get(), [&](Result<int>) { told = true; });
    owner.reset();
    EXPECT_TRUE(runner.wait(kPatience));
    EXPECT_FALSE(told);
}

TEST(JobRunner, ShowsVisibleJobsWithTheirPhaseAndProgress) {
    JobRunner runner;
    int told = 0;
    QObject::connect(&runner, &JobRunner::jobsChanged, [&] { ++told; });
    std::latch reported(1);
    const quint64 id = runner.run<int>({QStringLiteral("Bake probes")},
                                       [&](const JobContext& job) -> Result<int> {
                                           job.phase("probe p7", 0.5, 1.0).progress(0.5);
                                           reported.count_down();
                                           return untilCancelled(job);
                                       },
                                       nullptr, {});
    JobRunner::Options hidden{QStringLiteral("hidden")};
    hidden.visible = false;
    runner.run<int>(hidden, untilCancelled, nullptr, {});
    reported.wait();
    const auto jobs = runner.jobs();
    ASSERT_EQ(jobs.size(), 1U);
    EXPECT_EQ(jobs[0], (JobStatus{id, QStringLiteral("Bake probes"), QStringLiteral("probe p7"),
                                  0.75, false, false}));
    EXPECT_GE(told, 1);
    runner.cancelAll();
    EXPECT_TRUE(runner.jobs().at(0).cancelling);
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_TRUE(runner.jobs().empty());
    EXPECT_TRUE(runner.isIdle());
}

TEST(JobRunner, TellsOfProgressSeldomHoweverOftenItIsReported) {
    constexpr int kReports = 200'000;
    JobRunner runner;
    int told = 0;
    QObject::connect(&runner, &JobRunner::jobsChanged, [&] { ++told; });
    runner.run<int>({QStringLiteral("busy")},
                    [&](const JobContext& job) -> Result<int> {
                        for (int i = 0; i <= kReports; ++i)
                            job.progress(double(i) / kReports);
                        return 0;
                    },
                    nullptr, {});
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_GE(told, 2);
    EXPECT_LT(told, kReports / 100);
}

TEST(JobRunner, JoinsItsThreadsWhenItGoes) {
    std::atomic<int> running = 0;
    bool told = false;
    {
        JobRunner runner;
        for (int i = 0; i < 20; ++i) {
            runner.run<int>(
                {QString(), i % 2 == 0 ? QString() : QStringLiteral("lane"), false},
                [&](const JobContext& job) -> Result<int> {
                    ++running;
                    auto result = untilCancelled(job);
                    --running;
                    return result;
                },
                nullptr, [&](Result<int>) { told = true; });
        }
    }
    EXPECT_EQ(running, 0);
    QCoreApplication::processEvents();
    EXPECT_FALSE(told);
}

TEST(JobRunner, LetsGoOfWhatADeliveryHoldsOnItsOwnThread) {
    constexpr int kJobs = 500;
    JobRunner runner;
    const QThread* here = QThread::currentThread();
    std::atomic<int> elsewhere = 0;
    std::atomic<int> gone = 0;
    for (int i = 0; i < kJobs; ++i) {
        const std::shared_ptr<int> held(new int(i), [&, here](const int* value) {
            elsewhere += QThread::currentThread() == here ? 0 : 1;
            ++gone;
            delete value;
        });
        runner.run<int>({}, giving(i), nullptr, [held](Result<int>) {});
    }
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_EQ(gone, kJobs);
    EXPECT_EQ(elsewhere, 0);
}

TEST(JobRunner, DeliversEveryJobOnceUnderLoad) {
    constexpr int kJobs = 1'000;
    JobRunner runner;
    std::vector<int> delivered(kJobs, 0);
    std::vector<quint64> ids;
    auto owner = std::make_unique<QObject>();
    for (int i = 0; i < kJobs; ++i) {
        const QString lane = i % 3 == 0 ? QString() : QStringLiteral("lane %1").arg(i % 7);
        ids.push_back(runner.run<int>(
            {QStringLiteral("job"), lane, i % 2 == 0},
            [i](const JobContext& job) -> Result<int> {
                for (int step = 0; step < 20 && !job.cancelled(); ++step)
                    job.progress(step / 20.0);
                if (i % 50 == 0)
                    throw std::runtime_error("now and then");
                return i;
            },
            owner.get(),
            [&delivered, i](Result<int> result) {
                ++delivered[std::size_t(i)];
                EXPECT_EQ(result.value_or(i), i);
            }));
        if (i % 5 == 0)
            runner.cancel(ids[std::size_t(i / 2)]);
        if (i % 11 == 0)
            QCoreApplication::processEvents();
    }
    ASSERT_TRUE(runner.wait(kPatience));
    for (int i = 0; i < kJobs; ++i)
        ASSERT_EQ(delivered[std::size_t(i)], 1) << "job " << i;
}

TEST(JobRunner, MayBeUsedFromADelivery) {
    JobRunner runner;
    int depth = 0;
    std::function<void(Result<int>)> again = [&](Result<int> result) {
        depth = result.value();
        if (depth < 5) {
            runner.run<int>({QStringLiteral("next"), QStringLiteral("lane")}, giving(depth + 1),
                            nullptr, again);
        }
    };
    runner.run<int>({QStringLiteral("first"), QStringLiteral("lane")}, giving(1), nullptr, again);
    ASSERT_TRUE(runner.wait(kPatience));
    EXPECT_EQ(depth, 5);
}

}  // namespace
}  // namespace reflet
