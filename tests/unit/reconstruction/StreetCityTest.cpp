// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method against the truth of the same heightfield: two REMs 15 m apart in a street, and
// a reflector between them.
#include "BoxCity.h"
#include "core/environment/ImageMetrics.h"
#include "core/reconstruction/Reconstruction.h"

#include <gtest/gtest.h>

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
    const std::vector<ReferenceEnvironmentMap> m_rems{
        m_city.see("west", {-5.0, -1.5, 2.0}, 2 * kResolution, 2),
        m_city.see("east", {10.0, -1.5, 2.0}, 2 * kResolution, 2)};
    const ReconstructionInput m_input{&m_tracer, m_rems, 250.0};
};

TEST_F(StreetCity, IsReconstructedFarBetterThanByBlendingOrByTheNearestMap) {
    const double nearest = decibels(reconstructNearest(m_input, m_position, kResolution));
    const double blend = decibels(reconstructBlend(m_input, m_position, kResolution));
    const LocalEnvironmentMap map = mem(MemSettings{});
    RecordProperty("nearest", std::to_string(nearest));
    RecordProperty("blend", std::to_string(blend));
    RecordProperty("mem", std::to_string(decibels(map)));
    std::printf("nearest %.2f  blend %.2f  mem %.2f dB ssim %.4f\n", nearest, blend, decibels(map),
                similarity(map));
    EXPECT_GT(decibels(map), blend + 6.0);
    EXPECT_GT(decibels(map), nearest + 6.0);
}

}  // namespace
}  // namespace reflet
