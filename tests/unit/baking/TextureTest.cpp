// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/MipTexture.h"
#include "tests/unit/baking/BakingScenes.h"

namespace reflet::testing {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

TextureImage image(int width, int height, const std::vector<Rgb>& texels) {
    TextureImage result;
    result.width = width;
    result.height = height;
    for (const Rgb& c : texels) {
        result.rgba.insert(result.rgba.end(), {c[0], c[1], c[2], 255});
    }
    return result;
}

/// A card with a corner of its own colour each: top left red, top right green, bottom left blue,
/// bottom right white.
TextureImage card() {
    constexpr Rgb red{255, 0, 0};
    constexpr Rgb green{0, 255, 0};
    constexpr Rgb blue{0, 0, 255};
    constexpr Rgb white{255, 255, 255};
    return image(4, 4,
                 {red, red, green, green, red, red, green, green, blue, blue, white, white, blue,
                  blue, white, white});
}

/// A level square of 2 m, 1 m above nothing, with uv from 0 to `turns` along x and y.
SceneBuilder cardScene(float from, float to, bool repeat) {
    SceneBuilder b;
    CityTexture texture;
    texture.reference = "card.png";
    texture.repeat = repeat;
    b.city.textures.push_back(texture);
    const auto s = b.surface(b.object("card", CityObjectType::Generic));
    b.city.surfaces[s].texture = 0;
    b.level(s, 0, 0, 2, 2, 1);
    b.city.uv = {{glm::vec2(from, from), glm::vec2(to, from), glm::vec2(to, to)},
                 {glm::vec2(from, from), glm::vec2(to, to), glm::vec2(from, to)}};
    return b;
}

/// The share of each channel in what comes back, with the light's own colour taken out.
glm::vec3 albedoAt(const RadianceScene& scene, float x, float y, float spread = 1e-4F) {
    const glm::vec3 light = scene.diffuseLight({x, y, 1.0F}, {0, 0, 1});
    return look(scene, {x, y, 3.0F}, {x, y, 1.0F}, spread) / light;
}

void expectColour(const glm::vec3& seen, const glm::vec3& expected) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(seen[i], expected[i], 0.05F) << "channel " << i;
    }
}

TEST(Texture, VRunsUpAndRowsRunFromTheTop) {
    const SceneBuilder b = cardScene(0, 1, true);
    const auto scene = sceneOf(b.city, sunAt(50), {card()});
    expectColour(albedoAt(*scene, 0.5F, 1.5F), {1, 0, 0});
    expectColour(albedoAt(*scene, 1.5F, 1.5F), {0, 1, 0});
    expectColour(albedoAt(*scene, 0.5F, 0.5F), {0, 0, 1});
    expectColour(albedoAt(*scene, 1.5F, 0.5F), {1, 1, 1});
}

TEST(Texture, OutsideTheImageItRepeatsOrKeepsItsEdgeAsTheFileSays) {
    // uv from -1 to 2: the image itself fills the middle third.
    const SceneBuilder repeated = cardScene(-1, 2, true);
    const auto repeating = sceneOf(repeated.city, sunAt(50), {card()});
    const SceneBuilder clamped = cardScene(-1, 2, false);
    const auto clamping = sceneOf(clamped.city, sunAt(50), {card()});
    // A little left of the image, in its upper half: its right edge again, or its left edge.
    expectColour(albedoAt(*repeating, 0.5F, 1.17F), {0, 1, 0});
    expectColour(albedoAt(*clamping, 0.5F, 1.17F), {1, 0, 0});
    // Right of it, in its lower half.
    expectColour(albedoAt(*repeating, 1.5F, 0.83F), {0, 0, 1});
    expectColour(albedoAt(*clamping, 1.5F, 0.83F), {1, 1, 1});
}

TEST(Texture, FarAwayACheckerboardIsTheGreyOfEqualLight) {
    std::vector<Rgb> texels;
    for (int i = 0; i < 64 * 64; ++i) {
        const bool white = ((i % 64) + (i / 64)) % 2 == 0;
        texels.push_back(white ? Rgb{255, 255, 255} : Rgb{0, 0, 0});
    }
    const SceneBuilder b = cardScene(0, 1, true);
    const auto scene = sceneOf(b.city, sunAt(50), {image(64, 64, texels)});
    // Half the light: sRGB 188, not 128.
    expectColour(albedoAt(*scene, 0.71F, 0.93F, 0.5F), glm::vec3(0.5F));
}

TEST(Texture, AveragesKeepTheLightOfAnySize) {
    // Widths and heights that do not halve evenly.
    for (const auto& [width, height] : {std::pair{7, 5}, std::pair{1, 9}, std::pair{13, 1}}) {
        std::vector<Rgb> texels;
        double sum = 0.0;
        for (int i = 0; i < width * height; ++i) {
            const bool on = (i * 7919) % 3 == 0;
            texels.push_back(on ? Rgb{255, 255, 255} : Rgb{0, 0, 0});
            sum += on ? 1.0 : 0.0;
        }
        const MipTexture texture(image(width, height, texels), true);
        EXPECT_NEAR(texture.mean().g, sum / (width * height), 0.02);
    }
}

TEST(Texture, AnImageThatIsMissingOrBrokenLeavesTheMaterial) {
    SceneBuilder b = cardScene(0, 1, true);
    b.city.surfaces[0].material = b.material("plain", {0.2F, 0.6F, 0.3F});
    TextureImage broken = card();
    broken.rgba.resize(7);
    for (const TextureImage& texture : {TextureImage{}, broken}) {
        const auto scene = sceneOf(b.city, sunAt(50), {texture});
        expectColour(albedoAt(*scene, 0.5F, 1.5F), {0.2F, 0.6F, 0.3F});
    }
}

TEST(Texture, CoordinatesThatAreNotNumbersGiveBlackAndNothingWorse) {
    SceneBuilder b = cardScene(0, 1, true);
    for (auto& uv : b.city.uv) {
        uv[1].x = std::nanf("");
        uv[2].y = kInfinity;
    }
    const auto scene = sceneOf(b.city, sunAt(50), {card()});
    const glm::vec3 seen = look(*scene, {0.5F, 1.5F, 3}, {0.5F, 1.5F, 1});
    EXPECT_TRUE(std::isfinite(seen.r + seen.g + seen.b));
}

}  // namespace
}  // namespace reflet::testing
