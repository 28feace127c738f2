// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace reflet::test {
namespace {

class ThreadLimit {
public:
    explicit ThreadLimit(int threads) { setThreadLimit(threads); }
    ~ThreadLimit() { setThreadLimit(0); }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;
};

std::vector<std::uint32_t> bitsOf(const std::vector<float>& layer) {
    std::vector<std::uint32_t> bits(layer.size());
    std::transform(layer.begin(), layer.end(), bits.begin(),
                   [](float height) { return std::bit_cast<std::uint32_t>(height); });
    return bits;
}

TEST(HeightfieldThreads, TheirNumberDoesNotChangeABit) {
    TestCity model = randomTriangles(4000, 120.0F, 17);
    // Large enough to be shared out by rows.
    model.triangle({-5, -5, 0}, {200, -5, 12}, {-5, 200, 3})
        .triangle({-5, -5, -0.0F}, {200, -5, 0}, {-5, 200, 0});
    const GridSpec grid{0.0, 0.0, 0.25, 480, 480};
    std::vector<Heightfield> fields;
    for (const int threads : {1, 2, 8}) {
        const ThreadLimit limit(threads);
        auto field = buildHeightfield(model.city, grid, {});
        ASSERT_TRUE(field);
        fields.push_back(std::move(*field));
    }
    for (std::size_t n = 1; n < fields.size(); ++n) {
        EXPECT_EQ(bitsOf(fields[n].topMax), bitsOf(fields[0].topMax));
        EXPECT_EQ(bitsOf(fields[n].topCenter), bitsOf(fields[0].topCenter));
        EXPECT_EQ(bitsOf(fields[n].ground), bitsOf(fields[0].ground));
    }
}

TEST(HeightfieldThreads, StopInTheMiddleWhenTheJobIsCancelled) {
    const TestCity model = randomTriangles(200000, 120.0F, 17);
    std::stop_source source;
    const JobContext job(
        [&](double fraction, const std::string&) {
            if (fraction > 0.1) {
                source.request_stop();
            }
        },
        source.get_token());
    const auto field = buildHeightfield(model.city, {0.0, 0.0, 0.5, 240, 240}, job);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet::test
