// SPDX-License-Identifier: GPL-3.0-or-later
// What the window asks of the pipeline: cities that are shared and updated, figures, films, and
// all that makes a drawn route reflect.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Figures.h"
#include "app/pipeline/Film.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/MakeItReflect.h"
#include "app/pipeline/Traffic.h"
#include "app/pipeline/coverage/CoverageReport.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace reflet {
namespace {

/// A street of 90 m without vehicles or probes, prepared.
class WindowPipeline : public testing::Test {
protected:
    void SetUp() override {
        ImportRequest request;
        request.files = {folder.write("street.city.json", street.cityJson())};
        request.output = file;
        ASSERT_TRUE(importProject(request, {}).has_value());
        auto opened = PreparedCity::open(file, {});
        ASSERT_TRUE(opened.has_value()) << opened.error().message();
        city.emplace(std::move(*opened));
    }

    /// Along the middle of the street, without heights.
    [[nodiscard]] static RouteSpec streetRoute(double from = 5.0, double to = 85.0) {
        return {"main",
                "Main street",
                {{690'000.0 + from, 5'335'000.0, 77.0}, {690'000.0 + to, 5'335'000.0, -30.0}},
                0.0};
    }

    [[nodiscard]] ReflectResult reflecting() const {
        ReflectOptions options;
        options.vehicle = "car";
        options.resolution = 32;
        auto result = makeItReflect(*city, streetRoute(), options, {});
        EXPECT_TRUE(result.has_value()) << result.error().message();
        result->project.tuning.resolution = 32;
        return std::move(*result);
    }

    test::StreetCity street{9};
    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    std::optional<PreparedCity> city;
};

TEST_F(WindowPipeline, SharesTheCityWhenOnlyTheLightChanges) {
    const auto before = city->scene({});
    Project evening = city->project();
    evening.date.hour = 18;
    const auto updated = city->updated(evening, file, {});
    ASSERT_TRUE(updated.has_value());
    EXPECT_TRUE(updated->sharesCityWith(*city));
    EXPECT_NE(updated->lighting(), city->lighting());
    const auto after = updated->scene({});
    ASSERT_TRUE(before.has_value() && after.has_value());
    EXPECT_NE(*before, *after);
    EXPECT_EQ(&(*before)->city(), &(*after)->city());
    EXPECT_EQ((*city->drawn({}))->looks, (*updated->drawn({}))->looks);
}

TEST_F(WindowPipeline, LightsAnUpdatedCityAsAFreshOne) {
    Project evening = city->project();
    evening.date.hour = 18;
    ASSERT_TRUE(city->scene({}).has_value());
    const auto updated = city->updated(evening, file, {});
    const auto fresh = PreparedCity::prepare(evening, file, {});
    const Probe probe{"p", city->project().frame.origin + glm::dvec3(20, 0, 1.75), 32, false};
    const auto first = bakeProbe(*updated, probe, {});
    std::filesystem::remove_all(cacheFolder(file));
    const auto second = bakeProbe(*fresh, probe, {});
    ASSERT_TRUE(first.has_value() && second.has_value());
    EXPECT_EQ((*first)->radiance.texels(), (*second)->radiance.texels());
}

TEST_F(WindowPipeline, KeepsTheSceneWhenProbesAndTuningChange) {
    const auto before = city->scene({});
    Project changed = city->project();
    changed.probes.push_back({"p", {690'020.0, 5'335'000.0, 2.0}, std::nullopt, false});
    changed.tuning.depthRatio = 0.5;
    const auto updated = city->updated(changed, file, {});
    ASSERT_TRUE(updated.has_value());
    EXPECT_EQ(*before, *updated->scene({}));
    EXPECT_EQ(updated->project().probes.size(), 1U);
}

TEST_F(WindowPipeline, BuildsTheHeightfieldAloneWhenItsSettingsChange) {
    Project coarse = city->project();
    coarse.heightfield.cellSize = 2.0;
    const auto updated = city->updated(coarse, file, {});
    ASSERT_TRUE(updated.has_value());
    EXPECT_FALSE(updated->sharesCityWith(*city));
    EXPECT_EQ(&updated->city(), &city->city());
    EXPECT_EQ(updated->heightfield().grid.cellSize, 2.0);
}

TEST_F(WindowPipeline, MakesItsSceneOnceForThreadsThatAskTogether) {
    std::vector<std::shared_ptr<const RadianceScene>> scenes(6);
    {
        std::vector<std::jthread> threads;
        for (auto& scene : scenes)
            threads.emplace_back([&] { scene = *city->scene({}); });
    }
    EXPECT_NE(scenes.front(), nullptr);
    EXPECT_EQ(std::set(scenes.begin(), scenes.end()).size(), 1U);
}

TEST_F(WindowPipeline, NamesAMissingModelAndTakesItFromAnotherPlace) {
    const auto elsewhere = folder / "moved/town.city.json";
    std::filesystem::create_directories(elsewhere.parent_path());
    std::filesystem::rename(folder / "street.city.json", elsewhere);
    const auto missing = PreparedCity::prepare(city->project(), file, {});
    ASSERT_FALSE(missing.has_value());
    EXPECT_EQ(missing.error().code, ErrorCode::Unreadable);
    EXPECT_NE(missing.error().subject.find("street.city.json"), std::string::npos);
    EXPECT_FALSE(missing.error().remedy.empty());

    const auto relocated =
        relocateModel(city->project(), "street.city.json", elsewhere, folder.path());
    ASSERT_TRUE(relocated.has_value());
    EXPECT_EQ(relocated->models[0].path, "moved/town.city.json");
    EXPECT_TRUE(PreparedCity::prepare(*relocated, file, {}).has_value());
    EXPECT_FALSE(relocateModel(city->project(), "other.json", elsewhere, folder.path()));
}

TEST_F(WindowPipeline, RemarksOnAModelThatChangedUntilItIsAccepted) {
    folder.write("street.city.json", test::StreetCity(7).cityJson());
    const auto changed = PreparedCity::prepare(city->project(), file, {});
    ASSERT_TRUE(changed.has_value());
    ASSERT_EQ(changed->remarks().size(), 1U);
    EXPECT_EQ(changed->remarks()[0].code, "model-changed");
    const auto accepted = acceptChangedModels(city->project(), folder.path());
    ASSERT_TRUE(accepted.has_value());
    EXPECT_TRUE(PreparedCity::prepare(*accepted, file, {})->remarks().empty());
}

TEST_F(WindowPipeline, MakesARouteReflectWithVehicleProbesAndView) {
    const ReflectResult result = reflecting();
    const Project& project = result.project;
    ASSERT_EQ(project.routes.size(), 1U);
    for (const auto& point : project.routes[0].points)
        EXPECT_NEAR(point.z, 0.0, 1e-6);  // draped, whatever heights it came with
    ASSERT_EQ(project.reflectors.size(), 1U);
    EXPECT_EQ(project.reflectors[0].route, "main");
    ASSERT_GE(result.probes, 2U);
    ASSERT_EQ(project.probes.size(), result.probes);
    double before = 0.0;
    for (const auto& probe : project.probes) {
        EXPECT_NEAR(probe.position.z, 1.75, 1e-6);
        EXPECT_NEAR(probe.position.y, 5'335'000.0, 2.5) << "along the street";
        EXPECT_GT(probe.position.x, before) << "named in the order of the route";
        before = probe.position.x;
    }
    ASSERT_EQ(project.views.size(), 1U);
    EXPECT_NEAR(project.views[0].position.z, 1.6, 0.1);
    EXPECT_TRUE(result.remarks.empty());
    EXPECT_TRUE(projectFromJson(projectToJson(project), "made").has_value());
}

TEST_F(WindowPipeline, ReplacesWhatItMadeBeforeForTheSameRoute) {
    Project first = reflecting().project;
    first.probes[0].locked = true;
    first.probes.push_back({"mine", {690'030.0, 5'335'003.0, 2.0}, std::nullopt, false});
    const auto again = city->updated(first, file, {});
    ASSERT_TRUE(again.has_value());
    ReflectOptions options;
    options.mostProbes = 4;
    const auto second = makeItReflect(*again, streetRoute(), options, {});
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->project.routes.size(), 1U);
    EXPECT_EQ(second->project.reflectors.size(), 1U);
    EXPECT_EQ(second->project.views.size(), 1U);
    EXPECT_LE(second->probes, 4U);
    // And the locked one, and the user's own.
    EXPECT_EQ(second->project.probes.size(), second->probes + 2U);
}

TEST_F(WindowPipeline, PlacesProbesThatCoverMoreThanAsManyEvenlySpacedOnes) {
    const ReflectResult result = reflecting();
    const auto coverage = [&](const Project& project) {
        const auto made = city->updated(project, file, {});
        const auto report = reportCoverage(*made, {}, {});
        EXPECT_TRUE(report.has_value()) << report.error().message();
        return report->coverage.mean;
    };
    Project even = result.project;
    for (std::size_t i = 0; i < even.probes.size(); ++i)
        even.probes[i].position.x =
            690'005.0 + 80.0 * (double(i) + 0.5) / double(even.probes.size());
    EXPECT_GT(coverage(result.project), coverage(even));
}

TEST_F(WindowPipeline, NeverPlacesMoreProbesThanAllowed) {
    ReflectOptions options;
    options.vehicle = "car";
    options.mostProbes = 3;
    const auto result = makeItReflect(*city, streetRoute(), options, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->probes, 3U);
}

TEST_F(WindowPipeline, RefusesRoutesThatAreTooShortOutsideOrThroughHouses) {
    const auto tooShort = makeItReflect(*city, streetRoute(5.0, 20.0), {}, {});
    ASSERT_FALSE(tooShort.has_value());
    EXPECT_EQ(tooShort.error().code, ErrorCode::Usage);
    EXPECT_FALSE(tooShort.error().remedy.empty());
    const auto outside = makeItReflect(*city, streetRoute(5.0, 900.0), {}, {});
    ASSERT_FALSE(outside.has_value());
    EXPECT_EQ(outside.error().code, ErrorCode::Refused);
    RouteSpec through = streetRoute();
    for (auto& point : through.points)
        point.y += 10.0;  // the middle of the northern row
    const auto houses = makeItReflect(*city, through, {}, {});
    ASSERT_FALSE(houses.has_value());
    EXPECT_NE(houses.error().what.find("buildings"), std::string::npos);
}

TEST_F(WindowPipeline, TellsTheShareOfARouteThatRunsThroughHouses) {
    RouteSpec bent = streetRoute();
    bent.points = {{690'005.0, 5'335'000.0, 0.0},
                   {690'070.0, 5'335'000.0, 0.0},
                   {690'075.0, 5'335'013.0, 0.0}};
    ReflectOptions options;
    options.vehicle = "car";
    const auto result = makeItReflect(*city, bent, options, {});
    ASSERT_TRUE(result.has_value());
    ASSERT_FALSE(result->remarks.empty());
    EXPECT_EQ(result->remarks[0].code, "route-in-buildings");
}

TEST_F(WindowPipeline, MeasuresMethodsAtAPoseAndUsesReferencesAgain) {
    const auto made = city->updated(reflecting().project, file, {});
    ASSERT_TRUE(made.has_value());
    const auto rems = loadRems(*made, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(rems.has_value() && traffic.has_value());
    FiguresRequest request{traffic->atStation(0, 30.0),
                           {Method::Sky, Method::Mem, Method::RayTrace},
                           made->project().tuning,
                           {}};
    const auto figures = measurePose(*made, rems->rems, request, {});
    ASSERT_TRUE(figures.has_value()) << figures.error().message();
    ASSERT_EQ(figures->methods.size(), 3U);
    EXPECT_GT(*figures->methods.at(Method::Mem).map.psnr,
              *figures->methods.at(Method::Sky).map.psnr + 3.0);
    EXPECT_GT(figures->methods.at(Method::Mem).quads, 0.0);
    EXPECT_FALSE(figures->methods.at(Method::RayTrace).map.psnr.has_value());  // identical
    ASSERT_EQ(figures->references.size(), request.placed.poses.size());

    request.references = figures->references;
    request.tuning.depthRatio = 1.0;
    const auto again = measurePose(*made, rems->rems, request, {});
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->references, figures->references);
    request.tuning.resolution = 48;
    const auto finer = measurePose(*made, rems->rems, request, {});
    ASSERT_TRUE(finer.has_value());
    EXPECT_NE(finer->references, figures->references);
}

TEST_F(WindowPipeline, FollowsTheVehicleOnFilmFromThePavement) {
    const auto made = city->updated(reflecting().project, file, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(made.has_value() && traffic.has_value());
    const FilmCamera film(*made, *traffic, 0, 0.0, 20.0);
    for (double second = 0.0; second < 20.0; second += 0.5) {
        const Camera camera = film.at(second);
        const PlacedReflector placed = traffic->at(0, film.driveTime(second));
        EXPECT_LT(glm::distance(camera.target, placed.middle()), 1.0) << second;
        EXPECT_NEAR(camera.position.z, 1.6, 0.5);
        EXPECT_LT(std::abs(camera.position.y), 6.5);                   // between the house fronts
        EXPECT_LT(placed.station, traffic->route(0).length() - 1e-6);  // it never stands still
    }
}

TEST_F(WindowPipeline, WritesAFilmAndNothingWhenItIsCancelled) {
    const auto made = city->updated(reflecting().project, file, {});
    const auto rems = loadRems(*made, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(rems.has_value() && traffic.has_value());
    FilmOptions options;
    options.width = 64;
    options.height = 36;
    options.seconds = 0.5;
    options.framesPerSecond = 10;
    options.encoder = VideoWriter::Encoder::Pictures;
    const auto film = renderFilm(*made, rems->rems, *traffic, options, folder / "out/film.mp4", {});
    EXPECT_FALSE(film.has_value());  // the folder does not exist
    std::filesystem::create_directory(folder / "out");
    const auto written =
        renderFilm(*made, rems->rems, *traffic, options, folder / "out/film.mp4", {});
    ASSERT_TRUE(written.has_value()) << written.error().message();
    EXPECT_EQ(written->frames, 5U);
    EXPECT_TRUE(std::filesystem::exists(written->file / "frame-00005.png"));

    options.right = Method::RayTrace;
    const auto traced = renderFilm(*made, rems->rems, *traffic, options, folder / "out/t.mp4", {});
    ASSERT_FALSE(traced.has_value());
    EXPECT_EQ(traced.error().code, ErrorCode::Usage);
    options.right.reset();

    std::stop_source stop;
    stop.request_stop();
    const auto cancelled = renderFilm(*made, rems->rems, *traffic, options,
                                      folder / "out/other.mp4", JobContext({}, stop.get_token()));
    ASSERT_FALSE(cancelled.has_value());
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/other"));
}

TEST_F(WindowPipeline, AFilmWithACameraOfItsOwnDrivesOnWithoutCutsAndAgainFromTheStart) {
    const auto made = city->updated(reflecting().project, file, {});
    const auto rems = loadRems(*made, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(rems.has_value() && traffic.has_value());
    FilmOptions options;
    options.width = 64;
    options.height = 36;
    options.seconds = 1.0;
    options.framesPerSecond = 4;
    options.start = traffic->duration() - 0.6;
    options.encoder = VideoWriter::Encoder::Pictures;
    std::vector<double> asked;
    options.camera = [&](double seconds) {
        asked.push_back(seconds);
        return streetCamera(*made, traffic->at(0, seconds));
    };
    const auto film = renderFilm(*made, rems->rems, *traffic, options, folder / "own.mp4", {});
    ASSERT_TRUE(film.has_value()) << film.error().message();
    ASSERT_EQ(asked.size(), 4U);
    EXPECT_NEAR(asked[1] - asked[0], 0.25, 1e-9);
    EXPECT_NEAR(asked[2] - asked[1], 0.25, 1e-9);
    EXPECT_NEAR(asked[3], 0.15, 1e-9);
}

TEST_F(WindowPipeline, LeftAndRightOfTheBarAreThePicturesOfTheTwoMethods) {
    const auto made = city->updated(reflecting().project, file, {});
    const auto rems = loadRems(*made, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(rems.has_value() && traffic.has_value());
    const std::vector<PlacedReflector> placed{traffic->atStation(0, 25.0)};
    const Camera camera = streetCamera(*made, placed[0]);
    RenderOptions options;
    options.width = 48;
    options.height = 27;
    options.samplesPerEdge = 1;
    const auto picture = [&](Method method, std::optional<Method> right) {
        options.method = method;
        options.right = right;
        const auto view = renderPicture(*made, rems->rems, placed, camera, options, {});
        EXPECT_TRUE(view.has_value());
        return view ? view->radiance : std::vector<glm::vec3>();
    };
    options.wipe = 0.25F;
    const auto sky = picture(Method::Sky, std::nullopt);
    const auto mem = picture(Method::Mem, std::nullopt);
    const auto both = picture(Method::Sky, Method::Mem);
    ASSERT_NE(sky, mem);
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_EQ(both[i], i % 48 < 12 ? sky[i] : mem[i]) << i;
}

TEST_F(WindowPipeline, SeesAVehicleFromTheKerbAndNotFromWithinWalls) {
    const auto made = city->updated(reflecting().project, file, {});
    const auto traffic = trafficOf(made->project(), made->folder());
    ASSERT_TRUE(made.has_value() && traffic.has_value());
    const PlacedReflector placed = traffic->atStation(0, 25.0);
    const glm::dvec3 kerb = placed.middle() + glm::dvec3(6.0, -4.0, 0.0);
    EXPECT_GT(streetSight(*made, placed, kerb), 0.9);
    EXPECT_EQ(streetSight(*made, placed, placed.middle() + glm::dvec3(0.0, 10.0, 0.0)), 0.0);
    const View view = streetView(*made, *traffic, 0);
    EXPECT_GT(streetSight(*made, traffic->at(0, view.time), made->inFrame(view.position)), 0.9);
}

}  // namespace
}  // namespace reflet
