// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Import.h"
#include "app/pipeline/PreparedCity.h"
#include "core/base/ParallelFor.h"
#include "tests/support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

namespace reflet {
namespace {

/// Boxes of 8 m in rows, each a building.
std::string boxes(int count) {
    std::string objects, vertices;
    for (int n = 0; n < count; ++n) {
        objects += fmt::format(
            "{}\"b{}\":{{\"type\":\"Building\",\"geometry\":[{{\"type\":"
            "\"MultiSurface\",\"lod\":\"1\",\"boundaries\":[",
            n > 0 ? "," : "", n);
        constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        for (int f = 0; f < 6; ++f) {
            const auto& face = kFaces[f];
            objects += fmt::format("{}[[{},{},{},{}]]", f > 0 ? "," : "", 8 * n + face[0],
                                   8 * n + face[1], 8 * n + face[2], 8 * n + face[3]);
        }
        objects += "]}]}";
        const int x = 12 * (n % 100), y = 12 * (n / 100), top = 6 + n % 17;
        for (int k = 0; k < 8; ++k)
            vertices += fmt::format("{}[{},{},{}]", n + k > 0 ? "," : "",
                                    x + (k % 4 == 1 || k % 4 == 2 ? 8 : 0), y + (k % 4 > 1 ? 8 : 0),
                                    k < 4 ? 0 : top);
    }
    return fmt::format(
        "{{\"type\":\"CityJSON\",\"version\":\"1.1\",\"transform\":{{\"scale\":[1,1,1],"
        "\"translate\":[390000,5800000,30]}},\"CityObjects\":{{{}}},\"vertices\":[{}]}}",
        objects, vertices);
}

/// From a file to what is drawn; how many triangles that is.
Result<std::size_t> opened(const std::filesystem::path& file, const JobContext& job) {
    ImportRequest request;
    request.files = {file};
    auto imported = importProject(request, job.phase("importing", 0.0, 0.6));
    if (!imported)
        return tl::unexpected(imported.error());
    const auto prepared = PreparedCity::prepare(
        std::move(imported->project), file.parent_path() / "city.reflet",
        job.phase("preparing", 0.6, 1.0), {std::move(imported->city), true, false});
    if (!prepared)
        return tl::unexpected(prepared.error());
    const auto drawn = prepared->drawn(job);
    if (!drawn)
        return tl::unexpected(drawn.error());
    return prepared->city().triangles.size();
}

/// Progress is reported after each small piece of work: how often it is after a request to cancel
/// tells how much was still done.
TEST(CancelledImport, EndsWithinAFewPiecesOfWorkWhereverItIsCancelled) {
    constexpr int kBuildings = 8000;
    const test::TemporaryFolder folder;
    const auto file = folder / "city.city.json";
    std::ofstream(file) << boxes(kBuildings);

    std::atomic<int> all{0};
    const auto whole = opened(file, JobContext([&](double, const std::string&) { ++all; }, {}));
    ASSERT_TRUE(whole) << whole.error().message();
    ASSERT_GE(*whole, std::size_t(12) * kBuildings);
    ASSERT_GT(all, 150) << "too few pieces to tell anything";

    constexpr int kMoments = 10;
    for (int moment = 0; moment < kMoments; ++moment) {
        const int at = all * moment / kMoments;
        std::stop_source stop;
        std::atomic<int> reports{0};
        const auto result = opened(file, JobContext(
                                             [&](double, const std::string&) {
                                                 if (reports++ == at)
                                                     stop.request_stop();
                                             },
                                             stop.get_token()));
        ASSERT_FALSE(result) << "cancelled at report " << at << " of " << all;
        EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
        EXPECT_LE(reports - at, 4 * threadLimit()) << "of " << all << ", cancelled at " << at;
    }
}

TEST(CancelledImport, IsNotBegunWhenItWasCancelledBefore) {
    const test::TemporaryFolder folder;
    const auto file = folder / "city.city.json";
    std::ofstream(file) << boxes(3);
    std::stop_source stop;
    stop.request_stop();
    const auto result = opened(file, JobContext({}, stop.get_token()));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet
