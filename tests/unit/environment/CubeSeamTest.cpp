// SPDX-License-Identifier: GPL-3.0-or-later
// Bilinear lookups across the edges and corners of the cube.
#include "core/environment/CubeDirection.h"
#include "core/math/Geometry.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace reflet {
namespace {

glm::dvec3 randomDirection(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
}

CubeMap<glm::vec3> randomMap(int resolution, unsigned seed) {
    CubeMap<glm::vec3> map(resolution);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    for (glm::vec3& texel : map.texels())
        texel = {value(random), value(random), value(random)};
    return map;
}

float largestStep(const CubeMap<glm::vec3>& map, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::vec3 d = sampleBilinear(map, from) - sampleBilinear(map, to);
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
}

TEST(CubeSeam, KeepsWeightsThatAreNotNegativeAndAddUpToOne) {
    std::mt19937_64 random(5);
    for (const int n : {1, 2, 3, 16, 128}) {
        for (int i = 0; i < 40000; ++i) {
            const BilinearFootprint footprint = bilinearFootprint(n, randomDirection(random));
            float sum = 0.0f;
            for (std::size_t k = 0; k < 4; ++k) {
                const Texel& texel = footprint.texel[k];
                ASSERT_GE(footprint.weight[k], 0.0f);
                ASSERT_TRUE(texel.face >= 0 && texel.face < 6);
                ASSERT_TRUE(texel.column >= 0 && texel.column < n);
                ASSERT_TRUE(texel.row >= 0 && texel.row < n);
                sum += footprint.weight[k];
            }
            ASSERT_NEAR(sum, 1.0f, 1e-6f);
        }
    }
}

TEST(CubeSeam, ReproducesEveryTexelAtItsOwnCentre) {
    for (const int n : {1, 2, 5, 32, 100}) {
        const CubeMap<glm::vec3> map = randomMap(n, 11);
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < n; ++row) {
                for (int column = 0; column < n; ++column) {
                    const glm::vec3 seen =
                        sampleBilinear(map, texelDirection(n, face, column, row));
                    ASSERT_LT(glm::length(seen - map.at(face, column, row)), 1e-6f);
                }
            }
        }
    }
}

TEST(CubeSeam, TakesTheTexelsBeyondAnEdgeThatAreNearestToIt) {
    // Brute force: of all texels of the cube, those on other faces whose centres lie nearest.
    constexpr int n = 9;
    std::mt19937_64 random(2);
    std::uniform_int_distribution<int> along(1, n - 2);
    int checked = 0;
    for (int face = 0; face < 6; ++face) {
        for (int side = 0; side < 4; ++side) {
            const int k = along(random);
            const double edge = side % 2 == 0 ? -1.0 : 1.0;
            const double middle = texelCoordinate(n, k);
            const glm::dvec2 st = side < 2 ? glm::dvec2(edge, middle) : glm::dvec2(middle, edge);
            const glm::dvec3 onEdge = glm::normalize(faceDirection(face, st));
            Texel nearest;
            double best = -2.0;
            for (int f = 0; f < 6; ++f) {
                for (int row = 0; row < n; ++row) {
                    for (int column = 0; column < n; ++column) {
                        const double c =
                            glm::dot(onEdge, glm::normalize(texelDirection(n, f, column, row)));
                        if (f != face && c > best) {
                            best = c;
                            nearest = {f, column, row};
                        }
                    }
                }
            }
            const glm::dvec3 inside = faceDirection(face, st * (1.0 - 1e-9));
            const BilinearFootprint footprint = bilinearFootprint(n, inside);
            const auto other = std::find_if(footprint.texel.begin(), footprint.texel.end(),
                                            [&](const Texel& t) { return t == nearest; });
            ASSERT_NE(other, footprint.texel.end());
            EXPECT_NEAR(footprint.weight[std::size_t(other - footprint.texel.begin())], 0.5f,
                        1e-5f);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 24);
}

TEST(CubeSeam, IsContinuousAcrossEveryEdge) {
    for (const int n : {1, 2, 6, 32}) {
        const CubeMap<glm::vec3> map = randomMap(n, 23);
        for (int face = 0; face < 6; ++face) {
            for (int side = 0; side < 4; ++side) {
                for (int i = 0; i <= 200; ++i) {
                    const double along = -1.0 + 2.0 * i / 200.0;
                    const double edge = side % 2 == 0 ? -1.0 : 1.0;
                    const glm::dvec2 st =
                        side < 2 ? glm::dvec2(edge, along) : glm::dvec2(along, edge);
                    const glm::dvec2 out = side < 2 ? glm::dvec2(edge, 0.0) : glm::dvec2(0.0, edge);
                    const glm::dvec3 here = faceDirection(face, st - 1e-7 * out);
                    const glm::dvec3 there = faceDirection(face, st + 1e-7 * out);
                    ASSERT_LT(largestStep(map, here, there), 1e-4f)
                        << n << " " << face << " " << along;
                }
            }
        }
    }
}

TEST(CubeSeam, IsContinuousAroundEveryCorner) {
    const CubeMap<glm::vec3> map = randomMap(8, 31);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 c(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 u = glm::normalize(glm::cross(c, glm::dvec3(1, 0.2, -0.4)));
        const glm::dvec3 v = glm::normalize(glm::cross(c, u));
        const auto around = [&](double angle, double radius) {
            return c + radius * (std::cos(angle) * u + std::sin(angle) * v);
        };
        for (const double radius : {1e-6, 0.05, 0.2}) {
            for (int i = 0; i < 3600; ++i) {
                const double angle = 2.0 * kPi * i / 3600.0;
                const double step = 2.0 * kPi / 3600.0;
                ASSERT_LT(largestStep(map, around(angle, radius), around(angle + step, radius)),
                          0.01f);
            }
        }
    }
}

TEST(CubeSeam, GivesTheMeanOfTheThreeTexelsAtACorner) {
    constexpr int n = 4;
    const CubeMap<glm::vec3> map = randomMap(n, 41);
    const glm::vec3 mean = (map.at(0, 0, 0) + map.at(2, n - 1, n - 1) + map.at(4, n - 1, 0)) / 3.0f;
    EXPECT_LT(glm::length(sampleBilinear(map, {1, 1, 1}) - mean), 1e-6f);
}

TEST(CubeSeam, FollowsASmoothFunctionOfDirectionEverywhere) {
    constexpr int n = 64;
    const auto f = [](const glm::dvec3& d) {
        const glm::dvec3 u = glm::normalize(d);
        return glm::vec3(0.5 + 0.5 * u.x * u.y, 0.5 + 0.5 * u.z, 0.5 + 0.25 * (u.x - u.y));
    };
    CubeMap<glm::vec3> map(n);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                map.at(face, column, row) = f(texelDirection(n, face, column, row));
            }
        }
    }
    std::mt19937_64 random(9);
    float worst = 0.0f;
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec3 direction = randomDirection(random);
        worst = std::max(worst, glm::length(sampleBilinear(map, direction) - f(direction)));
    }
    EXPECT_LT(worst, 0.02f);
    EXPECT_GT(worst, 0.0f);
}

}  // namespace
}  // namespace reflet
