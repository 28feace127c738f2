// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityMesh.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/city/PartSizes.h"
#include "tests/unit/baking/BakingScenes.h"

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

}  // namespace
}  // namespace reflet::test
