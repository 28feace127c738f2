// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/JobContext.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace reflet {
namespace {

using Report = std::pair<double, std::string>;

/// A context that writes down what it is told.
struct RecordedJob {
    std::vector<Report> reports;
    std::stop_source stop;
    JobContext job{[this](double fraction, const std::string& phase) {
                       reports.emplace_back(fraction, phase);
                   },
                   stop.get_token()};
};

TEST(JobContext, ThatWasMadeFromNothingReportsNowhereAndIsNeverCancelled) {
    const JobContext job;
    job.progress(0.5);
    job.phase("inner", 0.0, 1.0).progress(1.0);
    EXPECT_FALSE(job.cancelled());
}

TEST(JobContext, MapsAPhaseIntoItsPartOfTheWhole) {
    RecordedJob recorded;
    const JobContext bake = recorded.job.phase("bake", 0.25, 0.75);
    bake.progress(0.0);
    bake.progress(0.5);
    bake.progress(1.0);
    const std::vector<Report> expected = {{0.25, "bake"}, {0.5, "bake"}, {0.75, "bake"}};
    EXPECT_EQ(recorded.reports, expected);
}

TEST(JobContext, NestsPhasesAndNamesTheInnermost) {
    RecordedJob recorded;
    const JobContext probe = recorded.job.phase("bake", 0.5, 1.0).phase("probe 2", 0.5, 0.75);
    probe.progress(0.0);
    probe.progress(1.0);
    const std::vector<Report> expected = {{0.75, "probe 2"}, {0.875, "probe 2"}};
    EXPECT_EQ(recorded.reports, expected);
}

TEST(JobContext, KeepsAFractionWithinItsPhase) {
    RecordedJob recorded;
    const JobContext bake = recorded.job.phase("bake", 0.25, 0.75);
    bake.progress(-3.0);
    bake.progress(7.0);
    const std::vector<Report> expected = {{0.25, "bake"}, {0.75, "bake"}};
    EXPECT_EQ(recorded.reports, expected);
}

TEST(JobContext, IsCancelledInAllItsPhasesAtOnce) {
    RecordedJob recorded;
    const JobContext inner = recorded.job.phase("a", 0.0, 0.5).phase("b", 0.0, 0.5);
    EXPECT_FALSE(inner.cancelled());
    recorded.stop.request_stop();
    EXPECT_TRUE(inner.cancelled());
    EXPECT_TRUE(recorded.job.cancelled());
    EXPECT_TRUE(inner.stopToken().stop_requested());
}

TEST(JobContext, CancellationIsAnErrorOfItsOwn) {
    EXPECT_EQ(JobContext::cancelledError().code, ErrorCode::Cancelled);
    EXPECT_EQ(JobContext::cancelledError().message(),
              "cancelled. Start it again to finish; what was done is kept.");
}

}  // namespace
}  // namespace reflet
