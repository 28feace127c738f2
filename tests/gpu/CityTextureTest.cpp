// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/TexturePages.h"
#include "tests/gpu/CityPictures.h"

namespace reflet::test {
namespace {

using testing::SceneBuilder;
using testing::sunAt;

/// An image whose texels are told apart by their colours.
TextureImage checkered(int width, int height, std::uint8_t alpha = 255) {
    TextureImage image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool light = (x * 4 / width + y * 4 / height) % 2 == 0;
            image.rgba.push_back(std::uint8_t(light ? 230 : 40));
            image.rgba.push_back(std::uint8_t(255 * x / width));
            image.rgba.push_back(std::uint8_t(255 * y / height));
            image.rgba.push_back(alpha);
        }
    }
    return image;
}

/// A wall of 8 m × 6 m whose image runs from -0.6 to 1.8 in both directions.
SceneBuilder imageWall(bool repeat) {
    SceneBuilder b;
    const auto m = b.material("plain wall", glm::vec3(0.2F, 0.6F, 0.3F));
    const auto s = b.surface(b.object("wall", CityObjectType::Generic), m);
    b.city.surfaces[s].texture = 0;
    b.city.textures.push_back({"wall.png", "", repeat});
    b.quad(s, {-4, 0, 0}, {4, 0, 0}, {4, 0, 6}, {-4, 0, 6});
    const glm::vec2 low(-0.6F);
    const glm::vec2 high(1.8F);
    b.city.uv = {{low, glm::vec2(high.x, low.y), high}, {low, high, glm::vec2(low.x, high.y)}};
    return b;
}

class CityTextureTest : public CityPictures {
protected:
    double agreement(const CityModel& city, const TextureImage& image) {
        show(city, sunAt(40.0), {image});
        double worst = 99.0;
        for (const glm::dvec3 eye : {glm::dvec3(0.5, -9.0, 3.0), glm::dvec3(-14.0, -3.0, 1.0),
                                     glm::dvec3(10.0, -90.0, 20.0)}) {
            CityView view = cityView({eye, {0.0, 0.0, 3.0}, eye.y < -50 ? 0.12 : 0.7}, 160, 120);
            view.spread = kViewSpread;
            worst = std::min(worst, decibels(drawn(view), traced(view)));
        }
        return worst;
    }
};

TEST_F(CityTextureTest, ARepeatedImageIsThatOfTheCpu) {
    EXPECT_GT(agreement(imageWall(true).city, checkered(64, 64)), 38.0);
}
TEST_F(CityTextureTest, AClampedImageIsThatOfTheCpu) {
    EXPECT_GT(agreement(imageWall(false).city, checkered(64, 64)), 38.0);
}
TEST_F(CityTextureTest, SizesNeedNotBePowersOfTwo) {
    EXPECT_GT(agreement(imageWall(true).city, checkered(119, 37)), 38.0);
    EXPECT_GT(agreement(imageWall(false).city, checkered(1, 5)), 38.0);
}
TEST_F(CityTextureTest, SeeThroughPartsShowTheSurfacesColour) {
    EXPECT_GT(agreement(imageWall(true).city, checkered(32, 32, 0)), 38.0);
    EXPECT_GT(agreement(imageWall(true).city, checkered(32, 32, 100)), 38.0);
}
TEST_F(CityTextureTest, ATintedImageIsThatOfTheCpuAndDarkerThanThePlainOne) {
    SceneBuilder plain = imageWall(true);
    SceneBuilder tinted = imageWall(true);
    tinted.city.materials[0].tint = {0.3F, 0.9F, 0.1F};
    EXPECT_GT(agreement(tinted.city, checkered(64, 64)), 38.0);
    const CityView view = cityView({{0.0, -9.0, 3.0}, {0.0, 0.0, 3.0}, 0.3}, 16, 12);
    const auto red = drawn(view).at(8, 6).x;
    show(plain.city, sunAt(40.0), {checkered(64, 64)});
    EXPECT_LT(red, 0.5F * drawn(view).at(8, 6).x);
}
TEST_F(CityTextureTest, AMissingImageGivesTheMaterial) {
    EXPECT_GT(agreement(imageWall(true).city, TextureImage{}), 38.0);
    TextureImage wrong = checkered(8, 8);
    wrong.rgba.resize(5);
    EXPECT_GT(agreement(imageWall(true).city, wrong), 38.0);
}

TEST(TexturePages, LevelsOfManyImagesDoNotOverlap) {
    CityModel city;
    std::vector<TextureImage> images;
    for (int i = 0; i < 40; ++i) {
        city.textures.push_back({"t", "", i % 2 == 0});
        images.push_back(checkered(1 + 13 * (i % 7), 1 + 29 * (i % 5)));
    }
    const TexturePages pages = layOutTextures(city, images, std::size_t(64) << 20);
    ASSERT_EQ(pages.droppedLevels, 0);
    std::vector<unsigned char> used(std::size_t(pages.edge) * std::size_t(pages.edge) *
                                    std::size_t(pages.layers));
    for (const glm::uvec4& place : pages.places) {
        const glm::ivec2 size(place.w & 0xffffU, place.w >> 16);
        const int levels = int(place.z >> 16 & 0x7fffU);
        EXPECT_EQ(std::max(size.x, size.y) >> levels, 0) << "down to one texel";
        for (int level = 0; level < levels; ++level) {
            const glm::ivec2 at =
                glm::ivec2(place) + TexturePages::levelOffset(size.x, size.y, level);
            const glm::ivec2 extent = glm::max(size >> level, glm::ivec2(1));
            for (int y = at.y - 1; y <= at.y + extent.y; ++y) {
                for (int x = at.x - 1; x <= at.x + extent.x; ++x) {
                    ASSERT_TRUE(x >= 0 && y >= 0 && x < pages.edge && y < pages.edge);
                    auto& texel = used[(std::size_t(place.z & 0xffffU) * std::size_t(pages.edge) +
                                        std::size_t(y)) *
                                           std::size_t(pages.edge) +
                                       std::size_t(x)];
                    ASSERT_EQ(texel, 0);
                    texel = 1;
                }
            }
        }
    }
}

TEST(TexturePages, LargeSetsLoseTheirFinestLevels) {
    CityModel city;
    std::vector<TextureImage> images;
    for (int i = 0; i < 6; ++i) {
        city.textures.push_back({"t", "", true});
        images.push_back(checkered(512, 512));
    }
    constexpr std::size_t kBudget = std::size_t(1) << 20;
    const TexturePages pages = layOutTextures(city, images, kBudget);
    EXPECT_GT(pages.droppedLevels, 0);
    EXPECT_LE(pages.rgba.size(), 2 * kBudget) << "with what packing wastes";
    for (const glm::uvec4& place : pages.places) {
        EXPECT_NE(place.w, 0U) << "none is lost";
    }
}

}  // namespace
}  // namespace reflet::test
