// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/MeshCutting.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/PlaneShapes.h"
#include "core/traffic/SplineSurface.h"
#include "core/traffic/VehicleShell.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace reflet {
namespace {

double areaOf(const PartMesh& mesh, int material = -1) {
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (material < 0 || mesh.material[i] == material) {
            const glm::uvec3 t = mesh.triangles[i];
            area +=
                0.5 * double(glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                    mesh.positions[t.z] - mesh.positions[t.x])));
        }
    }
    return area;
}

double volumeOf(const PartMesh& mesh) {
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        volume += double(glm::dot(mesh.positions[t.x],
                                  glm::cross(mesh.positions[t.y], mesh.positions[t.z]))) /
                  6.0;
    }
    return volume;
}

PartMesh plate() {
    return gridSurface(11, 11, false, 0, 0.5F, [](int i, int j) {
        return GridPoint{{0.0F, 0.1F * float(j), 0.1F * float(i)}, {}};
    });
}

TEST(MeshPrimitives, EncloseTheVolumesOfTheirSolids) {
    EXPECT_NEAR(volumeOf(roundedBox({5, 1, 2}, {2, 3, 4}, 0.0F, 0)), 24.0, 1e-3);
    // A box with rounded edges is a sum of boxes, quarter cylinders and a ball (Steiner's formula).
    const double r = 0.3;
    const double a = 2 - 2 * r;
    const double b = 3 - 2 * r;
    const double c = 4 - 2 * r;
    const double steiner = a * b * c + 2 * r * (a * b + b * c + c * a) + kPi * r * r * (a + b + c) +
                           4.0 / 3.0 * kPi * r * r * r;
    EXPECT_NEAR(volumeOf(roundedBox({0, 0, 0}, {2, 3, 4}, 0.3F, 0)), steiner, 0.005 * steiner);
    EXPECT_NEAR(volumeOf(cylinder({1, 2, 3}, {1, 6, 3}, 0.5F, 200, 0)), kPi * 0.25 * 4.0, 0.002);
    EXPECT_NEAR(volumeOf(ellipsoid({1, 1, 1}, {1, 2, 3}, 200, 0)), 4.0 / 3.0 * kPi * 6.0, 0.02);
    EXPECT_NEAR(volumeOf(tube({{0, 0, 0}, {4, 0, 0}}, 0.25F, 200, 0)), kPi * 0.0625 * 4.0, 0.001);
    EXPECT_NEAR(volumeOf(extrudedAcross({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, -1.0F, 2.0F, 0)), 6.0,
                1e-4);
    // A torus: 2 π² R r².
    std::vector<glm::vec2> ring;
    for (int i = 0; i <= 96; ++i) {
        const float angle = 2.0F * float(kPi) * float(i % 96) / 96.0F;
        ring.emplace_back(2.0F + 0.5F * std::cos(angle), 0.5F * std::sin(angle));
    }
    EXPECT_NEAR(volumeOf(lathe(ring, {0, 0, 0}, {0, 1, 0}, 200, 2.0F, 0)),
                2 * kPi * kPi * 2.0 * 0.25, 0.02);
}

TEST(MeshPrimitives, FaceOutwardsWhenMirroredOrTurned) {
    const PartMesh box = roundedBox({1, 2, 3}, {1, 1, 1}, 0.1F, 0);
    EXPECT_NEAR(volumeOf(mirroredLeftRight(box)), volumeOf(box), 1e-4);
    EXPECT_NEAR(volumeOf(turnedAround(box)), volumeOf(box), 1e-4);
    EXPECT_NEAR(mirroredLeftRight(box).positions.front().y, -box.positions.front().y, 1e-6);
}

TEST(MeshPrimitives, LayDotsWithinTheirWidth) {
    const PartMesh text = dotText("T1-A", {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.1F, 3);
    ASSERT_GT(text.triangles.size(), 50U);
    EXPECT_EQ(dotTextWidth("T1-A"), 23);
    for (const glm::vec3& p : text.positions) {
        EXPECT_GE(p.y, -1e-6F);
        EXPECT_LE(p.y, 2.3F);
        EXPECT_LE(p.z, 0.7F);
    }
    EXPECT_GT(text.normals.front().x, 0.99F);
}

TEST(MeshCutting, CutsADiscOfItsAreaOutOfAPlate) {
    PartMesh mesh = plate();
    paint(
        mesh,
        [](const SurfacePoint& p) {
            return glm::distance(glm::vec2(p.position.y, p.position.z), {0.5F, 0.5F}) - 0.3F;
        },
        7);
    EXPECT_NEAR(areaOf(mesh), 1.0, 1e-5);
    EXPECT_NEAR(areaOf(mesh, 7), kPi * 0.09, 0.003);
    for (const glm::vec3& n : mesh.normals) {
        EXPECT_NEAR(n.x, 1.0F, 1e-5F);
    }
}

TEST(MeshCutting, DrawsBandsThinnerThanItsTriangles) {
    PartMesh mesh = plate();
    outline(
        mesh,
        [](const SurfacePoint& p) {
            return roundedRectangle({p.position.y, p.position.z}, {0.23F, 0.23F}, {0.77F, 0.77F},
                                    0.0F);
        },
        0.004F, 5);
    EXPECT_NEAR(areaOf(mesh, 5), 4 * 0.54 * 0.004, 0.0006);
}

TEST(MeshCutting, SinksTheInsideByItsDepth) {
    PartMesh mesh = plate();
    inset(
        mesh,
        [](const SurfacePoint& p) {
            return roundedRectangle({p.position.y, p.position.z}, {0.2F, 0.2F}, {0.8F, 0.8F},
                                    0.05F);
        },
        0.02F, 0.03F, 1, 2);
    int sunk = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int k = 0; mesh.material[i] == 2 && k < 3; ++k) {
            EXPECT_NEAR(mesh.positions[mesh.triangles[i][k]].x, -0.03F, 1e-4F);
            ++sunk;
        }
    }
    EXPECT_GT(sunk, 30);
    EXPECT_GT(areaOf(mesh, 1), 0.04);
}

TEST(MeshCutting, RemovesTheInsideAndSplitsInHalves) {
    PartMesh mesh = ellipsoid({0, 0, 0}, {1, 1, 1}, 64, 0);
    const double whole = areaOf(mesh);
    const SplitMesh halves = splitAcross(mesh);
    EXPECT_NEAR(areaOf(halves.rear), 0.5 * whole, 1e-3);
    EXPECT_NEAR(areaOf(halves.front), 0.5 * whole, 1e-3);
    for (const glm::vec3& p : halves.rear.positions) {
        EXPECT_LE(p.x, 1e-5F);
    }
    removeInside(mesh, [](const SurfacePoint& p) { return p.position.z - 0.5F; });
    EXPECT_NEAR(areaOf(mesh), 2 * kPi * 0.5, 0.02);  // Archimedes: the area of a cap is 2 π r h
}

TEST(PlaneShapes, MeasureSignedDistances) {
    EXPECT_NEAR(roundedRectangle({0, 0}, {-2, -1}, {2, 1}, 0.2F), -1.0F, 1e-6F);
    EXPECT_NEAR(roundedRectangle({5, 0}, {-2, -1}, {2, 1}, 0.2F), 3.0F, 1e-6F);
    EXPECT_NEAR(roundedRectangle({2, 1}, {-2, -1}, {2, 1}, 0.5F), 0.5F * (std::sqrt(2.0F) - 1.0F),
                1e-6F);
    const RoundedPolygon square({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.5F);
    EXPECT_NEAR(square.distance({0, 0}), -1.0F, 1e-5F);
    EXPECT_NEAR(square.distance({1.25F, 0}), 0.25F, 1e-5F);
    EXPECT_NEAR(square.distance({1, 1}), 0.5F * (std::sqrt(2.0F) - 1.0F), 0.01F);
}

TEST(PlaneShapes, DrawCurvesThroughTheirKnotsWithoutOvershoot) {
    const Curve curve{{0, 0}, {1, 0}, {2, 1}, {3, 1}};
    EXPECT_FLOAT_EQ(curve(1.0F), 0.0F);
    EXPECT_FLOAT_EQ(curve(2.0F), 1.0F);
    EXPECT_FLOAT_EQ(curve(-5.0F), 0.0F);
    EXPECT_FLOAT_EQ(curve(9.0F), 1.0F);
    float last = 0.0F;
    for (float x = 0.0F; x < 3.0F; x += 0.01F) {
        EXPECT_GE(curve(x), last - 1e-6F);
        EXPECT_LE(curve(x), 1.0F + 1e-6F);
        last = curve(x);
    }
}

/// Edges (by position) that are not run once each way: none on a closed, consistently turned
/// surface.
int openEdges(const PartMesh& mesh) {
    std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> balance;
    const auto key = [](const glm::vec3& p) {
        return std::array<long, 3>{std::lround(p.x * 2e4F), std::lround(p.y * 2e4F),
                                   std::lround(p.z * 2e4F)};
    };
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const auto a = key(mesh.positions[t[k]]);
            const auto b = key(mesh.positions[t[(k + 1) % 3]]);
            if (a != b) {
                balance[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
    }
    return int(
        std::count_if(balance.begin(), balance.end(), [](const auto& e) { return e.second != 0; }));
}

TEST(MeshPrimitives, AreClosed) {
    EXPECT_EQ(openEdges(roundedBox({0, 0, 0}, {2, 1, 1}, 0.1F, 0)), 0);
    EXPECT_EQ(openEdges(cylinder({0, 0, 0}, {0, 2, 0}, 0.5F, 24, 0)), 0);
    EXPECT_EQ(openEdges(ellipsoid({0, 0, 0}, {1, 2, 3}, 32, 0)), 0);
    EXPECT_EQ(openEdges(tube({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}, 0.1F, 12, 0)), 0);
    EXPECT_GT(openEdges(plate()), 0);
}

TEST(MeshCutting, OpensNoCracksInAClosedSurface) {
    PartMesh mesh = ellipsoid({0, 0, 0}, {1, 1, 1}, 48, 0);
    const RoundedPolygon star({{0, 0.8F},
                               {0.2F, 0.2F},
                               {0.8F, 0},
                               {0.2F, -0.2F},
                               {0, -0.8F},
                               {-0.2F, -0.2F},
                               {-0.8F, 0},
                               {-0.2F, 0.2F}},
                              0.05F);
    const Region region = [&](const SurfacePoint& p) {
        return std::max(star.distance({p.position.x, p.position.z}), 0.3F * p.position.y);
    };
    paint(mesh, region, 1);
    outline(mesh, region, 0.006F, 2);
    inset(mesh, region, 0.01F, 0.01F, 3, 4);
    EXPECT_GT(areaOf(mesh, 4), 0.2);
    EXPECT_EQ(openEdges(mesh), 0);
}

TEST(SplineSurface, IsClosedWhenItsEndRowsCollapse) {
    SplineNet net;
    for (int i = 0; i < 6; ++i) {
        const float x = float(i);
        const float h = i == 0 || i == 5 ? 0.0F : 1.0F;
        net.rows.push_back({{x, 0, -h}, {x, 0.5F, -h}, {x, 1, 0}, {x, 0.5F, h}, {x, 0, h}});
    }
    const PartMesh mesh = splineSurface(net, 0);
    EXPECT_EQ(openEdges(mesh), 0);
    EXPECT_GT(volumeOf(mesh), 2.0);
}

TEST(VehicleShell, IsAClosedPrismWithRoundedEnds) {
    ShellSpec spec;
    spec.halfSection = roundedPath({{{0, 0}, 0}, {{1, 0}, 0}, {{1, 2}, 0}, {{0, 2}, 0}}, 0.1F, 4);
    spec.rear = {-3.0F, Curve{{0, 1}, {2, 1}}, 2.0F, 40};
    spec.front = {3.0F, Curve{{0, 1}, {2, 1}}, 2.0F, 40};
    const Shell shell = vehicleShell(spec, 0);
    // A box of 6 × 2 × 2 and two half cylinders of radius 1 and height 2.
    EXPECT_NEAR(volumeOf(shell.mesh), 24.0 + 2.0 * kPi, 0.03);
    EXPECT_EQ(openEdges(shell.mesh), 0);
    EXPECT_NEAR(shell.frontTip, 3.0F + 0.5F * float(kPi), 0.002F);
    EXPECT_NEAR(shell.rearTip, -shell.frontTip, 1e-4F);
}

TEST(SplineSurface, ReproducesACylinderOfItsControlPrism) {
    // On a straight prism the rows do not matter: the ends lie on the first and last row.
    SplineNet net;
    for (int i = 0; i < 5; ++i) {
        const float x = float(i);
        net.rows.push_back({{x, 0, -1}, {x, 0.5F, -1}, {x, 1, 0}, {x, 0.5F, 1}, {x, 0, 1}});
    }
    const PartMesh mesh = splineSurface(net, 0);
    float low = 1e9F;
    float high = -1e9F;
    for (const glm::vec3& p : mesh.positions) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
        EXPECT_LE(std::abs(p.z), 1.00001F);  // within the convex hull
    }
    EXPECT_NEAR(low, 0.0F, 1e-5F);
    EXPECT_NEAR(high, 4.0F, 1e-5F);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        EXPECT_GT(glm::dot(mesh.normals[i], glm::vec3(0, mesh.positions[i].y, mesh.positions[i].z)),
                  0.0F);
        EXPECT_NEAR(mesh.normals[i].x, 0.0F, 2e-3F);
    }
}

}  // namespace
}  // namespace reflet
