// SPDX-License-Identifier: GPL-3.0-or-later
// The same view by rays and by OpenGL, and local maps drawn against local maps traced.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/GlRender.h"
#include "app/pipeline/Import.h"
#include "core/gpu/EglDisplays.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

namespace reflet {
namespace {

constexpr double kPictureDecibels = 24.0;  ///< OpenGL's view against the rays'
constexpr double kChromeDecibels = 28.0;   ///< the same on an all-chrome car
constexpr double kMapDecibels = 22.0;      ///< a re-rendered map against the reference

double decibels(const DisplayImage& image, const DisplayImage& reference) {
    PsnrAccumulator psnr;
    psnr.add(image, reference);
    return psnr.decibels().value_or(200.0);
}

/// A street with a car.
class GlRendering : public testing::Test {
protected:
    void SetUp() override {
        if (eglDisplayCandidates().empty())
            GTEST_SKIP() << "EGL offers no display here.";
        const auto imported = test::importStreetWithCar(folder, file);
        ASSERT_TRUE(imported.has_value()) << imported.error().message();
        EditRequest edit;
        edit.probesEvery = 20.0;
        edit.settings = {{"bake.resolution", "32"}, {"tuning.resolution", "32"}};
        const auto edited = editProject(file, edit, {});
        ASSERT_TRUE(edited.has_value()) << edited.error().message();
        auto city = PreparedCity::open(file, {});
        ASSERT_TRUE(city.has_value()) << city.error().message();
        m_city.emplace(std::move(*city));
        auto traffic = trafficOf(m_city->project(), m_city->folder());
        ASSERT_TRUE(traffic.has_value()) << traffic.error().message();
        m_placed = {traffic->atStation(0, 25.0)};
        m_camera = streetCamera(*m_city, m_placed[0]);
        m_options.width = 192;
        m_options.height = 108;
        m_options.samplesPerEdge = 2;
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    std::optional<PreparedCity> m_city;
    std::vector<PlacedReflector> m_placed;
    Camera m_camera;
    RenderOptions m_options;
};

TEST_F(GlRendering, ShowsTheViewThatRaysShow) {
    const auto rems = loadRems(*m_city, {});
    ASSERT_TRUE(rems.has_value()) << rems.error().message();
    const auto rays = renderPicture(*m_city, rems->rems, m_placed, m_camera, m_options, {});
    ASSERT_TRUE(rays.has_value()) << rays.error().message();
    const auto drawn = renderPictureGl(*m_city, rems->rems, m_placed, m_camera, m_options, {});
    ASSERT_TRUE(drawn.has_value()) << drawn.error().message();
    const DisplayImage reference = toDisplayImage(*rays, m_city->project().exposure);
    const double found = decibels(*drawn, reference);
    RecordProperty("decibels", std::to_string(found));
    EXPECT_GT(found, kPictureDecibels);

    PsnrAccumulator vehicle;
    vehicle.add(*drawn, reference, rays->reflector);
    EXPECT_GT(vehicle.decibels().value_or(200.0), kPictureDecibels - 4.0);

    // Another view of the same city is far from it: the figure means something.
    Camera aside = m_camera;
    aside.target.z += 2.0;
    const auto other = renderPictureGl(*m_city, rems->rems, m_placed, aside, m_options, {});
    ASSERT_TRUE(other.has_value()) << other.error().message();
    EXPECT_LT(decibels(*other, reference), found - 4.0);
}

/// All chrome, so that a pixel shows nothing but what its ray meets.
TEST_F(GlRendering, LooksMirroredRaysUpAsTheCpuDoes) {
    const auto rems = loadRems(*m_city, {});
    ASSERT_TRUE(rems.has_value()) << rems.error().message();
    auto chrome = std::make_shared<Vehicle>(*m_placed[0].vehicle);
    for (VehicleMaterial& material : chrome->materials) {
        material = {};
        material.baseColor = glm::vec3(1.0F);
        material.metallic = 1.0F;
    }
    m_placed[0].vehicle = chrome;
    const auto onVehicle = [&](const DisplayImage& image, const RenderedView& rays) {
        PsnrAccumulator psnr;
        psnr.add(image, toDisplayImage(rays, m_city->project().exposure), rays.reflector);
        return psnr.decibels().value_or(200.0);
    };
    std::vector<RenderedView> byRays;
    for (const Method method : {Method::Mem, Method::PerPixel, Method::RayTrace}) {
        m_options.method = method;
        auto rays = renderPicture(*m_city, rems->rems, m_placed, m_camera, m_options, {});
        ASSERT_TRUE(rays.has_value()) << rays.error().message();
        byRays.push_back(std::move(*rays));
    }
    double byMaps = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        m_options.method = i == 0 ? Method::Mem : Method::PerPixel;
        SCOPED_TRACE(toString(m_options.method));
        const auto drawn = renderPictureGl(*m_city, rems->rems, m_placed, m_camera, m_options, {});
        ASSERT_TRUE(drawn.has_value()) << drawn.error().message();
        const double found = onVehicle(*drawn, byRays[i]);
        RecordProperty(toString(m_options.method), std::to_string(found));
        EXPECT_GT(found, kChromeDecibels);
        // Nearer to the same method by rays than to the truth, which probes of 32² texels blur.
        EXPECT_GT(found, onVehicle(*drawn, byRays[2]));
        if (m_options.method == Method::Mem)
            byMaps = found;
    }

    // Looked up at infinity the picture is another one.
    EditRequest edit;
    edit.settings = {{"tuning.parallax", "false"}};
    ASSERT_TRUE(editProject(file, edit, {}));
    auto city = PreparedCity::open(file, {});
    ASSERT_TRUE(city.has_value()) << city.error().message();
    m_options.method = Method::Mem;
    const auto far = renderPictureGl(*city, rems->rems, m_placed, m_camera, m_options, {});
    ASSERT_TRUE(far.has_value()) << far.error().message();
    EXPECT_LT(onVehicle(*far, byRays[0]), byMaps - 4.0);
}

TEST_F(GlRendering, DrawsLocalMapsThatAreNearTheReference) {
    const glm::dvec3 position = m_placed[0].mapCenter(0);
    const auto scene = m_city->scene({});
    ASSERT_TRUE(scene.has_value()) << scene.error().message();
    const auto truth = reconstruct(*m_city, {}, &**scene, Method::RayTrace, position, {});
    ASSERT_TRUE(truth.has_value()) << truth.error().message();
    const auto drawn = reconstruct(*m_city, {}, nullptr, Method::Rerender, position, {});
    ASSERT_TRUE(drawn.has_value()) << drawn.error().message();
    ASSERT_EQ(drawn->radiance.resolution(), truth->radiance.resolution());
    const float exposure = m_city->project().exposure;
    EXPECT_GT(
        decibels(displayStrip(drawn->radiance, exposure), displayStrip(truth->radiance, exposure)),
        kMapDecibels);
    std::size_t near = 0;
    for (std::size_t i = 0; i < drawn->distance.texels().size(); ++i) {
        const float a = drawn->distance.texels()[i];
        const float b = truth->distance.texels()[i];
        near += a == b || std::abs(a - b) < 0.01F * b + 0.02F ? 1 : 0;
    }
    EXPECT_GT(double(near), 0.97 * double(drawn->distance.texels().size()));
}

TEST_F(GlRendering, WithoutOpenGl45IsRefusedWithARemedy) {
    ::setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    ::setenv("MESA_GLSL_VERSION_OVERRIDE", "330", 1);
    std::optional<Error> error;
    std::thread([&] {  // contexts are kept by thread
        const auto drawn = rerenderMap(*m_city, m_placed[0].mapCenter(0), {});
        if (!drawn)
            error = drawn.error();
    })
        .join();
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    ::unsetenv("MESA_GLSL_VERSION_OVERRIDE");
    if (!error)
        GTEST_SKIP() << "Only Mesa's drivers can be told to look old.";
    EXPECT_EQ(error->code, ErrorCode::ResourceLimit);
    EXPECT_FALSE(error->remedy.empty());
}

}  // namespace
}  // namespace reflet
