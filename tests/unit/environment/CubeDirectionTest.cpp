// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/FaceDirections.h"
#include "core/math/Geometry.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <random>
#include <string_view>

namespace reflet {
namespace {

/// GL 4.5 core, table 8.19, as printed there: the major axis, then which components are s_c, t_c
/// and m_a (+1 = rx, -3 = -rz, ...). Written down apart from the code under test.
struct GlRow {
    int majorAxis;
    int sc, tc, ma;
};
constexpr GlRow kGlTable[6] = {
    {+1, -3, -2, +1}, {-1, +3, -2, +1}, {+2, +1, +3, +2},
    {-2, +1, -3, +2}, {+3, +1, -2, +3}, {-3, -1, -2, +3},
};

double component(const glm::dvec3& r, int signedAxis) {
    const double value = r[std::abs(signedAxis) - 1];
    return signedAxis < 0 ? -value : value;
}

/// s = ½ (s_c / |m_a| + 1), GL 4.5 core, equation 8.23.
glm::dvec2 glTextureCoordinates(int face, const glm::dvec3& r) {
    const GlRow& row = kGlTable[face];
    const double ma = std::abs(component(r, row.ma));
    return {0.5 * (component(r, row.sc) / ma + 1.0), 0.5 * (component(r, row.tc) / ma + 1.0)};
}

glm::dvec3 randomDirection(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
}

constexpr int kResolutions[] = {1, 2, 3, 7, 10, 64, 100, 128, 333};

TEST(CubeDirection, ReturnsToTheSameTexelFromItsDirectionAtEveryResolution) {
    for (const int n : kResolutions) {
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < n; ++row) {
                for (int column = 0; column < n; ++column) {
                    const glm::dvec3 direction = texelDirection(n, face, column, row);
                    ASSERT_EQ(texelAt(n, direction), (Texel{face, column, row}));
                    ASSERT_EQ(texelAt(n, 1234.5 * direction), (Texel{face, column, row}));
                }
            }
        }
    }
}

TEST(CubeDirection, GivesBackFaceCoordinatesExactlyForDirectionsScaledToTheAxis) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> inside(-0.999999, 0.999999);
    for (int i = 0; i < 60000; ++i) {
        const int face = i % 6;
        const glm::dvec2 st(inside(random), inside(random));
        const FacePoint back = facePoint(faceDirection(face, st));
        ASSERT_EQ(back.face, face);
        ASSERT_EQ(back.st.x, st.x);
        ASSERT_EQ(back.st.y, st.y);
    }
}

TEST(CubeDirection, ScalesFaceDirectionsToOneAlongTheFacesAxis) {
    for (int face = 0; face < 6; ++face) {
        const glm::dvec3 direction = faceDirection(face, {0.25, -0.75});
        EXPECT_EQ(glm::dot(direction, faceAxis(face)), 1.0);
        EXPECT_EQ(faceDirection(face, {0.0, 0.0}), faceAxis(face));
    }
}

TEST(CubeDirection, AgreesWithTheTableOfTheOpenGlSpecification) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec3 r = randomDirection(random);
        const FacePoint point = facePoint(r);
        const int major = kGlTable[point.face].majorAxis;
        ASSERT_GT(component(r, major), 0.0);
        for (int axis = 1; axis <= 3; ++axis) {
            ASSERT_GE(component(r, major), std::abs(component(r, axis)));
        }
        const glm::dvec2 expected = glTextureCoordinates(point.face, r);
        ASSERT_NEAR(0.5 * (point.st.x + 1.0), expected.x, 1e-15);
        ASSERT_NEAR(0.5 * (point.st.y + 1.0), expected.y, 1e-15);
    }
}

TEST(CubeDirection, ListsTheDirectionsOfAFaceRowByRowExactly) {
    const std::vector<double> s{-1.0, -0.3, 0.0, 0.7}, t{-0.9, 0.1, 1.0 / 3.0};
    for (int face = 0; face < 6; ++face) {
        const DirectionGrid grid = faceDirections(face, s, t);
        ASSERT_EQ(grid.size(), 12U);
        for (std::size_t row = 0; row < t.size(); ++row) {
            for (std::size_t column = 0; column < s.size(); ++column)
                EXPECT_EQ(grid.at(column, row), faceDirection(face, {s[column], t[row]}));
        }
        EXPECT_EQ(grid.alongRows(), face == 0 || face == 1) << "of the sides, z goes with s";
        EXPECT_EQ(grid.alongColumns(), face == 2 || face == 3) << "or with t";
    }
}

TEST(CubeDirection, GivesTiesToXThenToY) {
    EXPECT_EQ(facePoint({1, 1, 1}).face, 0);
    EXPECT_EQ(facePoint({-1, 1, -1}).face, 1);
    EXPECT_EQ(facePoint({0.5, 1, 1}).face, 2);
    EXPECT_EQ(facePoint({0.5, -1, 1}).face, 3);
    EXPECT_EQ(facePoint({0.5, -0.9, 1}).face, 4);
    EXPECT_EQ(facePoint({0.5, -0.9, -1}).face, 5);
}

TEST(CubeDirection, AddsSolidAnglesOfAllTexelsUpToAWholeSphere) {
    for (const int n : kResolutions) {
        double sum = 0.0;
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column)
                sum += texelSolidAngle(n, column, row);
        }
        EXPECT_NEAR(6.0 * sum, 4.0 * kPi, 1e-11) << n;
    }
}

TEST(CubeDirection, MatchesSolidAnglesIntegratedNumerically) {
    // dω = dA / (1 + s² + t²)^(3/2) on the plane at distance 1, by the midpoint rule.
    constexpr int n = 8;
    constexpr int steps = 400;
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            double sum = 0.0;
            for (int j = 0; j < steps; ++j) {
                for (int i = 0; i < steps; ++i) {
                    const double s = 2.0 * (column + (i + 0.5) / steps) / n - 1.0;
                    const double t = 2.0 * (row + (j + 0.5) / steps) / n - 1.0;
                    sum += std::pow(1.0 + s * s + t * t, -1.5);
                }
            }
            const double area = 4.0 / (double(n) * n * steps * steps);
            ASSERT_NEAR(texelSolidAngle(n, column, row), sum * area, 1e-8);
        }
    }
}

TEST(CubeDirection, CountsRandomDirectionsInProportionToSolidAngle) {
    constexpr int n = 4;
    constexpr int count = 600000;
    std::vector<int> hits(6 * n * n);
    std::mt19937_64 random(3);
    for (int i = 0; i < count; ++i) {
        const Texel texel = texelAt(n, randomDirection(random));
        ++hits[std::size_t((texel.face * n + texel.row) * n + texel.column)];
    }
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const double expected = count * texelSolidAngle(n, column, row) / (4.0 * kPi);
                const int found = hits[std::size_t((face * n + row) * n + column)];
                ASSERT_NEAR(found, expected, 5.0 * std::sqrt(expected));
            }
        }
    }
}

// The orientation card: every face bears a letter that no turn or mirroring maps onto itself.
// Someone inside the cube who looks along `ahead`, with `up` upwards, sees it the right way round
// when `right` is what lies to the right in the stored picture. Cube maps are left-handed inside:
// the frames below are written by hand from the GL table.
struct Card {
    std::string_view letter;  ///< 7 rows of 7, # = ink
    glm::dvec3 ahead, right, down;
};
constexpr std::string_view kF =
    "......."
    ".#####."
    ".#....."
    ".####.."
    ".#....."
    ".#....."
    ".......";
constexpr std::string_view kG =
    "......."
    "..####."
    ".#....."
    ".#..##."
    ".#...#."
    "..####."
    ".......";
constexpr std::string_view kJ =
    "......."
    ".#####."
    "....#.."
    "....#.."
    ".#..#.."
    "..##..."
    ".......";
constexpr std::string_view kP =
    "......."
    ".####.."
    ".#...#."
    ".####.."
    ".#....."
    ".#....."
    ".......";
constexpr std::string_view kQ =
    "......."
    "..###.."
    ".#...#."
    ".#.#.#."
    "..###.."
    ".....#."
    ".......";
constexpr std::string_view kR =
    "......."
    ".####.."
    ".#...#."
    ".####.."
    ".#..#.."
    ".#...#."
    ".......";
const Card kCards[6] = {
    {kF, {+1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {kG, {-1, 0, 0}, {0, 0, +1}, {0, -1, 0}},
    {kJ, {0, +1, 0}, {+1, 0, 0}, {0, 0, +1}}, {kP, {0, -1, 0}, {+1, 0, 0}, {0, 0, -1}},
    {kQ, {0, 0, +1}, {+1, 0, 0}, {0, -1, 0}}, {kR, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

TEST(CubeDirection, ReadsEachLetterOfTheOrientationCardTheRightWayRound) {
    constexpr int n = 7;
    CubeMap<glm::vec3> map(n);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const char ink = kCards[face].letter[std::size_t(row * n + column)];
                map.at(face, column, row) = glm::vec3(ink == '#' ? float(face + 1) : 0.0f);
            }
        }
    }
    for (int face = 0; face < 6; ++face) {
        const Card& card = kCards[face];
        std::string seen;
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const double x = (column - 3) * 2.0 / n;
                const double y = (row - 3) * 2.0 / n;
                const glm::dvec3 direction = 9.0 * (card.ahead + x * card.right + y * card.down);
                const float value = sampleBilinear(map, direction).x;
                EXPECT_TRUE(std::abs(value) < 1e-5f || std::abs(value - float(face + 1)) < 1e-5f);
                seen += value > 0.5f ? '#' : '.';
            }
        }
        EXPECT_EQ(seen, card.letter);
    }
}

}  // namespace
}  // namespace reflet
