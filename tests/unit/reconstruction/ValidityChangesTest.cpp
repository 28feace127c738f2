// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CompressedMap.h"
#include "core/environment/CubeDirection.h"
#include "core/environment/ImageMetrics.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/ValidityChanges.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

constexpr int kEdge = 64;

class StreetMaps : public testing::Test {
protected:
    StreetMaps() {
        for (const double x : {-30.0, -15.0, 0.0, 15.0, 30.0})
            m_rems.add(m_city.see("r" + std::to_string(int(x)), {x, 0.5, 2.0}, 128, 1));
        m_settings.resolution = kEdge;
    }
    [[nodiscard]] ReconstructionInput input() const { return {&m_tracer, m_rems}; }

    test::BoxCity m_city = test::streetCity();
    HeightfieldTracer m_tracer{m_city.heightfield()};
    RemSet m_rems;
    MemSettings m_settings;
    glm::dvec3 m_position{4.0, 1.0, 1.5};
};

TEST_F(StreetMaps, TheSameMapsChangeNothing) {
    const ValidityChanges changes = validityChanges(input(), m_rems, m_position, m_settings);
    EXPECT_EQ(changes.texels, std::size_t(6 * kEdge * kEdge));
    EXPECT_GE(changes.decisions, changes.texels);
    EXPECT_EQ(changes.changedTexels, 0U);
    EXPECT_EQ(changes.changedDecisions, 0U);
}

/// Against the decisions of each REM by itself, for the pair that is always asked.
TEST_F(StreetMaps, BlindMapsChangeWhatTheySaw) {
    m_settings.weighting = Weighting::AsInPaper;
    const RemCandidates pair = input().candidates(m_position, m_settings);
    RemSet blind;
    for (std::size_t i = 0; i < m_rems.size(); ++i) {
        ReferenceEnvironmentMap map = m_rems[i];
        if (i == pair.rems[0].rem)
            map.distance = CubeMap<float>(128, 0.01F);
        blind.add(std::move(map));
    }
    const ReferenceEnvironmentMap& seeing = m_rems[pair.rems[0].rem];
    const double epsilon = validityTolerance(m_tracer.grid());
    std::size_t saw = 0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < kEdge * kEdge; ++i) {
            const glm::dvec3 direction = texelDirection(kEdge, face, i % kEdge, i / kEdge);
            const HeightfieldHit hit = m_tracer.trace({m_position, direction});
            saw += hit.hit ? isValid(seeing, m_position + hit.t * direction, epsilon)
                           : isValidSky(seeing, direction);
        }
    }
    const ValidityChanges changes = validityChanges(input(), blind, m_position, m_settings);
    EXPECT_EQ(changes.changedTexels, saw);
    EXPECT_EQ(changes.changedDecisions, saw);
    EXPECT_EQ(changes.decisions, 2 * changes.texels);
}

/// What the GPU's maps may cost at most: half a percent of the texels, forty decibels.
TEST_F(StreetMaps, CompressedMapsChangeNextToNothing) {
    RemSet kept;
    PsnrAccumulator psnr;
    for (const auto& map : m_rems.pointers()) {
        const CompressedMap small = compressed(*map);
        EXPECT_EQ(2 * small.bytes(), 3 * map->distance.texels().size());
        kept.add(decompressed(small, map->id, map->center));
        psnr.add(displayStrip(kept[kept.size() - 1].radiance, 1.0F),
                 displayStrip(map->radiance, 1.0F));
    }
    const ValidityChanges changes = validityChanges(input(), kept, m_position, m_settings);
    EXPECT_LT(double(changes.changedTexels), 0.005 * double(changes.texels));
    EXPECT_GT(psnr.decibels().value_or(100.0), 40.0);
}

}  // namespace
}  // namespace reflet
