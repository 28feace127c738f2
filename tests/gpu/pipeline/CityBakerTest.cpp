// SPDX-License-Identifier: GPL-3.0-or-later
// Reference maps that are drawn, beside those that are traced.
#include "app/pipeline/PreparedCity.h"
#include "app/pipeline/WriteSample.h"
#include "core/gpu/city/CityBaker.h"
#include "tests/gpu/CityPictures.h"
#include "tests/support/TemporaryFolder.h"

#include <cmath>

namespace reflet::test {
namespace {

constexpr std::size_t kAmbientNodes = 60'000;
constexpr float kCentimetre = 0.01F;
constexpr float kPart = 1e-3F;

class BakedCity : public CityPictures {
protected:
    void expectAgreement(const glm::dvec3& position, const BakeSettings& settings,
                         double decibels) {
        const auto drawn = m_baker.bake(*m_pass, "p", position, settings);
        ASSERT_TRUE(drawn) << drawn.error().message();
        const auto traced = bakeEnvironmentMap(*m_scene, nullptr, "p", position, settings, {});
        ASSERT_TRUE(traced) << traced.error().message();
        EXPECT_EQ(drawn->id, "p");
        EXPECT_EQ(drawn->center, position);
        const std::vector<float>& ours = drawn->distance.texels();
        const std::vector<float>& theirs = traced->distance.texels();
        ASSERT_EQ(ours.size(), theirs.size());
        std::size_t agree = 0;
        for (std::size_t i = 0; i < ours.size(); ++i) {
            agree += ours[i] == theirs[i] || std::abs(ours[i] - theirs[i]) <=
                                                 std::max(kCentimetre, kPart * theirs[i])
                         ? 1
                         : 0;
        }
        const double share = double(agree) / double(ours.size());
        PsnrAccumulator psnr;
        psnr.add(displayStrip(drawn->radiance, 1.0F), displayStrip(traced->radiance, 1.0F));
        const double found = psnr.decibels().value_or(99.0);
        RecordProperty("decibels", std::to_string(found));
        RecordProperty("distances", std::to_string(share));
        EXPECT_GT(share, 0.998);
        EXPECT_GT(found, decibels);
    }

    void TearDown() override {
        m_baker = {};
        CityPictures::TearDown();
    }

    CityBaker m_baker;
};

class BakedSamples : public BakedCity, public ::testing::WithParamInterface<const char*> {};

TEST_P(BakedSamples, AreDrawnAsTheyAreTraced) {
    const TemporaryFolder folder;
    const auto file = writeSample(GetParam(), 1, folder.path());
    ASSERT_TRUE(file);
    const auto prepared = PreparedCity::open(*file, {});
    ASSERT_TRUE(prepared) << prepared.error().message();
    show(prepared->city(), prepared->lighting());
    gatherLight(kAmbientNodes);
    const auto& probes = prepared->project().probes;
    ASSERT_FALSE(probes.empty());
    for (const std::size_t i : {std::size_t(0), probes.size() / 2})
        expectAgreement(prepared->inFrame(probes[i].position), {128, 2}, 32.0);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, BakedSamples, ::testing::Values("square", "paper"));

/// An image whose texels are told apart by their colours.
TextureImage bricks() {
    TextureImage image{64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
        const bool light = (i % 64 / 16 + i / 64 / 8) % 2 == 0;
        for (const int channel : {light ? 230 : 60, 4 * (i % 64), 4 * (i / 64), 255})
            image.rgba.push_back(std::uint8_t(std::min(channel, 255)));
    }
    return image;
}

/// Two walls with a photo texture over a ground that has it too, under a sun that throws their
/// shadows.
TEST_F(BakedCity, WithPhotoTexturesIsDrawnAsItIsTraced) {
    testing::SceneBuilder b;
    const auto plain = b.material("plain", glm::vec3(0.5F));
    const auto add = [&](const char* id, const std::array<glm::vec3, 4>& corners, float repeats) {
        const auto s = b.surface(b.object(id, CityObjectType::Generic), plain);
        b.city.surfaces[s].texture = 0;
        b.quad(s, corners[0], corners[1], corners[2], corners[3]);
        const glm::vec2 low(0.0F);
        const glm::vec2 high(repeats);
        b.city.uv.push_back({low, {high.x, low.y}, high});
        b.city.uv.push_back({low, high, {low.x, high.y}});
    };
    b.city.textures.push_back({"bricks.png", "", true});
    add("ground", {{{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}}}, 30.0F);
    add("west", {{{-8, 30, 0}, {-8, -30, 0}, {-8, -30, 12}, {-8, 30, 12}}}, 6.0F);
    add("north", {{{-8, 9, 0}, {20, 9, 0}, {20, 9, 7}, {-8, 9, 7}}}, 4.0F);
    show(b.city, testing::sunAt(35.0, 230.0), {bricks()});
    gatherLight(kAmbientNodes);
    expectAgreement({0.5, 0.5, 2.0}, {64, 2}, 36.0);
    expectAgreement({-2.0, -4.0, 1.0}, {48, 3}, 36.0);
}

TEST_F(BakedCity, IsRefusedWhereAFaceIsLargerThanTextures) {
    show(testing::SceneBuilder().city, testing::sunAt(40.0));
    const auto refused = m_baker.bake(*m_pass, "station", {}, {2048, 16});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::ResourceLimit);
    EXPECT_EQ(refused.error().subject, "station");
    EXPECT_NE(refused.error().remedy.find("--backend cpu"), std::string::npos);
}

}  // namespace
}  // namespace reflet::test
