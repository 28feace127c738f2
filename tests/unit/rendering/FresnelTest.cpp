// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/rendering/Fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

/// Fresnel's equations for unpolarised light on a dielectric of index n.
double exactFresnel(double cosine, double n) {
    const double t = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double s = (cosine - n * t) / (cosine + n * t);
    const double p = (n * cosine - t) / (n * cosine + t);
    return 0.5 * (s * s + p * p);
}

TEST(Fresnel, IsF0AtNormalIncidenceAndOneAtGrazing) {
    EXPECT_FLOAT_EQ(fresnelSchlick(kDielectricF0, 1.0F), 0.04F);
    EXPECT_FLOAT_EQ(fresnelSchlick(kDielectricF0, 0.0F), 1.0F);
    EXPECT_EQ(fresnelSchlick(glm::vec3(0.2F, 0.5F, 1.0F), 1.0F), glm::vec3(0.2F, 0.5F, 1.0F));
    EXPECT_EQ(fresnelSchlick(glm::vec3(0.2F, 0.5F, 1.0F), 0.0F), glm::vec3(1.0F));
}

TEST(Fresnel, FollowsFresnelsEquationsForGlass) {
    EXPECT_NEAR(kDielectricF0, exactFresnel(1.0, 1.5), 1e-6);
    for (double degrees = 0.0; degrees <= 89.0; degrees += 1.0) {
        const double cosine = std::cos(degrees * kPi / 180.0);
        // Schlick's fit is known to err by up to a few hundredths near grazing.
        EXPECT_NEAR(double(fresnelSchlick(kDielectricF0, float(cosine))), exactFresnel(cosine, 1.5),
                    0.06);
        if (degrees <= 60.0) {
            EXPECT_NEAR(double(fresnelSchlick(kDielectricF0, float(cosine))),
                        exactFresnel(cosine, 1.5), 0.02);
        }
    }
}

TEST(Fresnel, CountsBothFacesOfAPane) {
    // Between two faces of reflectance F the light bounces: F + F (1-F)² / (1 - F²) = 2 F / (1 +
    // F).
    EXPECT_NEAR(kGlazingF0, 2.0 * 0.04 / 1.04, 1e-3);
}

}  // namespace
}  // namespace reflet
