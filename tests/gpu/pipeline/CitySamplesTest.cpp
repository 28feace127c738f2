// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/PreparedCity.h"
#include "app/pipeline/WriteSample.h"
#include "tests/gpu/CityPictures.h"
#include "tests/support/TemporaryFolder.h"

namespace reflet::test {
namespace {

constexpr std::size_t kAmbientNodes = 60'000;

class CitySamples : public CityPictures, public ::testing::WithParamInterface<const char*> {};

/// A picture's error is that of leaves, rails and kerbs thinner than a pixel, of shadows at their
/// edges, and of light in nooks that the lattice is too coarse for.
TEST_P(CitySamples, TheFirstViewLooksAsItIsBaked) {
    const TemporaryFolder folder;
    const auto file = writeSample(GetParam(), 1, folder.path());
    ASSERT_TRUE(file);
    const auto prepared = PreparedCity::open(*file, {});
    ASSERT_TRUE(prepared) << prepared.error().message();
    ASSERT_FALSE(prepared->project().views.empty());
    show(prepared->city(), prepared->lighting());
    gatherLight(kAmbientNodes);
    const View& first = prepared->project().views.front();
    const glm::dvec3& origin = prepared->project().frame.origin;
    const CityView view =
        cityView({first.position - origin, first.target - origin, first.verticalFov}, 800, 450);
    const double agreement = decibels(drawn(view), traced(view));
    RecordProperty("decibels", std::to_string(agreement));
    EXPECT_GT(agreement, 26.5);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, CitySamples, ::testing::Values("square", "paper"));

}  // namespace
}  // namespace reflet::test
