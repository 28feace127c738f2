// SPDX-License-Identifier: GPL-3.0-or-later
// Streets that lead under something, and cities that lie far from the origin of their system.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Figures.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/MakeItReflect.h"
#include "app/pipeline/Render.h"
#include "app/pipeline/Traffic.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <set>

namespace reflet {
namespace {

/// A street with a bridge across it and a car on it, without CRS, at a place.
class Street {
public:
    Street(double east, double north) {
        ImportRequest request;
        request.files = {folder.write("street.city.json",
                                      test::StreetCity(6, east, north).withBridge().cityJson(""))};
        request.output = file;
        const auto imported = importProject(request, {});
        EXPECT_TRUE(imported.has_value()) << imported.error().message();
        auto opened = PreparedCity::open(file, {});
        EXPECT_TRUE(opened.has_value()) << opened.error().message();
        ReflectOptions options;
        options.vehicle = "car";
        options.resolution = 64;
        const RouteSpec route{
            "main", "", {{east + 2.0, north, 50.0}, {east + 58.0, north, 50.0}}, 0.0};
        auto reflecting = makeItReflect(*opened, route, options, {});
        EXPECT_TRUE(reflecting.has_value()) << reflecting.error().message();
        project = reflecting->project;
        project.tuning.resolution = 64;
    }

    [[nodiscard]] PreparedCity prepared(const Project& with) const {
        auto city = PreparedCity::prepare(with, file, {});
        EXPECT_TRUE(city.has_value()) << city.error().message();
        return std::move(*city);
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    Project project;
};

constexpr glm::dvec3 kUnderTheBridge(34.0, 0.0, 1.0);

TEST(Overhead, ARouteFollowsTheGroundUnderABridge) {
    const Street street(0.0, 0.0);
    const PreparedCity city = street.prepared(street.project);
    EXPECT_NEAR(city.groundHeight(34.0, 0.0), 0.0, 1e-6);
    ASSERT_EQ(street.project.routes.size(), 1U);
    for (const glm::dvec3& point : street.project.routes[0].points)
        EXPECT_NEAR(point.z, 0.0, 1e-6);
    for (const Probe& probe : street.project.probes)
        EXPECT_LT(probe.position.z, 3.0);
}

double psnrUnderTheBridge(const PreparedCity& city, Method method) {
    const auto rems = loadRems(city, {});
    EXPECT_TRUE(rems.has_value());
    const auto scene = city.scene({});
    EXPECT_TRUE(scene.has_value());
    const auto map = [&](Method m) {
        auto made = reconstruct(city, rems->rems, scene->get(), m, kUnderTheBridge, {});
        EXPECT_TRUE(made.has_value());
        return std::move(*made);
    };
    FigureTally tally;
    tally.add(map(method), map(Method::RayTrace), city.project().exposure);
    return tally.figures(1).map.psnr.value_or(1000.0);
}

TEST(Overhead, ALocalMapUnderABridgeShowsItsUnderside) {
    const Street street(0.0, 0.0);
    Project solid = street.project;
    solid.heightfield.rules.policies[std::size_t(CityObjectType::Bridge)] = HeightPolicy::Column;
    const double spans = psnrUnderTheBridge(street.prepared(street.project), Method::Mem);
    const double column = psnrUnderTheBridge(street.prepared(solid), Method::Mem);
    const double blend = psnrUnderTheBridge(street.prepared(street.project), Method::Blend);
    RecordProperty("PSNR with the bridge as a span", std::to_string(spans));
    RecordProperty("PSNR with the bridge as a wall", std::to_string(column));
    RecordProperty("PSNR of plain blending", std::to_string(blend));
    std::printf("under the bridge: %.2f dB as a span, %.2f dB as a wall, %.2f dB blended\n", spans,
                column, blend);
    EXPECT_GT(spans, column + 3.0);
    EXPECT_GT(spans, blend + 1.0);
    // The texel straight above shows the deck where it is.
    const PreparedCity city = street.prepared(street.project);
    const auto rems = loadRems(city, {});
    const auto map = reconstruct(city, rems->rems, nullptr, Method::Mem, kUnderTheBridge, {});
    ASSERT_TRUE(map.has_value());
    const HeightfieldHit up = city.tracer().trace({kUnderTheBridge, {0.0, 0.0, 1.0}});
    ASSERT_TRUE(up.hit);
    EXPECT_NEAR(up.t, 4.0, 1e-6);
    const int middle = map->distance.resolution() / 2;
    EXPECT_NEAR(double(map->distance.at(4, middle, middle)), 4.0, 0.05);
}

TEST(Overhead, ACityFarFromTheOriginIsTheSameToTheLastBit) {
    const Street near(0.0, 0.0);
    const Street far(392'000.0, 5'820'000.0);
    const PreparedCity a = near.prepared(near.project);
    const PreparedCity b = far.prepared(far.project);
    ASSERT_NE(a.project().frame.origin, b.project().frame.origin);
    EXPECT_EQ(a.heightfield().grid, b.heightfield().grid);
    EXPECT_EQ(a.heightfield().ground, b.heightfield().ground);
    EXPECT_EQ(a.heightfield().topMax, b.heightfield().topMax);
    EXPECT_EQ(a.heightfield().topCenter, b.heightfield().topCenter);
    EXPECT_EQ(a.heightfield().spans, b.heightfield().spans);
    EXPECT_EQ(a.heightfield().centerSpans, b.heightfield().centerSpans);
    EXPECT_FALSE(a.heightfield().spans.empty());
    const auto picture = [](const PreparedCity& city) {
        const auto rems = loadRems(city, {});
        EXPECT_TRUE(rems.has_value());
        const auto traffic = trafficOf(city.project(), city.folder());
        EXPECT_TRUE(traffic.has_value());
        const View& view = city.project().views.front();
        RenderOptions options;
        options.width = 160;
        options.height = 90;
        options.samplesPerEdge = 2;
        const auto drawn = renderPicture(city, rems->rems, traffic->at(view.time),
                                         cameraOf(view, city.project().frame), options, {});
        EXPECT_TRUE(drawn.has_value());
        return toDisplayImage(*drawn, city.project().exposure).pixels;
    };
    const std::vector<glm::vec3> here = picture(a);
    EXPECT_EQ(here, picture(b));
    std::set<float> greens;
    for (const glm::vec3& pixel : here)
        greens.insert(pixel.g);
    EXPECT_GT(greens.size(), 100U) << "a picture of something";
}

}  // namespace
}  // namespace reflet
