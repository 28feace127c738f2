// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"
#include "core/gpu/SceneRenderer.h"
#include "core/gpu/base/GlVersion.h"
#include "core/gpu/overlay/OverlayShapes.h"
#include "core/rendering/CameraRays.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <thread>

namespace reflet {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 160;

/// A map whose six faces have a colour each.
std::shared_ptr<const LocalEnvironmentMap> facesMap(const std::array<glm::vec3, 6>& colors) {
    auto map = std::make_shared<LocalEnvironmentMap>();
    map->radiance = CubeMap<glm::vec3>(16);
    map->distance = CubeMap<float>(16, 20.0F);
    map->uncovered = CubeMap<unsigned char>(16, 0);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < 16; ++row) {
            for (int column = 0; column < 16; ++column)
                map->radiance.at(face, column, row) = colors[std::size_t(face)];
        }
    }
    return map;
}

class SceneOnGpu : public test::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped() || HasFatalFailure())
            return;
        auto made = SceneRenderer::create();
        ASSERT_TRUE(made) << made.error().message();
        m_renderer = std::move(*made);
        m_request.width = kWidth;
        m_request.height = kHeight;
        m_request.camera = {{-8.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 0.6};
    }
    void TearDown() override {
        m_renderer.reset();
        GlFixture::TearDown();
    }

    /// The chrome sphere at the origin.
    void addSphere() {
        auto vehicle = builtInVehicle("sphere");
        ASSERT_TRUE(vehicle) << vehicle.error().message();
        PlacedReflector placed;
        placed.id = "ball";
        placed.vehicle = std::make_shared<const Vehicle>(std::move(*vehicle));
        placed.poses = {RigidTransform{}};
        m_request.reflectors = {placed};
    }
    [[nodiscard]] DisplayImage draw() { return m_renderer->drawImage(m_request, &m_statistics); }
    [[nodiscard]] static glm::vec3 pixel(const DisplayImage& image, const glm::dvec2& place) {
        return image.pixels[std::size_t(place.y) * std::size_t(image.width) + std::size_t(place.x)];
    }
    [[nodiscard]] glm::dvec2 project(const glm::dvec3& point) const {
        return *CameraRays(m_request.camera, kWidth, kHeight).project(point);
    }

    std::unique_ptr<SceneRenderer> m_renderer;
    FrameRequest m_request;
    FrameStatistics m_statistics;
};

TEST_F(SceneOnGpu, WithoutACityIsTheSkyAtTheRequestsExposure) {
    m_request.camera.target.z = 2.0;
    m_request.exposure = 0.5F;
    const DisplayImage image = draw();
    ASSERT_EQ(image.pixels.size(), std::size_t(kWidth) * kHeight);
    const Sky sky{Lighting{}};
    const CameraRays rays(m_request.camera, kWidth, kHeight);
    for (const glm::dvec2 place : {glm::dvec2(30.5, 10.5), glm::dvec2(200.5, 60.5)}) {
        const glm::vec3 expected =
            toDisplay(sky.radiance(glm::vec3(rays.through(place.x, place.y))), 0.5F);
        const glm::vec3 found = pixel(image, place);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(found[k], expected[k], 0.02F);
    }
}

TEST_F(SceneOnGpu, AMirrorShowsTheFaceOfItsMapThatItReflects) {
    addSphere();
    const std::array<glm::vec3, 6> colors{glm::vec3(0, 0, 0.9F),       glm::vec3(0.9F, 0, 0),
                                          glm::vec3(0, 0.9F, 0),       glm::vec3(0.9F, 0.9F, 0),
                                          glm::vec3(0.9F, 0.9F, 0.9F), glm::vec3(0, 0, 0)};
    m_request.given["ball"] = {facesMap(colors)};
    m_request.method = Method::RayTrace;
    const glm::dvec3 center = m_request.reflectors[0].mapCenter(0);
    m_request.camera.target = center;
    m_request.camera.position.z = center.z;
    const DisplayImage image = draw();
    EXPECT_FALSE(m_statistics.referenceMissing);
    // The middle of the ball looks straight back: along -x.
    const glm::vec3 middle = pixel(image, project(center));
    EXPECT_GT(middle.x, 0.6F);
    EXPECT_LT(middle.y, 0.25F);
    // Where the normal stands 45 degrees up, the zenith; 45 degrees to the left (+y), that side.
    const double r = 0.95 * std::sqrt(0.5);
    const glm::vec3 up = pixel(image, project(center + glm::dvec3(-r, 0.0, r)));
    EXPECT_GT(std::min({up.x, up.y, up.z}), 0.6F);
    const glm::vec3 left = pixel(image, project(center + glm::dvec3(-r, r, 0.0)));
    EXPECT_GT(left.y, 0.6F);
    EXPECT_LT(left.x, 0.35F);
    const glm::vec3 right = pixel(image, project(center + glm::dvec3(-r, -r, 0.0)));
    EXPECT_GT(std::min(right.x, right.y), 0.6F);
    EXPECT_LT(right.z, 0.35F);
}

TEST_F(SceneOnGpu, TheWipeDividesTwoMethodsAtItsPlace) {
    addSphere();
    const glm::dvec3 center = m_request.reflectors[0].mapCenter(0);
    m_request.camera.target = center;
    m_request.given["ball"] = {
        facesMap({glm::vec3(0), glm::vec3(0.9F, 0, 0), glm::vec3(0.9F, 0, 0), glm::vec3(0.9F, 0, 0),
                  glm::vec3(0.9F, 0, 0), glm::vec3(0.9F, 0, 0)})};
    m_request.method = Method::RayTrace;
    m_request.right = Method::Sky;
    m_request.wipe = 0.5F;
    const DisplayImage image = draw();
    EXPECT_EQ(m_statistics.localMaps, 2U);
    const glm::dvec2 middle = project(center);
    const glm::vec3 left = pixel(image, middle - glm::dvec2(4.0, 0.0));
    const glm::vec3 right = pixel(image, middle + glm::dvec2(4.0, 0.0));
    EXPECT_GT(left.x, left.z + 0.3F);
    EXPECT_LT(right.x, right.z + 0.1F);
    m_request.wipe = 0.0F;
    const DisplayImage all = draw();
    const glm::vec3 same = pixel(all, middle - glm::dvec2(4.0, 0.0));
    EXPECT_LT(same.x, same.z + 0.1F);
}

TEST_F(SceneOnGpu, AMapIsDrawnAgainOnlyWhenItsBodyMovedOrSomethingChanged) {
    addSphere();
    const RemSet rems{test::plainMap("a", {0, 0, 1}, 8, glm::vec3(0.4F), 10.0F)};
    m_renderer->setRems(rems);
    m_request.method = Method::Nearest;
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 1U);
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 0U);
    m_request.reflectors[0].poses[0].translation.x += 0.01;
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 0U);
    m_request.reflectors[0].poses[0].translation.x += 0.05;
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 1U);
    m_request.tuning.resolution = 32;
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 1U);
    m_renderer->setRems(RemSet{test::plainMap("b", {0, 0, 1}, 8, glm::vec3(0.2F), 10.0F)});
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 1U);
    m_request.camera.target = {-20.0, 0.0, 1.0};  // the ball is behind the eye
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 0U);
}

TEST_F(SceneOnGpu, SaysWhenAReferenceIsNotThere) {
    addSphere();
    m_request.method = Method::RayTrace;
    static_cast<void>(draw());
    EXPECT_TRUE(m_statistics.referenceMissing);
}

TEST_F(SceneOnGpu, AProbesBallLiesExactlyAtItsPosition) {
    const glm::dvec3 position(4.0, 1.2, 1.7);
    m_request.overlays.probes = {{"p", position, ProbeState::Refused, false, false, false}};
    const DisplayImage without = [&] {
        FrameRequest plain = m_request;
        plain.overlays = {};
        return m_renderer->drawImage(plain);
    }();
    const DisplayImage with = draw();
    glm::dvec2 sum(0.0);
    double count = 0.0;
    const glm::dvec2 expected = project(position);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const auto i = std::size_t(y) * kWidth + std::size_t(x);
            const bool above = y + 0.5 < expected.y;  // below the ball is its stem
            if (above && glm::distance(with.pixels[i], without.pixels[i]) > 0.1F) {
                sum += glm::dvec2(x + 0.5, y + 0.5);
                count += 1.0;
            }
        }
    }
    ASSERT_GT(count, 30.0);
    EXPECT_NEAR(sum.x / count, expected.x, 0.7);
}

TEST_F(SceneOnGpu, AProbesBallIsAsLargeOnTheScreenInAPictureDrawnSmaller) {
    const auto changedShare = [&](int width, int height, float scale) {
        FrameRequest plain = m_request;
        plain.width = width;
        plain.height = height;
        plain.scale = scale;
        FrameRequest marked = plain;
        marked.overlays.probes = {{"p", {60.0, 0.0, 1.0}, ProbeState::Fresh, false, false, false}};
        const DisplayImage without = m_renderer->drawImage(plain);
        const DisplayImage with = m_renderer->drawImage(marked);
        double changed = 0.0;
        for (std::size_t i = 0; i < with.pixels.size(); ++i)
            changed += glm::distance(with.pixels[i], without.pixels[i]) > 0.1F ? 1.0 : 0.0;
        return changed / double(with.pixels.size());
    };
    const double full = changedShare(480, 320, 1.0F);
    ASSERT_GT(full, 0.0);
    EXPECT_NEAR(changedShare(240, 160, 0.5F) / full, 1.0, 0.35);
    EXPECT_GT(changedShare(240, 160, 1.0F) / full, 2.0);
}

/// Five balls in a row, all in the view.
class ColumnOnGpu : public SceneOnGpu {
protected:
    void SetUp() override {
        SceneOnGpu::SetUp();
        if (!m_renderer)
            return;
        addSphere();
        m_renderer->setRems(RemSet{test::plainMap("a", {0, 0, 1}, 8, glm::vec3(0.4F), 10.0F)});
        m_request.method = Method::Nearest;
        m_request.tuning.resolution = 32;
        for (int k = 1; k < 5; ++k) {
            PlacedReflector other = m_request.reflectors[0];
            other.id += std::to_string(k);
            other.poses[0].translation = {0.0, 0.1 * k, 0.0};
            m_request.reflectors.push_back(other);
        }
        m_request.moving = true;
    }
    void drive(double way) {
        for (PlacedReflector& reflector : m_request.reflectors)
            reflector.poses[0].translation.x += way;
    }
};

TEST_F(ColumnOnGpu, AMovementUpdatesAFewMapsAPictureAndRestBringsAllUpToDate) {
    m_request.tuning.lod.frameBudget = LodSettings::kLeastBudget;
    const DisplayImage first = draw();
    EXPECT_TRUE(m_statistics.lod.on);
    EXPECT_GE(m_statistics.localMaps, 1U) << "a body without a map does not wait for one";
    for (int k = 0; k < 6; ++k) {
        drive(0.04);
        static_cast<void>(draw());
    }
    m_request.moving = false;
    static_cast<void>(draw());
    EXPECT_FALSE(m_statistics.lod.on);
    EXPECT_GT(m_statistics.localMaps, 0U);
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 0U) << "the picture before brought all up to date";
}

TEST_F(ColumnOnGpu, WithoutALevelOfDetailEveryMapFollowsInEveryPicture) {
    m_request.tuning.lod.on = false;
    for (int k = 0; k < 3; ++k) {
        static_cast<void>(draw());
        EXPECT_FALSE(m_statistics.lod.on);
        EXPECT_EQ(m_statistics.localMaps, 5U);
        drive(0.05);
    }
}

TEST_F(ColumnOnGpu, EachBodyCountsOnceAndNearOnesShareAMapWithoutABudget) {
    m_request.tuning.lod.frameBudget = std::numeric_limits<double>::infinity();
    static_cast<void>(draw());
    const LodStatistics& lod = m_statistics.lod;
    EXPECT_EQ(lod.full + lod.reduced + lod.blended + lod.hidden, 5U);
    EXPECT_EQ(lod.coarse, 0);
    EXPECT_EQ(lod.waiting, 0U);
    // 10 cm apart under an open sky 100 m wide: one texel is more than a metre there.
    EXPECT_EQ(m_statistics.localMaps, 1U);
    EXPECT_EQ(lod.shared, 4U);
    drive(0.3);
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 0U) << "nothing stands near: the map still serves";
    drive(6.0);
    static_cast<void>(draw());
    EXPECT_EQ(m_statistics.localMaps, 1U);
}

TEST_F(ColumnOnGpu, ABlurSmearsWhatIsNearAlongTheWayAndOnlyWhileItMoves) {
    m_request.tuning.lod.frameBudget = std::numeric_limits<double>::infinity();
    m_request.reflectors.resize(1);
    ReferenceEnvironmentMap striped = test::plainMap("a", {0, 0, 1}, 64, glm::vec3(0.0F), 3.0F);
    for (std::size_t i = 0; i < striped.radiance.texels().size(); ++i)
        striped.radiance.texels()[i] = glm::vec3(i % 8 < 4 ? 1.0F : 0.0F);
    m_renderer->setRems(RemSet{striped});
    const auto contrast = [](const DisplayImage& image) {
        double sum = 0.0;
        for (std::size_t i = 1; i < image.pixels.size(); ++i)
            sum += double(glm::distance(image.pixels[i], image.pixels[i - 1]));
        return sum;
    };
    const auto driven = [&](float blur) {
        m_request.tuning.lod.blur = blur;
        static_cast<void>(draw());
        drive(0.5);
        const DisplayImage image = draw();
        drive(-0.5);
        return contrast(image);
    };
    const double sharp = driven(0.0F);
    EXPECT_LT(driven(1.0F), 0.9 * sharp);
    m_request.moving = false;
    const double still = driven(0.0F);
    EXPECT_EQ(driven(1.0F), still) << "what stands is sharp";
}

TEST_F(SceneOnGpu, ARouteIsSeenWhereTheEyeStandsInTheMiddleOfIt) {
    const FrameRequest plain = m_request;
    m_request.overlays.routes = {{"r", {{-100.0, 0.0, 0.0}, {100.0, 0.0, 0.0}}, {}, false}};
    const DisplayImage without = m_renderer->drawImage(plain);
    const DisplayImage with = draw();
    const glm::dvec2 ahead = project({2.0, 0.0, 0.06});
    EXPECT_GT(glm::distance(pixel(with, ahead), pixel(without, ahead)), 0.05F);
    const glm::dvec2 aside = project({2.0, 3.0, 0.06});
    EXPECT_EQ(pixel(with, aside), pixel(without, aside));
}

TEST_F(SceneOnGpu, TheStatesOfProbesDifferInShapeNotOnlyInColour) {
    std::vector<std::vector<bool>> shapes;
    for (const ProbeState state : {ProbeState::Missing, ProbeState::Fresh, ProbeState::Stale,
                                   ProbeState::Baking, ProbeState::Refused}) {
        m_request.overlays.probes = {{"p", {0.0, 0.0, 1.0}, state, false, false, false}};
        m_request.camera.position = {-3.0, 0.0, 1.0};
        const DisplayImage image = draw();
        std::vector<bool> dark;
        for (const glm::vec3& p : image.pixels)
            dark.push_back(0.3F * p.x + 0.6F * p.y + 0.1F * p.z < 0.3F);
        for (const auto& other : shapes) {
            std::size_t differing = 0;
            for (std::size_t i = 0; i < dark.size(); ++i)
                differing += dark[i] != other[i] ? 1 : 0;
            EXPECT_GT(differing, 20U) << int(state);
        }
        shapes.push_back(std::move(dark));
    }
}

TEST_F(SceneOnGpu, ALargerSupersamplingGivesAPictureOfTheSameSize) {
    addSphere();
    m_request.samplesPerEdge = 3;
    EXPECT_EQ(draw().pixels.size(), std::size_t(kWidth) * kHeight);
    m_request.width = 0;
    m_request.height = -4;
    EXPECT_EQ(draw().pixels.size(), 1U);
}

TEST_F(SceneOnGpu, LeavesNoErrorAndTheUsualClipControl) {
    addSphere();
    m_request.overlays.selectedReflector = "ball";
    m_request.overlays.cursor = glm::dvec3(2.0, 0.0, 0.0);
    m_request.overlays.routes = {{"r", {{-2, 2, 0}, {20, 2, 0}, {30, 9, 0}}, {{20, 2, 0}}, true}};
    static_cast<void>(draw());
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    GLint mode = 0;
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
    EXPECT_EQ(GLenum(mode), GLenum(GL_NEGATIVE_ONE_TO_ONE));
}

TEST(SceneWithoutOpenGl, IsRefusedWithARemedy) {
    std::thread([] {  // a thread without a context
        const auto made = SceneRenderer::create();
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().subject, "OpenGL 4.5 core");
    })
        .join();
}

}  // namespace
}  // namespace reflet
