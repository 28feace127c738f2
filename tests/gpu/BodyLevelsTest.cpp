// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/BodyLevels.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace reflet::test {
namespace {

constexpr int kRings = 64;

/// A sphere of 1 m radius; its lower half is glass of material 1.
BodyMesh sphere() {
    BodyMesh mesh;
    const auto at = [&](int i, int j, std::uint32_t material) {
        const double polar = 3.14159265358979 * i / kRings;
        const double around = 3.14159265358979 * (j % (2 * kRings)) / kRings;
        const double across = i == 0 || i == kRings ? 0.0 : std::sin(polar);
        const glm::vec3 p(across * std::cos(around), across * std::sin(around), std::cos(polar));
        mesh.vertices.push_back({p, p, material});
        return std::uint32_t(mesh.vertices.size() - 1);
    };
    for (int i = 0; i < kRings; ++i) {
        const std::uint32_t material = i < kRings / 2 ? 0U : 1U;
        auto& indices = material == 0 ? mesh.opaque : mesh.glass;
        for (int j = 0; j < 2 * kRings; ++j) {
            const std::uint32_t a = at(i, j, material), b = at(i + 1, j, material);
            const std::uint32_t c = at(i + 1, j + 1, material), d = at(i, j + 1, material);
            indices.insert(indices.end(), {a, b, c, a, c, d});
        }
    }
    return mesh;
}

using Place = std::tuple<float, float, float>;

/// Edges, by places, that do not have as many triangles one way as the other.
std::size_t openEdges(const BodyMesh& mesh) {
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](std::uint32_t v) {
        const glm::vec3& p = mesh.vertices[v].position;
        return Place{p.x, p.y, p.z};
    };
    for (const auto* indices : {&mesh.opaque, &mesh.glass}) {
        for (std::size_t i = 0; i < indices->size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Place a = place((*indices)[i + k]);
                const Place b = place((*indices)[i + (k + 1) % 3]);
                if (a != b)
                    edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        }
    }
    std::size_t open = 0;
    for (const auto& [edge, balance] : edges)
        open += balance != 0;
    return open;
}

TEST(BodyLevels, JoiningVerticesOpensNoCracks) {
    const BodyMesh exact = sphere();
    ASSERT_EQ(openEdges(exact), 0U);
    for (const float cell : {0.02F, 0.1F, 0.3F})
        EXPECT_EQ(openEdges(clustered(exact, cell)), 0U) << cell;
}

TEST(BodyLevels, VerticesStayWithinACellOfTheSurfaceAndKeepTheirDirection) {
    const BodyMesh exact = sphere();
    for (const float error : {0.02F, 0.1F, 0.3F}) {
        const BodyMesh mesh = coarser(exact, error);
        ASSERT_FALSE(mesh.opaque.empty());
        ASSERT_FALSE(mesh.glass.empty());
        for (const BodyVertex& v : mesh.vertices) {
            EXPECT_LE(std::abs(glm::length(v.position) - 1.0F), error * std::sqrt(3.0F));
            EXPECT_NEAR(glm::length(v.normal), 1.0F, 1e-4F);
            EXPECT_GT(glm::dot(v.normal, glm::normalize(v.position)), 0.7F);
        }
    }
}

TEST(BodyLevels, CoarserMeshesHaveFewerTrianglesOfTheSameMaterials) {
    const BodyMesh exact = sphere();
    const std::size_t all = exact.opaque.size() + exact.glass.size();
    for (const float error : {0.05F, 0.1F, 0.2F}) {
        const BodyMesh mesh = coarser(exact, error);
        EXPECT_LT(4 * (mesh.opaque.size() + mesh.glass.size()), all) << error;
        for (const std::uint32_t v : mesh.opaque)
            EXPECT_EQ(mesh.vertices.at(v).material, 0U);
        for (const std::uint32_t v : mesh.glass)
            EXPECT_EQ(mesh.vertices.at(v).material, 1U);
    }
}

TEST(BodyLevels, WhatIsSmallerThanACellGoesAndNothingStaysNothing) {
    BodyMesh speck;
    speck.vertices = {{{0.01F, 0.01F, 0.01F}, {0, 0, 1}, 0},
                      {{0.02F, 0.01F, 0.01F}, {0, 0, 1}, 0},
                      {{0.01F, 0.02F, 0.01F}, {0, 0, 1}, 0}};
    speck.opaque = {0, 1, 2};
    EXPECT_TRUE(coarser(speck, 0.1F).opaque.empty());
    EXPECT_EQ(clustered(speck, 0.001F).opaque.size(), 3U);
    EXPECT_TRUE(coarser({}, 0.1F).vertices.empty());
}

}  // namespace
}  // namespace reflet::test
