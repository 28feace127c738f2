// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace reflet {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr glm::dvec3 kPosition(1.3, -2.1, 1.7);

struct Scene {
    test::BoxCity city = test::streetCity();
    HeightfieldTracer tracer{city.heightfield()};
    RemSet rems{city.see("a", {-6.5, -1.0, 2.0}, 32, 1), city.see("b", {8.5, -1.0, 2.0}, 32, 1)};
    ReconstructionInput input{&tracer, rems, 300.0};

    [[nodiscard]] MemFace build(int face, const MemSettings& settings) const {
        return buildMemFace(input, candidateRems(rems, kPosition, settings), kPosition, face,
                            settings);
    }
};

const Scene& scene() {
    static const Scene instance;
    return instance;
}

/// The paper's own setting: no refinement but by depth, nothing of ours.
MemSettings paperSettings(double depthRatio) {
    MemSettings settings;
    settings.depthRatio = depthRatio;
    settings.refineAtValidity = false;
    settings.traceEdgeTexels = false;
    settings.refineHits = false;
    settings.weighting = Weighting::AsInPaper;
    return settings;
}

using Rectangle = std::tuple<double, double, double, double>;

std::set<Rectangle> rectangles(const MemFace& face) {
    std::set<Rectangle> result;
    for (const MemQuad& q : face.quads)
        result.insert({q.s0, q.t0, q.s1, q.t1});
    return result;
}

/// The criterion as the paper writes it, for every pair of the four corners, by recursion, with a
/// new ray for every corner of every quad.
void splitNaively(const MemVertexTracer& tracer, int face, const MemSettings& settings, double s0,
                  double t0, double edge, std::set<Rectangle>& leaves) {
    const glm::dvec2 corners[4] = {
        {s0, t0}, {s0 + edge, t0}, {s0, t0 + edge}, {s0 + edge, t0 + edge}};
    double z[4];
    for (int k = 0; k < 4; ++k)
        z[k] = tracer.trace(faceDirection(face, corners[k])).distance;
    bool split = false;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            split = split ||
                    (i != j && std::abs(z[i] - z[j]) / std::min(z[i], z[j]) > settings.depthRatio);
        }
    }
    if (!split || 0.25 * edge * settings.resolution < std::max(1.0, settings.smallestQuad)) {
        leaves.insert({s0, t0, s0 + edge, t0 + edge});
        return;
    }
    const double half = 0.5 * edge;
    for (const double t : {t0, t0 + half}) {
        for (const double s : {s0, s0 + half})
            splitNaively(tracer, face, settings, s, t, half, leaves);
    }
}

TEST(MemMesh, SplitsExactlyWhereThePapersCriterionSays) {
    // N a power of two, so that the naive halving of doubles is exact as well.
    for (const double ratio : {0.05, 0.2, 1.0}) {
        MemSettings settings = paperSettings(ratio);
        settings.meshSize = 8;
        const MemVertexTracer tracer(
            scene().input, candidateRems(scene().rems, kPosition, settings), kPosition, false);
        std::size_t split = 0;
        for (int face = 0; face < 6; ++face) {
            std::set<Rectangle> expected;
            for (int j = 0; j < 8; ++j) {
                for (int i = 0; i < 8; ++i) {
                    splitNaively(tracer, face, settings, -1.0 + 0.25 * i, -1.0 + 0.25 * j, 0.25,
                                 expected);
                }
            }
            const MemFace mesh = scene().build(face, settings);
            ASSERT_EQ(rectangles(mesh), expected) << face;
            ASSERT_EQ(mesh.quads.size(), expected.size());
            split += expected.size() > 64 ? 1 : 0;
        }
        EXPECT_GE(split, 4u);
    }
}

TEST(MemMesh, StaysPlainWhenTheRatioIsInfinite) {
    MemSettings settings;  // everything else at its default
    settings.depthRatio = kNever;
    for (int face = 0; face < 6; ++face) {
        const MemFace mesh = scene().build(face, settings);
        EXPECT_EQ(mesh.quads.size(), 100u);
        EXPECT_EQ(mesh.vertices.size(), 121u);
    }
}

TEST(MemMesh, IsFullWhenTheRatioIsZero) {
    // 128 texels / 10 = 12.8, halved three times: 1.6, for 0.8 would be below a texel.
    const MemFace mesh = scene().build(5, paperSettings(0.0));
    EXPECT_EQ(mesh.quads.size(), 80u * 80u);
    EXPECT_EQ(mesh.vertices.size(), 81u * 81u);
    MemSettings toTexels = paperSettings(0.0);
    toTexels.traceEdgeTexels = true;
    EXPECT_EQ(scene().build(5, toTexels).quads.size(), 128u * 128u);
}

TEST(MemMesh, BecomesFullWhereverDistancesDifferAsTheRatioGoesToZero) {
    // Straight down there is but ground; no quad has four corners at the same distance.
    test::BoxCity city(-20, -20, 40, 40, 1.0);
    const HeightfieldTracer tracer(city.heightfield());
    const MemFace mesh =
        buildMemFace({&tracer, {}, 100.0}, {}, {0.1, 0.2, 1.0}, 5, paperSettings(1e-12));
    EXPECT_EQ(mesh.quads.size(), 80u * 80u);
}

TEST(MemMesh, MakesNoChildBelowTheSmallestQuadNorBelowATexel) {
    for (const auto& [smallest, edge] :
         {std::pair(4.0, 6.4), {6.4, 6.4}, {6.5, 12.8}, {1.0, 1.6}, {0.01, 1.6}}) {
        MemSettings settings = paperSettings(0.05);
        settings.smallestQuad = smallest;
        double least = kNever;
        for (const MemQuad& quad : scene().build(0, settings).quads)
            least = std::min(least, quad.s1 - quad.s0);
        EXPECT_NEAR(least * 0.5 * settings.resolution, edge, 1e-9) << smallest;
    }
}

TEST(MemMesh, TakesAMeshSizeBeyondTheResolutionAsOneQuadPerTexel) {
    MemSettings settings = paperSettings(kNever);
    settings.meshSize = 1000;
    settings.resolution = 16;
    EXPECT_EQ(scene().build(0, settings).quads.size(), 256u);
}

TEST(MemMesh, TracesEachDistinctVertexOnce) {
    std::size_t all = 0;
    for (int face = 0; face < 6; ++face) {
        const MemFace mesh = scene().build(face, MemSettings{});
        all += mesh.vertices.size();
        std::set<std::tuple<double, double, double>> directions;
        for (const MemVertex& v : mesh.vertices)
            directions.insert({v.direction.x, v.direction.y, v.direction.z});
        EXPECT_EQ(directions.size(), mesh.vertices.size());
    }
    EXPECT_GT(all, 6u * 121u);
}

TEST(MemMesh, PutsTheVerticesAtTheCornersOfTheirQuads) {
    for (int face = 0; face < 6; ++face) {
        const MemFace mesh = scene().build(face, MemSettings{});
        for (const MemQuad& q : mesh.quads) {
            const bool single = q.vertex[0] == q.vertex[3];
            const glm::dvec2 corners[4] = {{q.s0, q.t0}, {q.s1, q.t0}, {q.s0, q.t1}, {q.s1, q.t1}};
            for (std::size_t k = 0; k < 4; ++k) {
                const FacePoint at = facePoint(mesh.vertices[q.vertex[k]].direction);
                if (single) {
                    ASSERT_TRUE(at.st.x >= q.s0 && at.st.x < q.s1 && at.st.y >= q.t0 &&
                                at.st.y < q.t1);
                } else {
                    ASSERT_EQ(mesh.vertices[q.vertex[k]].direction,
                              faceDirection(face, corners[k]));
                }
            }
        }
    }
}

TEST(MemMesh, PartitionsTheFaceWithoutGapsOrOverlaps) {
    for (const int size : {3, 7, 10, 16}) {
        MemSettings settings;
        settings.meshSize = size;
        for (int face = 0; face < 6; ++face) {
            const MemFace mesh = scene().build(face, settings);
            double area = 0.0;
            for (const MemQuad& q : mesh.quads)
                area += (q.s1 - q.s0) * (q.t1 - q.t0);
            ASSERT_NEAR(area, 4.0, 1e-9);
            std::vector<int> owners(128 * 128);
            for (const MemQuad& q : mesh.quads) {
                const TexelRange columns = texelsWithin(128, q.s0, q.s1);
                const TexelRange rows = texelsWithin(128, q.t0, q.t1);
                for (int row = rows.first; row < rows.last; ++row) {
                    for (int column = columns.first; column < columns.last; ++column) {
                        ++owners[std::size_t(row * 128 + column)];
                        ASSERT_TRUE(texelCoordinate(128, column) >= q.s0 &&
                                    texelCoordinate(128, column) < q.s1);
                        ASSERT_TRUE(texelCoordinate(128, row) >= q.t0 &&
                                    texelCoordinate(128, row) < q.t1);
                    }
                }
            }
            ASSERT_TRUE(
                std::all_of(owners.begin(), owners.end(), [](int count) { return count == 1; }));
        }
    }
}

TEST(MemMesh, CoversRandomPointsOfTheFaceByExactlyOneLeaf) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const MemFace mesh = scene().build(0, MemSettings{});
    for (int i = 0; i < 2000; ++i) {
        const double s = coordinate(random);
        const double t = coordinate(random);
        const auto owners = std::count_if(
            mesh.quads.begin(), mesh.quads.end(),
            [&](const MemQuad& q) { return s >= q.s0 && s < q.s1 && t >= q.t0 && t < q.t1; });
        ASSERT_EQ(owners, 1);
    }
}

TEST(MemMesh, CountsTexelsByTheirCentresHalfOpen) {
    for (const int n : {1, 3, 8, 10, 128}) {
        for (int from = 0; from <= 2 * n; ++from) {
            for (int to = from; to <= 2 * n; ++to) {
                // Borders at multiples of half a texel: odd ones are centres.
                const TexelRange range =
                    texelsWithin(n, double(from) / n - 1.0, double(to) / n - 1.0);
                ASSERT_EQ(range.first, from / 2);
                ASSERT_EQ(range.last, to / 2);
            }
        }
    }
}

TEST(MemMesh, RefinesWhereValidityDiffersOnlyWhenTold) {
    // One flat wall at equal depth ratios, half of it hidden from the only REM by a screen that P,
    // standing beside it, does not see before the wall.
    test::BoxCity city(-30, -30, 60, 60, 1.0);
    city.addBox(-30, 20, 30, 22, 30.0f);
    city.addBox(-9, 9, -6, 10, 30.0f);
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems{city.see("a", {-12.0, 0.0, 5.0}, 128, 1)};
    const ReconstructionInput input{&tracer, rems, 100.0};
    MemSettings settings = paperSettings(1e6);
    const RemCandidates candidates = candidateRems(rems, {0, 15, 5}, settings);
    const MemFace plain = buildMemFace(input, candidates, {0, 15, 5}, 2, settings);
    EXPECT_EQ(plain.quads.size(), 100u);
    settings.refineAtValidity = true;
    const MemFace refined = buildMemFace(input, candidates, {0, 15, 5}, 2, settings);
    EXPECT_GT(refined.quads.size(), 150u);
    for (const MemQuad& q : refined.quads) {
        if (q.s1 - q.s0 < 0.03)
            continue;  // 1.6 texels: as small as they get
        const auto& v = refined.vertices;
        for (const std::uint32_t k : q.vertex) {
            ASSERT_EQ(v[k].validA, v[q.vertex[0]].validA);
            ASSERT_EQ(v[k].sky, v[q.vertex[0]].sky);
        }
    }
}

TEST(MemMesh, GivesTexelsAtSilhouettesARayThroughTheirCentres) {
    MemSettings settings;
    std::size_t single = 0;
    for (int face = 0; face < 6; ++face) {
        const MemFace mesh = scene().build(face, settings);
        for (const MemQuad& q : mesh.quads) {
            if (q.vertex[0] != q.vertex[3])
                continue;
            const TexelRange columns = texelsWithin(128, q.s0, q.s1);
            const TexelRange rows = texelsWithin(128, q.t0, q.t1);
            ASSERT_EQ(columns.last - columns.first, 1);
            ASSERT_EQ(rows.last - rows.first, 1);
            ASSERT_EQ(mesh.vertices[q.vertex[0]].direction,
                      texelDirection(128, face, columns.first, rows.first));
            ++single;
        }
    }
    EXPECT_GT(single, 500u);
    settings.smallestQuad = 1.5;  // a threshold of the user's: no single texels
    for (const MemQuad& q : scene().build(0, settings).quads)
        ASSERT_NE(q.vertex[0], q.vertex[3]);
}

TEST(MemMesh, NeverSplitsAPlaneByTheErrorBoundHoweverSlanted) {
    // A wall seen at a grazing angle: distances along it differ by far more than R allows.
    test::BoxCity city(-200, -30, 400, 60, 1.0);
    city.addBox(-200, 4, 200, 8, 200.0F);
    const HeightfieldTracer tracer(city.heightfield());
    const glm::dvec3 position(0.0, 2.0, 90.0);
    const RemSet rems{test::plainMap("a", {-6, 1, 88}, 8, glm::vec3(0.5F), kInfinity),
                      test::plainMap("b", {9, -1, 91}, 8, glm::vec3(0.5F), kInfinity)};
    const ReconstructionInput input{&tracer, rems, 1000.0};
    MemSettings settings;
    settings.refineHits = false;
    settings.meshSize = 8;
    const auto quadsOnTheWall = [&] {
        const MemFace mesh =
            buildMemFace(input, candidateRems(rems, position, settings), position, 2, settings);
        return mesh.quads.size();
    };
    const std::size_t byDepth = quadsOnTheWall();
    settings.errorBound = 0.01;
    EXPECT_EQ(quadsOnTheWall(), 64U);
    EXPECT_EQ(byDepth, 64U) << "straight ahead the wall is not slanted";
    const auto sideways = [&](double errorBound) {
        settings.errorBound = errorBound;
        return buildMemFace(input, candidateRems(rems, position, settings), position, 0, settings)
            .quads.size();
    };
    const std::size_t slantedByDepth = sideways(0.0);
    const std::size_t slantedByError = sideways(0.5);
    EXPECT_LT(slantedByError, slantedByDepth / 2);
}

TEST(MemMesh, KeepsLookupsWithinTheErrorBound) {
    // Every texel's look-up, as interpolated, against that of a ray of its own.
    for (const double bound : {4.0, 1.0, 0.25}) {
        MemSettings settings;
        settings.errorBound = bound;
        settings.refineHits = false;
        std::size_t checked = 0, beyond = 0, rays = 0;
        for (int face = 0; face < 6; ++face) {
            const MemVertexTracer tracer(
                scene().input, candidateRems(scene().rems, kPosition, settings), kPosition, false);
            const MemFace mesh = scene().build(face, settings);
            rays += mesh.vertices.size();
            for (const MemQuad& q : mesh.quads) {
                const TexelRange columns = texelsWithin(128, q.s0, q.s1);
                const TexelRange rows = texelsWithin(128, q.t0, q.t1);
                if (columns.empty() || rows.empty() || q.vertex[0] == q.vertex[3])
                    continue;
                const int column = (columns.first + columns.last) / 2;
                const int row = (rows.first + rows.last) / 2;
                const MemVertex truth = tracer.trace(texelDirection(128, face, column, row));
                const double u = (texelCoordinate(128, column) - q.s0) / (q.s1 - q.s0);
                const double v = (texelCoordinate(128, row) - q.t0) / (q.t1 - q.t0);
                const auto w = [&](std::size_t k) {
                    return mesh.vertices[q.vertex[k]].inverseDepth;
                };
                const double inverse =
                    (1 - v) * ((1 - u) * w(0) + u * w(1)) + v * ((1 - u) * w(2) + u * w(3));
                for (std::size_t i = 0; i < scene().rems.size(); ++i) {
                    const glm::dvec3 offset = kPosition - scene().rems[i].center;
                    const double angle = glm::distance(
                        glm::normalize(truth.direction + inverse * offset),
                        glm::normalize(truth.direction + truth.inverseDepth * offset));
                    ++checked;
                    beyond += angle * 128.0 / (0.5 * kPi) > 2.0 * bound ? 1 : 0;
                }
            }
        }
        EXPECT_GT(checked, 600U);
        EXPECT_LT(double(beyond), 0.06 * double(checked)) << "bound " << bound;
        EXPECT_LT(rays, 60000U);
    }
}

}  // namespace
}  // namespace reflet
