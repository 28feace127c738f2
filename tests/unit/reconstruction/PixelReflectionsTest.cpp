// SPDX-License-Identifier: GPL-3.0-or-later
// Single rays from a vehicle's body: against the dense map of the same place, and against the city.
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/PixelReflections.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace reflet {
namespace {

class PixelReflectionsInAStreet : public testing::Test {
protected:
    const test::BoxCity m_city = test::streetCity();
    const std::shared_ptr<const HeightfieldTracer> m_tracer =
        std::make_shared<HeightfieldTracer>(m_city.heightfield());
    const glm::dvec3 m_middle{1.7, -2.2, 1.6};
    const RemSet m_rems{m_city.see("west", {-8.0, -1.5, 2.0}, 128, 2),
                        m_city.see("middle", {2.0, -1.5, 2.0}, 128, 2),
                        m_city.see("east", {12.0, -1.5, 2.0}, 128, 2)};
    const PreparedRems m_prepared{m_tracer, m_rems};
    const ReconstructionInput m_input{m_tracer.get(), m_rems, 250.0, &m_prepared};
};

TEST_F(PixelReflectionsInAStreet, FromTheMiddleAreTheDenseMap) {
    for (const Weighting weighting : {Weighting::BySight, Weighting::AsInPaper}) {
        MemSettings settings;
        settings.resolution = 24;
        settings.weighting = weighting;
        const LocalEnvironmentMap map = reconstructDense(m_input, m_middle, settings);
        const PixelReflections pixels(m_input, m_middle, settings);
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < settings.resolution; ++row) {
                for (int column = 0; column < settings.resolution; ++column) {
                    const glm::dvec3 along = texelDirection(settings.resolution, face, column, row);
                    const glm::vec3 ours = pixels.radiance(m_middle, along);
                    const glm::vec3 expected = map.radiance.at(face, column, row);
                    ASSERT_EQ(ours, expected) << face << " " << column << " " << row;
                }
            }
        }
    }
}

/// Along the side of a long vehicle, rays that leave it sideways: what a ray meets is told by the
/// city itself. The map of the middle sees the same walls from up to 12 m beside.
TEST_F(PixelReflectionsInAStreet, AreTruerThanTheMapOfTheMiddleAllAlongAVehicle) {
    const MemSettings settings;
    const LocalEnvironmentMap map = reconstructDense(m_input, m_middle, settings);
    const PixelReflections pixels(m_input, m_middle, settings);
    double ours = 0.0, theirs = 0.0;
    std::size_t count = 0;
    for (double station = -12.0; station <= 12.0; station += 0.5) {
        for (const double side : {-1.0, 1.0}) {
            for (const double height : {0.8, 1.6, 2.6}) {
                for (const double turn : {-0.6, -0.2, 0.3, 0.7}) {
                    const glm::dvec3 from =
                        m_middle + glm::dvec3(station, 1.25 * side, height - m_middle.z);
                    const glm::dvec3 along(std::sin(turn), side * std::cos(turn), 0.15);
                    const glm::vec3 truth = m_city.radiance({from, along});
                    const auto error = [&](const glm::vec3& c) {
                        return std::abs(c.x - truth.x) + std::abs(c.y - truth.y) +
                               std::abs(c.z - truth.z);
                    };
                    ours += error(pixels.radiance(from, along));
                    theirs += error(sampleBilinear(map.radiance, along));
                    ++count;
                }
            }
        }
    }
    RecordProperty("perPixel", std::to_string(ours / double(count)));
    RecordProperty("oneMap", std::to_string(theirs / double(count)));
    EXPECT_LT(ours, 0.25 * theirs);
}

TEST_F(PixelReflectionsInAStreet, DoNotDependOnTheLengthOfTheDirection) {
    const PixelReflections pixels(m_input, m_middle, {});
    const glm::dvec3 along(0.3, -0.8, 0.2);
    const glm::vec3 once = pixels.radiance(m_middle, along);
    const glm::vec3 longer = pixels.radiance(m_middle, 7.5 * along);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(once[k], longer[k], 1e-4F);
}

TEST_F(PixelReflectionsInAStreet, WithoutMapsAreBlack) {
    const ReconstructionInput none{m_tracer.get(), {}, 250.0};
    const PixelReflections pixels(none, m_middle, {});
    EXPECT_EQ(pixels.radiance(m_middle, {0.0, 1.0, 0.0}), glm::vec3(0.0F));
}

}  // namespace
}  // namespace reflet
