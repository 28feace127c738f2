// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityMesh.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/city/PartSizes.h"
#include "tests/unit/baking/BakingScenes.h"

#include <glm/geometric.hpp>

#include <array>
#include <set>

namespace reflet::test {
namespace {

using testing::SceneBuilder;

TEST(PartSizes, APartIsWhatHangsTogetherInOneObject) {
    SceneBuilder b;
    const auto pole = b.object("pole", CityObjectType::CityFurniture);
    b.box(pole, {0, 0, 0}, {1, 2, 8});
    b.box(pole, {5, 0, 0}, {5.5F, 0.5F, 0.25F});  // of the same object, but apart
    const auto other = b.object("other", CityObjectType::CityFurniture);
    b.box(other, {1, 2, 8}, {2, 3, 9});  // touches the pole at a corner
    const auto sizes = partSizes(b.city);
    ASSERT_EQ(sizes.size(), 36U);
    EXPECT_FLOAT_EQ(sizes[0], 4.0F);  // √(8 · 2)
    EXPECT_FLOAT_EQ(sizes[11], 4.0F);
    EXPECT_FLOAT_EQ(sizes[12], 0.5F);
    EXPECT_FLOAT_EQ(sizes[24], 1.0F);
}

TEST(PartSizes, TrianglesWithoutCornersHaveNone) {
    CityModel city;
    city.triangles.push_back({{0, 1, 2}, 0});
    EXPECT_EQ(partSizes(city), std::vector<float>{0.0F});
}

std::shared_ptr<DrawnCity> scatteredBoxes() {
    SceneBuilder b;
    for (int i = 0; i < 300; ++i) {
        const float size = 0.05F * float(1 + i % 37);
        const glm::vec3 at(float((i * 71) % 400), float((i * 37) % 300), 0.0F);
        b.box(b.object("box" + std::to_string(i), CityObjectType::CityFurniture), at, at + size);
    }
    auto city = std::make_shared<DrawnCity>();
    city->model = std::make_shared<CityModel>(b.city);
    city->looks = std::make_shared<SurfaceLooks>(*city->model);
    city->textures = std::make_shared<std::vector<TextureImage>>();
    return city;
}

TEST(CityMeshOrder, EachTriangleIsThereOnceWithAVertexOfItsOwn) {
    const auto city = scatteredBoxes();
    const auto mesh = buildCityMesh(city);
    ASSERT_EQ(mesh->indices.size(), 3 * city->model->triangles.size());
    std::uint32_t counted = 0;
    for (const CityChunk& chunk : mesh->chunks) {
        EXPECT_EQ(chunk.firstTriangle, counted);
        counted += chunk.triangleCount;
    }
    EXPECT_EQ(counted, city->model->triangles.size());
    for (std::uint32_t i = 0; i < counted; ++i) {
        EXPECT_EQ(mesh->vertices[mesh->indices[3 * i + 2]].triangle, i);
    }
}

TEST(CityMeshOrder, TrianglesShareCornersAsFarAsTheirNumbersAllow) {
    constexpr std::uint32_t kEdge = 20;
    auto model = std::make_shared<CityModel>();
    model->objects.emplace_back();
    model->surfaces.emplace_back();
    for (std::uint32_t i = 0; i <= kEdge * (kEdge + 1) + kEdge; ++i) {
        model->vertices.emplace_back(float(i % (kEdge + 1)), float(i / (kEdge + 1)), 0.0F);
    }
    for (std::uint32_t row = 0; row < kEdge; ++row) {
        for (std::uint32_t column = 0; column < kEdge; ++column) {
            const std::uint32_t a = row * (kEdge + 1) + column;
            model->triangles.push_back({{a, a + 1, a + kEdge + 2}, 0});
            model->triangles.push_back({{a, a + kEdge + 2, a + kEdge + 1}, 0});
        }
    }
    auto city = std::make_shared<DrawnCity>();
    city->model = model;
    city->looks = std::make_shared<SurfaceLooks>(*model);
    city->textures = std::make_shared<std::vector<TextureImage>>();
    const auto mesh = buildCityMesh(city);
    EXPECT_LT(double(mesh->vertices.size()), 1.25 * double(model->triangles.size()));
}

TEST(CityMeshOrder, APrefixOfAChunkHoldsAllPartsOfASizeAndNoSmallerOnes) {
    const auto mesh = buildCityMesh(scatteredBoxes());
    EXPECT_GT(mesh->chunks.size(), 10U);
    for (const CityChunk& chunk : mesh->chunks) {
        for (const float size : {0.0F, 0.3F, 0.7F, 1.3F, 9.0F}) {
            const std::uint32_t count = trianglesOfSize(*mesh, chunk, size);
            for (std::uint32_t i = 0; i < chunk.triangleCount; ++i) {
                EXPECT_EQ(mesh->partSize[chunk.firstTriangle + i] >= size, i < count);
            }
        }
    }
}

TEST(CityMeshOrder, IsTheSameForAnyNumberOfThreads) {
    const auto city = scatteredBoxes();
    setThreadLimit(1);
    const auto alone = buildCityMesh(city);
    setThreadLimit(8);
    const auto many = buildCityMesh(city);
    setThreadLimit(0);
    ASSERT_EQ(many->vertices.size(), alone->vertices.size());
    for (std::size_t i = 0; i < alone->vertices.size(); ++i) {
        ASSERT_EQ(many->vertices[i].position, alone->vertices[i].position);
        ASSERT_EQ(many->vertices[i].triangle, alone->vertices[i].triangle);
    }
    EXPECT_EQ(many->indices, alone->indices);
    EXPECT_EQ(many->partSize, alone->partSize);
    EXPECT_EQ(many->triangles, alone->triangles);
    EXPECT_EQ(many->surfaces, alone->surfaces);
}

TEST(CityMeshTables, SurfacesOfAWallShareTheirRecordUnlessTheirColoursDiffer) {
    SceneBuilder b;
    const auto house = b.object("house", CityObjectType::Building);
    const auto red = b.material("facade red", {0.7F, 0.1F, 0.1F});
    const auto wall = [&](float from, float to, float y, std::uint32_t material) {
        const auto surface = b.surface(house, material, SurfaceType::Wall);
        b.quad(surface, {from, y, 0}, {to, y, 0}, {to, y, 9}, {from, y, 9});
    };
    wall(0, 6, 0, kNone);
    wall(6, 12, 0, kNone);
    wall(12, 18, 0, red);
    wall(0, 18, 10, kNone);
    DrawnCity city;
    city.model = std::make_shared<CityModel>(b.city);
    city.looks = std::make_shared<SurfaceLooks>(*city.model);
    city.textures = std::make_shared<std::vector<TextureImage>>();
    const auto mesh = buildCityMesh(std::make_shared<DrawnCity>(city));
    const auto record = [&](std::size_t surface) {
        return mesh->surfaces[std::size_t(kSurfaceTexels) * surface + 3].x;
    };
    EXPECT_EQ(record(0), record(1));
    EXPECT_NE(record(0), record(2)) << "of another colour";
    EXPECT_NE(record(0), record(3)) << "another wall";
    EXPECT_EQ(mesh->facades.size(), 3U * kFacadeTexels);
}

/// A row of trees of 400 leaves each, with trunks; leaves are squares of 0.2 m that face each way.
std::shared_ptr<DrawnCity> leafyCity() {
    auto model = std::make_shared<CityModel>();
    const auto quad = [&](const glm::vec3& at, const glm::vec3& a, const glm::vec3& b) {
        const auto first = std::uint32_t(model->vertices.size());
        for (const glm::vec3& p : {at, at + a, at + a + b, at + b})
            model->vertices.push_back(p);
        const auto surface = std::uint32_t(model->surfaces.size() - 1);
        model->triangles.push_back({{first, first + 1, first + 2}, surface});
        model->triangles.push_back({{first, first + 2, first + 3}, surface});
    };
    for (int tree = 0; tree < 4; ++tree) {
        model->objects.emplace_back();
        model->objects.back().type = CityObjectType::SolitaryVegetation;
        model->surfaces.emplace_back();
        model->surfaces.back().object = std::uint32_t(tree);
        const glm::vec3 foot(8.0F * float(tree), 0.0F, 0.0F);
        quad(foot, {1, 0, 0}, {0, 0, 5});
        for (int leaf = 0; leaf < 400; ++leaf) {
            const glm::vec3 at = foot + glm::vec3(leaf % 20, leaf / 20, 24.0F) * 0.25F;
            quad(at, {0.2F, 0, 0}, leaf % 2 == 0 ? glm::vec3(0, 0.2F, 0) : glm::vec3(0, 0, 0.2F));
        }
    }
    auto city = std::make_shared<DrawnCity>();
    city->model = model;
    city->looks = std::make_shared<SurfaceLooks>(*model);
    city->textures = std::make_shared<std::vector<TextureImage>>();
    return city;
}

/// Square metres of the triangles of a city that a view shows.
double shownArea(const CityMesh& mesh, const CityView& view, std::size_t& triangles) {
    double area = 0.0;
    triangles = 0;
    for (const CityChunk& chunk : mesh.chunks) {
        const SizeRange sizes = sizesInView(view, chunk);
        if (!(sizes.least < sizes.limit))
            continue;
        for (std::uint32_t i = trianglesOfSize(mesh, chunk, sizes.limit);
             i < trianglesOfSize(mesh, chunk, sizes.least); ++i) {
            glm::vec3 p[3];
            for (std::uint32_t k = 0; k < 3; ++k)
                p[k] = mesh.vertices[mesh.indices[3 * (chunk.firstTriangle + i) + k]].position;
            area += 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
            ++triangles;
        }
    }
    return area;
}

TEST(ThinnedLeaves, ATreeFarAwayKeepsItsDensityWithFewerLeaves) {
    const auto mesh = buildCityMesh(leafyCity());
    Camera camera;
    camera.target = {14.0, 2.0, 4.0};
    for (const double away : {60.0, 120.0, 240.0, 480.0}) {
        camera.position = camera.target - glm::dvec3(0.0, away, 0.0);
        CityView view = cityView(camera, 640, 360);
        view.smallestPart = 0.0F;
        std::size_t all = 0, fewer = 0;
        const double full = shownArea(*mesh, view, all);
        EXPECT_NEAR(full, 4 * (400 * 0.04 + 5.0), 0.1) << "still pictures show every leaf";
        view.thinnedLeaf = 4.0F;
        const double thinned = shownArea(*mesh, view, fewer);
        EXPECT_LT(double(fewer), 0.4 * double(all)) << away;
        EXPECT_NEAR(thinned, full, 0.3 * full) << away;
    }
}

TEST(ThinnedLeaves, ATreeCloseByHasAllOfThem) {
    const auto mesh = buildCityMesh(leafyCity());
    Camera camera;
    camera.target = {14.0, 2.0, 4.0};
    camera.position = camera.target - glm::dvec3(0.0, 20.0, 0.0);
    camera.verticalFov = 1.5;
    CityView view = cityView(camera, 1280, 720);
    view.thinnedLeaf = 2.0F;
    std::size_t triangles = 0;
    EXPECT_NEAR(shownArea(*mesh, view, triangles), 4 * (400 * 0.04 + 5.0), 0.1);
    EXPECT_EQ(triangles, 4U * 2U * 401U);
}

TEST(ThinnedLeaves, EachChunkKeepsToTheLeavesOfTheOneBefore) {
    const auto mesh = buildCityMesh(leafyCity());
    std::array<std::uint32_t, kThinnings + 1> leaves{};
    for (const CityChunk& chunk : mesh->chunks) {
        if (chunk.leaves)
            leaves[std::size_t(chunk.thinned)] += chunk.triangleCount;
    }
    EXPECT_EQ(leaves[0], 4U * 800U);
    for (std::size_t n = 1; n < leaves.size(); ++n) {
        EXPECT_GT(leaves[n], 0U);
        EXPECT_LT(2U * leaves[n], leaves[n - 1]);
    }
}

}  // namespace
}  // namespace reflet::test
