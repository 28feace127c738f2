// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method against the truth of the same heightfield: two REMs 15 m apart in a street, and
// a reflector between them.
#include "BoxCity.h"
#include "core/environment/ImageMetrics.h"
#include "core/reconstruction/Reconstruction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reflet {
namespace {

constexpr int kResolution = 64;

class StreetCity : public testing::Test {
protected:
    [[nodiscard]] double decibels(const LocalEnvironmentMap& map) const {
        PsnrAccumulator psnr;
        psnr.add(displayStrip(map.radiance, 1.0f), displayStrip(m_truth.radiance, 1.0f));
        return psnr.decibels().value_or(0.0);
    }
    [[nodiscard]] double similarity(const LocalEnvironmentMap& map) const {
        return ssim(displayStrip(map.radiance, 1.0f), displayStrip(m_truth.radiance, 1.0f))
            .value_or(0.0);
    }
    [[nodiscard]] LocalEnvironmentMap mem(MemSettings settings) const {
        settings.resolution = kResolution;
        return reconstructMem(m_input, m_position, settings);
    }

    const test::BoxCity m_city = test::streetCity();
    const HeightfieldTracer m_tracer{m_city.heightfield()};
    const glm::dvec3 m_position{1.7, -2.2, 1.6};
    const ReferenceEnvironmentMap m_truth = m_city.see("truth", m_position, kResolution, 4);
    const RemSet m_rems{m_city.see("west", {-5.0, -1.5, 2.0}, 2 * kResolution, 2),
                        m_city.see("east", {10.0, -1.5, 2.0}, 2 * kResolution, 2)};
    const ReconstructionInput m_input{&m_tracer, m_rems, 250.0};
};

TEST_F(StreetCity, IsReconstructedFarBetterThanByBlendingOrByTheNearestMap) {
    const double nearest = decibels(reconstructNearest(m_input, m_position, kResolution));
    const LocalEnvironmentMap blend = reconstructBlend(m_input, m_position, kResolution);
    const LocalEnvironmentMap map = mem(MemSettings{});
    EXPECT_GT(nearest, 12.0);
    EXPECT_LT(decibels(blend), 20.0);
    EXPECT_GT(decibels(map), 28.0);
    EXPECT_GT(decibels(map), decibels(blend) + 9.0);
    EXPECT_GT(decibels(map), nearest + 9.0);
    EXPECT_GT(similarity(map), 0.9);
    EXPECT_GT(similarity(map), similarity(blend) + 0.3);
}

TEST_F(StreetCity, LosesLittleToTracingEveryTexel) {
    // The truth is the heightfield's own, so nothing has to be moved onto other surfaces.
    MemSettings adaptive;
    adaptive.refineHits = false;
    MemSettings full = adaptive;
    full.depthRatio = 0.0;
    const LocalEnvironmentMap sparse = mem(adaptive);
    const LocalEnvironmentMap dense = mem(full);
    EXPECT_GT(decibels(sparse), decibels(dense) - 0.5);
    EXPECT_LT(sparse.statistics.rays, dense.statistics.rays / 4);
    EXPECT_EQ(dense.statistics.quads, std::size_t(6 * kResolution * kResolution));
}

TEST_F(StreetCity, GainsFromRaysOfSingleTexelsAtSilhouettes) {
    MemSettings with;
    with.refineHits = false;
    MemSettings without = with;
    without.traceEdgeTexels = false;
    EXPECT_GT(decibels(mem(with)), decibels(mem(without)) + 0.3);
}

TEST_F(StreetCity, GainsFromTheExactInterpolationMostOnThePlainMesh) {
    MemSettings exact;
    exact.refineHits = false;
    exact.traceEdgeTexels = false;
    exact.depthRatio = std::numeric_limits<double>::infinity();
    MemSettings asInPaper = exact;
    asInPaper.interpolation = Interpolation::AsInPaper;
    EXPECT_GT(decibels(mem(exact)), decibels(mem(asInPaper)) + 0.1);
}

TEST_F(StreetCity, SeesTheSameDistancesAsTheTruthButForSilhouettes) {
    const LocalEnvironmentMap map = mem(MemSettings{});
    std::size_t same = 0;
    for (std::size_t i = 0; i < map.distance.texels().size(); ++i) {
        const float truth = m_truth.distance.texels()[i];
        const float found = map.distance.texels()[i];
        same += found == truth || std::abs(found - truth) < 0.02f * truth ? 1 : 0;
    }
    EXPECT_GT(double(same), 0.93 * double(map.distance.texels().size()));
}

}  // namespace
}  // namespace reflet
