// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/gpu/CityPictures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::test {
namespace {

using testing::SceneBuilder;
using testing::sunAt;

constexpr double kElevation = 35.0;

/// A tower of 10 m on a plain; the sun stands in the south, the shadow falls north.
SceneBuilder towerCity() {
    SceneBuilder b;
    const auto m = b.material("plain ground", glm::vec3(0.5F));
    b.level(b.surface(b.object("ground", CityObjectType::Generic), m), -300, -300, 300, 300, 0);
    b.box(b.object("tower", CityObjectType::Generic), {-2, 0, 0}, {2, 2, 10}, m);
    return b;
}

/// A plate of 2 m × 2 m, made at its own origin, 1.5 m above the ground at (20, 20).
struct Plate {
    Plate() {
        array.floats(0, 3, vertices, sizeof(glm::vec3), 0);
        array.indices(elements);
        caster.vertexArray = array.id();
        caster.levels.push_back({0.0F, 0, 6});
        caster.project_from_body = glm::mat4(1.0F);
        caster.project_from_body[3] = glm::vec4(20.0F, 20.0F, 1.5F, 1.0F);
        caster.bounds.add({19.0, 19.0, 1.5});
        caster.bounds.add({21.0, 21.0, 1.5});
        caster.box.add({-1.0, -1.0, 0.0});
        caster.box.add({1.0, 1.0, 0.0});
    }
    std::array<glm::vec3, 4> corners{glm::vec3(-1, -1, 0), {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    std::array<std::uint32_t, 6> indices{0, 1, 2, 0, 2, 3};
    Buffer vertices{std::span<const glm::vec3>(corners)};
    Buffer elements{std::span<const std::uint32_t>(indices)};
    VertexArray array = VertexArray::make();
    ShadowCaster caster;
};

class CityShadowTest : public CityPictures {
protected:
    /// Radiance of the ground at a place, seen from above it.
    glm::vec3 groundAt(double x, double y, std::span<const ShadowCaster> casters = {}) {
        CityView view = cityView({{x, y, 4.0}, {x, y + 1e-4, 0.0}, 0.2}, 9, 9);
        return drawn(view, casters).at(4, 4);
    }
};

TEST_F(CityShadowTest, AShadowEndsWhereTheHeightAndTheElevationSay) {
    show(towerCity().city, sunAt(kElevation, 180.0));
    const double tip = 2.0 + 10.0 / std::tan(kElevation * kPi / 180.0);
    const glm::vec3 open = groundAt(30.0, 30.0);
    constexpr double kPenumbra = 0.12;  // metres: three texels of the nearest map
    for (const auto& [lit, shaded] :
         {std::pair{glm::dvec2(0.3, tip + kPenumbra), glm::dvec2(0.3, tip - kPenumbra)},
          std::pair{glm::dvec2(2.0 + kPenumbra, 9.0), glm::dvec2(2.0 - kPenumbra, 9.0)},
          std::pair{glm::dvec2(-2.0 - kPenumbra, 9.0), glm::dvec2(-2.0 + kPenumbra, 9.0)}}) {
        EXPECT_NEAR(groundAt(lit.x, lit.y).g, open.g, 0.02F * open.g);
        EXPECT_LT(groundAt(shaded.x, shaded.y).g, 0.6F * open.g);
    }
}

TEST_F(CityShadowTest, AShadowBeginsAtTheFootOfWhatThrowsIt) {
    show(towerCity().city, sunAt(kElevation, 180.0));
    const glm::vec3 open = groundAt(30.0, 30.0);
    EXPECT_LT(groundAt(0.0, 2.08).g, 0.6F * open.g) << "8 cm behind the wall";
}

TEST_F(CityShadowTest, SurfacesInTheSunDoNotShadowThemselves) {
    for (const double elevation : {70.0, 35.0, 12.0}) {
        show(towerCity().city, sunAt(elevation, 180.0));
        const CityView view = cityView({{15.0, -25.0, 8.0}, {0.0, 0.0, 4.0}, 0.9}, 160, 120);
        EXPECT_GT(decibels(drawn(view), traced(view)), 30.0) << elevation;
    }
}

TEST_F(CityShadowTest, FarShadowsFallWhereNearOnesDo) {
    show(towerCity().city, sunAt(kElevation, 180.0));
    const CityView far = cityView({{180.0, -160.0, 90.0}, {0.0, 8.0, 0.0}, 0.08}, 160, 120);
    EXPECT_GT(decibels(drawn(far), traced(far)), 25.0);
}

TEST_F(CityShadowTest, MapsAreKeptUntilTheSunOrThePlaceChanges) {
    show(towerCity().city, sunAt(kElevation, 180.0));
    EXPECT_GT(m_pass->prepareShadows({0, 0, 2}, {}).shadowTriangles, 0U);
    EXPECT_EQ(m_pass->prepareShadows({0, 0, 2}, {}).shadowTriangles, 0U);
    EXPECT_EQ(m_pass->prepareShadows({1, 0.5, 2}, {}).shadowTriangles, 0U) << "a step aside";
    EXPECT_GT(m_pass->prepareShadows({150, 0, 2}, {}).shadowTriangles, 0U);
    m_pass->setLighting(sunAt(kElevation + 5.0, 180.0));
    EXPECT_GT(m_pass->prepareShadows({150, 0, 2}, {}).shadowTriangles, 0U);
}

/// Where OpenGL is software; elsewhere all is drawn at once, and the pictures are the same.
TEST_F(CityShadowTest, SquaresThatAreDrawnInPartsComeToShowTheSame) {
    SceneBuilder b = towerCity();
    const auto m = b.material("plain house", glm::vec3(0.4F));
    for (int i = 0; i < 5000; ++i) {  // more triangles than a part has
        const double x = -110.0 + 2.2 * (i % 100), y = -80.0 + 4.0 * (i / 100);
        b.box(b.object("house", CityObjectType::Building), {x, y, 0}, {x + 1, y + 1, 3}, m);
    }
    show(b.city, sunAt(kElevation, 180.0));
    static_cast<void>(m_pass->prepareShadows({0, 0, 20}, {}));
    const CityView view = cityView({{24.0, -30.0, 20.0}, {24.0, 8.0, 0.0}, 0.9}, 96, 64);
    // The place moves on as while something drives, and the shadows follow.
    bool drew = false;
    for (int step = 1; step <= 40; ++step) {
        const double x = std::min(24.0, 1.0 * step);
        drew =
            m_pass->prepareShadows({x, -30.0 * x / 24.0, 20}, {}, true).shadowTriangles > 0 || drew;
    }
    EXPECT_TRUE(drew);
    // All is done: a picture of what stands has nothing left to draw.
    EXPECT_EQ(m_pass->prepareShadows(view.eye, {}).shadowTriangles, 0U);
    const RadiancePicture inParts = drawn(view);
    show(b.city, sunAt(kElevation, 180.0));
    EXPECT_EQ(decibels(inParts, drawn(view)), 99.0);
}

TEST_F(CityShadowTest, APictureOfWhatStandsDoesNotWaitForParts) {
    show(towerCity().city, sunAt(kElevation, 180.0));
    static_cast<void>(m_pass->prepareShadows({0, 0, 2}, {}));
    static_cast<void>(m_pass->prepareShadows({22, 0, 2}, {}));
    EXPECT_EQ(m_pass->prepareShadows({22, 0, 2}, {}).shadowTriangles, 0U);
    // Far away nothing that is kept would serve: at once, also while something moves.
    EXPECT_GT(m_pass->prepareShadows({150, 0, 2}, {}, true).shadowTriangles, 0U);
    EXPECT_EQ(m_pass->prepareShadows({150, 0, 2}, {}).shadowTriangles, 0U);
}

TEST_F(CityShadowTest, AMovingBodyThrowsItsShadowForOneFrame) {
    show(towerCity().city, sunAt(60.0, 180.0));
    const Plate made;
    const ShadowCaster& plate = made.caster;

    const double shift = 1.5 / std::tan(60.0 * kPi / 180.0);  // north of the plate
    const glm::vec3 open = groundAt(20.0, 20.0 + shift);
    const std::array<ShadowCaster, 1> casters{plate};
    EXPECT_LT(groundAt(20.0, 20.0 + shift, casters).g, 0.6F * open.g);
    EXPECT_LT(groundAt(20.0, 20.9 + shift, casters).g, 0.6F * open.g);
    EXPECT_NEAR(groundAt(20.0, 21.1 + shift, casters).g, open.g, 0.02F * open.g);
    EXPECT_NEAR(groundAt(21.1, 20.0 + shift, casters).g, open.g, 0.02F * open.g);
    EXPECT_NEAR(groundAt(20.0, 20.0 + shift).g, open.g, 0.02F * open.g) << "and is gone again";
}

/// What a pass leaves in the depth buffer, with the stencil above it.
std::vector<std::uint64_t> depthsOf(CityPass& pass, const CityView& view) {
    const Texture radiance = Texture::make2D(GL_RGBA16F, view.width, view.height);
    const Texture depth = Texture::make2D(GL_DEPTH32F_STENCIL8, view.width, view.height);
    static_cast<void>(pass.draw(view, {radiance.id(), depth.id(), 0}));
    std::vector<std::uint64_t> values(std::size_t(view.width) * std::size_t(view.height));
    glGetTextureImage(depth.id(), 0, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV,
                      GLsizei(values.size() * sizeof(std::uint64_t)), values.data());
    return values;
}

TEST_F(CityShadowTest, AViewThatComesAgainIsTheSameAndShowsTheShadowsOfTheMoment) {
    show(towerCity().city, sunAt(60.0, 180.0));
    const CityView view = cityView({{20.0, 0.0, 6.0}, {10.0, 21.0, 1.0}, 0.9}, 96, 64);
    const RadiancePicture first = drawn(view);
    const std::vector<std::uint64_t> depths = depthsOf(*m_pass, view);
    const Plate plate;
    const std::array<ShadowCaster, 1> casters{plate.caster};
    const RadiancePicture shaded = drawn(view, casters);
    EXPECT_LT(decibels(shaded, first), 40.0) << "the plate's shadow is in the picture";
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(drawn(view, casters).radiance, shaded.radiance);
        EXPECT_EQ(drawn(view).radiance, first.radiance);
        EXPECT_EQ(depthsOf(*m_pass, view), depths);
    }
}

/// Radiance of a view without its distances: what a pass may keep. All channels, from the bottom.
std::vector<float> radianceOf(CityPass& pass, const CityView& view,
                              std::span<const ShadowCaster> casters = {}) {
    const Texture radiance = Texture::make2D(GL_RGBA32F, view.width, view.height);
    const Texture depth = Texture::make2D(GL_DEPTH32F_STENCIL8, view.width, view.height);
    static_cast<void>(pass.prepareShadows(view.eye, casters));
    static_cast<void>(pass.draw(view, {radiance.id(), depth.id(), 0}));
    std::vector<float> values(std::size_t(view.width) * std::size_t(view.height) * 4);
    glGetTextureImage(radiance.id(), 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(float)),
                      values.data());
    return values;
}

std::size_t differing(const std::vector<float>& a, const std::vector<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4)
        count += std::equal(a.begin() + std::ptrdiff_t(i), a.begin() + std::ptrdiff_t(i) + 4,
                            b.begin() + std::ptrdiff_t(i))
                     ? 0U
                     : 1U;
    return count;
}

/// What a new pass draws, that never saw a view before, is what one draws that keeps its picture
/// and shades only where shadows of bodies may fall: whatever the sun, the view and the body's
/// place.
TEST_F(CityShadowTest, AKeptPictureIsThatOfANewPassWhereverABodyStands) {
    const CityView views[] = {cityView({{20.0, 0.0, 6.0}, {10.0, 21.0, 1.0}, 0.9}, 96, 64),
                              cityView({{21.0, 19.0, 1.2}, {0.0, 12.0, 3.0}, 1.2}, 96, 64)};
    std::size_t shadowed = 0;
    for (const auto& [elevation, azimuth] : {std::pair{60.0, 180.0}, {25.0, 240.0}, {-8.0, 90.0}}) {
        for (const CityView& view : views) {
            show(towerCity().city, sunAt(elevation, azimuth));
            const std::vector<float> empty = radianceOf(*m_pass, view);
            for (int place = 0; place < 6; ++place) {
                Plate plate;
                const float turn = 0.4F * float(place);
                plate.caster.project_from_body[0] =
                    glm::vec4(std::cos(turn), std::sin(turn), 0.0F, 0.0F);
                plate.caster.project_from_body[1] =
                    glm::vec4(-std::sin(turn), std::cos(turn), 0.0F, 0.0F);
                const glm::vec3 at(19.0F - 3.5F * float(place), 18.0F - 1.0F * float(place),
                                   0.6F + 0.7F * float(place));
                plate.caster.project_from_body[3] = glm::vec4(at, 1.0F);
                plate.caster.bounds = {};
                plate.caster.bounds.add(glm::dvec3(at) - 1.5);
                plate.caster.bounds.add(glm::dvec3(at) + 1.5);
                const std::array<ShadowCaster, 1> casters{plate.caster};
                const std::vector<float> kept = radianceOf(*m_pass, view, casters);
                auto fresh = CityPass::create();
                ASSERT_TRUE(fresh);
                (*fresh)->setCity(m_city);
                (*fresh)->setLighting(sunAt(elevation, azimuth));
                const std::vector<float> anew = radianceOf(**fresh, view, casters);
                EXPECT_EQ(differing(kept, anew), 0U) << elevation << ' ' << place;
                shadowed += differing(anew, empty);
            }
            EXPECT_EQ(differing(radianceOf(*m_pass, view), empty), 0U) << "the shadow is gone";
        }
    }
    EXPECT_GT(shadowed, 500U) << "shadows were seen at all";
}

TEST_F(CityShadowTest, AKeptPictureIsShadedAnewInAnotherLight) {
    const CityView view = cityView({{20.0, -20.0, 6.0}, {0.0, 0.0, 4.0}, 0.9}, 96, 64);
    show(towerCity().city, sunAt(60.0, 180.0));
    for (int i = 0; i < 3; ++i)
        static_cast<void>(radianceOf(*m_pass, view));
    m_pass->setLighting(sunAt(20.0, 90.0));
    const std::vector<float> other = radianceOf(*m_pass, view);
    show(towerCity().city, sunAt(20.0, 90.0));
    EXPECT_EQ(differing(other, radianceOf(*m_pass, view)), 0U);
}

TEST_F(CityShadowTest, AnotherViewOrCityIsDrawnAnew) {
    show(towerCity().city, sunAt(60.0, 180.0));
    const CityView view = cityView({{20.0, -20.0, 6.0}, {0.0, 0.0, 4.0}, 0.9}, 96, 64);
    CityView turned = view;
    turned.eye.x += 1.0;
    const RadiancePicture first = drawn(view);
    static_cast<void>(drawn(view));
    const RadiancePicture aside = drawn(turned);
    EXPECT_LT(decibels(aside, first), 40.0);
    EXPECT_EQ(drawn(view).radiance, first.radiance);
    static_cast<void>(drawn(view));
    SceneBuilder plain;
    plain.level(plain.surface(plain.object("ground", CityObjectType::Generic),
                              plain.material("plain ground", glm::vec3(0.5F))),
                -300, -300, 300, 300, 0);
    show(plain.city, sunAt(60.0, 180.0));
    EXPECT_LT(decibels(drawn(view), first), 40.0) << "the tower is gone";
}

}  // namespace
}  // namespace reflet::test
