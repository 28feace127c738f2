// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate reference systems, and how coordinates reach the project frame.
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityJsonText.h"

#include <GeographicLib/UTMUPS.hpp>
#include <bit>
#include <cmath>
#include <cstdio>

namespace reflet {

using namespace test;

namespace {

json withCrs(json city, const std::string& system) {
    city["metadata"] = {{"referenceSystem", system}};
    return city;
}

json withoutCrs(json city) {
    city.erase("metadata");
    return city;
}

ImportOptions withOption(const std::string& crs) {
    ImportOptions options;
    options.crs = crs;
    return options;
}

void expectSameVertices(const CityModel& a, const CityModel& b) {
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(std::bit_cast<std::uint32_t>(a.vertices[i][axis]),
                      std::bit_cast<std::uint32_t>(b.vertices[i][axis]))
                << "vertex " << i << " axis " << axis;
    }
}

/// Sloping quads with odd millimetres all over a square kilometre.
json manyPoints() {
    json city = emptyCity();
    json faces = json::array();
    unsigned state = 12345;
    const auto next = [&](int range) {
        state = state * 1664525U + 1013904223U;
        return static_cast<int>((state >> 8U) % static_cast<unsigned>(range));
    };
    for (int i = 0; i < 600; ++i) {
        city["vertices"].push_back({next(1'000'000), next(1'000'000), next(90'000)});
        if (i % 3 == 2)
            faces.push_back({{i - 2, i - 1, i}});
    }
    city["CityObjects"]["a"] = object("TINRelief", json::array({surfaces("1", faces)}));
    return city;
}

}  // namespace

TEST(CityJsonCrs, IsReadInEverySpelling) {
    for (const char* spelling : {"https://www.opengis.net/def/crs/EPSG/0/28992",
                                 "http://www.opengis.net/def/crs/EPSG/0/28992",
                                 "urn:ogc:def:crs:EPSG::28992", "EPSG:28992"}) {
        const auto result = import(withCrs(boxCity(), spelling));
        EXPECT_EQ(result.value.city.frame.crs, "EPSG:28992") << spelling;
        EXPECT_FALSE(result.value.city.frame.vertical) << spelling;
        EXPECT_TRUE(result.diagnostics.empty()) << spelling;
    }
    const auto compound = import(withCrs(boxCity(), "urn:ogc:def:crs:EPSG::7415"));
    EXPECT_EQ(compound.value.summary.crsHorizontal, "EPSG:28992");
    EXPECT_EQ(compound.value.summary.crsVertical, "EPSG:5709");
    EXPECT_EQ(compound.value.city.frame.vertical, "EPSG:5709");

    json old = boxCity();
    old["version"] = "1.0";
    old["metadata"] = {{"crs", {{"epsg", 7415}}}};
    EXPECT_EQ(import(old).value.summary.crsHorizontal, "EPSG:28992");
}

TEST(CityJsonCrs, ThatIsAbsentGivesLocalMetresWithAWarning) {
    for (json city : {withoutCrs(boxCity()), withCrs(boxCity(), "")}) {
        const auto result = import(city);
        EXPECT_FALSE(result.value.city.frame.crs);
        EXPECT_FALSE(result.value.summary.crsHorizontal);
        EXPECT_EQ(textOf(result, "no-crs"),
                  "no coordinate reference system is declared; the coordinates were taken as local "
                  "metres");
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    }
    const auto local = import(withoutCrs(boxCity()), withOption("local"));
    EXPECT_FALSE(local.value.city.frame.crs);
    EXPECT_TRUE(local.diagnostics.empty());

    ImportOptions strict;
    strict.strict = true;
    const Error error = importError(withoutCrs(boxCity()).dump(), strict);
    EXPECT_EQ(error.code, ErrorCode::Refused);
    EXPECT_EQ(error.what, "declares no coordinate reference system");
    EXPECT_NE(error.remedy.find("--crs EPSG:25832"), std::string::npos);
}

TEST(CityJsonCrs, OfTheCallerCountsOnlyWhereTheFileDeclaresNone) {
    const auto given = import(withoutCrs(boxCity()), withOption("EPSG:28992"));
    EXPECT_EQ(given.value.city.frame.crs, "EPSG:28992");
    EXPECT_TRUE(given.diagnostics.empty());
    const auto declared = import(boxCity(), withOption("EPSG:25832"));
    EXPECT_EQ(declared.value.city.frame.crs, "EPSG:28992");
    EXPECT_FALSE(tryImport(withoutCrs(boxCity()).dump(), withOption("EPSG:999999")));
}

TEST(CityJsonCrs, ThatIsUnknownIsRefusedWithARemedy) {
    const std::string unknown = withCrs(boxCity(), "EPSG:999999").dump();
    const Error error = importError(unknown);
    EXPECT_EQ(error.code, ErrorCode::Refused);
    EXPECT_NE(
        error.what.find("declares the coordinate reference system \"EPSG:999999\", which cannot "
                        "be used"),
        std::string::npos);
    EXPECT_NE(error.remedy.find("--crs"), std::string::npos);

    const auto replaced = tryImport(unknown, withOption("EPSG:28992"));
    ASSERT_TRUE(replaced) << replaced.error().message();
    EXPECT_EQ(replaced->value.city.frame.crs, "EPSG:28992");
    EXPECT_NE(findDiagnostic(*replaced, "crs-replaced"), nullptr);
    EXPECT_EQ(importError(withCrs(boxCity(), "EPSG:4978").dump()).code, ErrorCode::Refused);
}

TEST(CityJsonCrs, SceneHasTheSameBitsWhereverItLies) {
    json near = withoutCrs(manyPoints());
    near["transform"]["translate"] = {123.456, 789.012, 34.567};
    json far = withCrs(manyPoints(), "EPSG:25832");
    far["transform"]["translate"] = {389123.456, 5820789.012, 34.567};
    const auto a = import(near, withOption("local"));
    const auto b = import(far);
    EXPECT_EQ(a.value.city.frame.origin, glm::dvec3(1000.0, 1000.0, 0.0));
    EXPECT_EQ(b.value.city.frame.origin, glm::dvec3(390000.0, 5821000.0, 0.0));
    expectSameVertices(a.value.city, b.value.city);
    EXPECT_EQ(a.value.city.triangles.size(), b.value.city.triangles.size());
}

TEST(CityJsonCrs, SceneWithoutTransformHasTheSameBitsWhereverItLies) {
    const json scene = manyPoints();
    const auto placed = [&](double east, double north) {
        json city = withoutCrs(scene);
        city["version"] = "1.0";
        city.erase("transform");
        for (json& vertex : city["vertices"]) {
            // Three decimals in the text, as writers have it.
            char text[120];
            std::snprintf(
                text, sizeof text, "[%.3f,%.3f,%.3f]", east + vertex[0].get<double>() / 1000.0,
                north + vertex[1].get<double>() / 1000.0, vertex[2].get<double>() / 1000.0);
            vertex = json::parse(text);
        }
        return import(city, withOption("local"));
    };
    const auto a = placed(0.0, 0.0);
    const auto b = placed(25'513'000.0, 6'686'000.0);
    expectSameVertices(a.value.city, b.value.city);
}

TEST(CityJsonCrs, FrameOfTheCallerIsKept) {
    ImportOptions options;
    options.frame = ProjectFrame{"EPSG:28992", "EPSG:5709", {80000.0, 440000.0, 0.0}};
    const auto result = import(boxCity(), options);
    EXPECT_EQ(result.value.city.frame, *options.frame);
    EXPECT_NEAR(result.value.city.bounds().min.x, 5000.0, 1e-3);
    EXPECT_NEAR(result.value.city.bounds().min.y, 6000.0, 1e-3);
    EXPECT_TRUE(result.diagnostics.empty());
}

TEST(CityJsonCrs, WithoutOneTheCoordinatesAreThoseOfTheCallersFrame) {
    ImportOptions options;
    options.frame = ProjectFrame{"EPSG:28992", {}, {85000.0, 446000.0, 0.0}};
    const auto result = import(withoutCrs(boxCity()), options);
    EXPECT_NEAR(result.value.city.bounds().max.x, 10.0, 1e-5);
    EXPECT_NE(findDiagnostic(result, "no-crs"), nullptr);
}

TEST(CityJsonCrs, FileInOneIsRefusedIntoALocalProject) {
    ImportOptions options;
    options.frame = ProjectFrame{};
    const Error error = importError(boxCity().dump(), options);
    EXPECT_EQ(error.code, ErrorCode::Refused);
    EXPECT_NE(error.what.find("but the project has local coordinates"), std::string::npos);
}

TEST(CityJsonCrs, AnotherThanTheFramesIsTransformedAndHeightsStay) {
    // Zone 32 into zone 33, where the city lies between both.
    json city = withCrs(boxCity(), "EPSG:32632");
    city["transform"]["translate"] = {830000.0, 5400000.0, 250.0};
    ImportOptions options;
    options.frame = ProjectFrame{"EPSG:32633", {}, {389000.0, 5399000.0, 0.0}};
    const auto result = import(city, options);
    const CityModel& model = result.value.city;
    ASSERT_EQ(model.vertices.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        const json v = boxVertices()[i];
        double latitude = 0.0;
        double longitude = 0.0;
        double x = 0.0;
        double y = 0.0;
        int zone = 0;
        bool north = true;
        GeographicLib::UTMUPS::Reverse(32, true, 830000.0 + v[0].get<double>() / 1000.0,
                                       5400000.0 + v[1].get<double>() / 1000.0, latitude,
                                       longitude);
        GeographicLib::UTMUPS::Forward(latitude, longitude, zone, north, x, y, 33);
        EXPECT_NEAR(model.vertices[i].x + 389000.0, x, 2e-3);
        EXPECT_NEAR(model.vertices[i].y + 5399000.0, y, 2e-3);
        EXPECT_NEAR(model.vertices[i].z, 250.0 + v[2].get<double>() / 1000.0, 1e-4);
    }
    EXPECT_NE(findDiagnostic(result, "heights-unchanged"), nullptr);
    EXPECT_NEAR(result.value.summary.bounds.min.x, 830000.0, 1e-6);
}

TEST(CityJsonCrs, InDegreesIsBroughtIntoTheUtmZone) {
    for (const bool latitudeFirst : {false, true}) {
        json city = emptyCity();
        city["metadata"]["referenceSystem"] = "http://www.opengis.net/def/crs/EPSG/0/6697";
        city["transform"] = {{"scale", {1e-7, 1e-7, 0.01}}, {"translate", {139.74, 35.26, 5.0}}};
        city["vertices"] = {{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 100}, {0, 1000, 100}};
        if (latitudeFirst) {
            std::swap(city["transform"]["translate"][0], city["transform"]["translate"][1]);
            for (json& v : city["vertices"])
                std::swap(v[0], v[1]);
        }
        city["CityObjects"]["a"] =
            object("Building", json::array({surfaces("1", {{{0, 1, 2, 3}}})}));
        const auto result = import(city);
        const CityModel& model = result.value.city;
        EXPECT_EQ(model.frame.crs, "EPSG:32654");
        ASSERT_EQ(model.vertices.size(), 4U);
        double x = 0.0;
        double y = 0.0;
        int zone = 0;
        bool north = true;
        GeographicLib::UTMUPS::Forward(35.2601, 139.7401, zone, north, x, y);
        EXPECT_EQ(zone, 54);
        EXPECT_NEAR(model.vertices[2].x + model.frame.origin.x, x, 5e-3);
        EXPECT_NEAR(model.vertices[2].y + model.frame.origin.y, y, 5e-3);
        EXPECT_NEAR(model.vertices[2].z, 6.0F, 1e-5F);
        EXPECT_NE(textOf(result, "reprojected").find("EPSG:32654"), std::string::npos);
        EXPECT_EQ(findDiagnostic(result, "axis-order") != nullptr, latitudeFirst);
        EXPECT_NEAR(result.value.summary.bounds.min.x, 139.74, 1e-9);  // east first
        EXPECT_NEAR(result.value.summary.bounds.min.y, 35.26, 1e-9);
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    }
}

TEST(CityJsonCrs, TargetCanBeChosenWithoutAFrame) {
    json city = withCrs(boxCity(), "EPSG:32632");
    city["transform"]["translate"] = {830000.0, 5400000.0, 0.0};
    ImportOptions options;
    options.projectCrs = "EPSG:32633";
    const auto result = import(city, options);
    EXPECT_EQ(result.value.city.frame.crs, "EPSG:32633");
    EXPECT_EQ(std::fmod(result.value.city.frame.origin.x, 1000.0), 0.0);
    EXPECT_LT(glm::length(glm::dvec2(result.value.city.bounds().center())), 1000.0);
    options.projectCrs = "EPSG:4326";
    EXPECT_EQ(importError(city.dump(), options).code, ErrorCode::Refused);
}

TEST(CityJsonCrs, InFeetIsBroughtIntoMetresWithItsHeights) {
    // NAD83 / California zone 6 in US survey feet, near San Diego.
    json city = withCrs(boxCity(), "EPSG:2230");
    city["transform"] = {{"scale", {0.01, 0.01, 0.01}}, {"translate", {6280000.0, 1850000.0, 0.0}}};
    const auto result = import(city);
    EXPECT_EQ(result.value.city.frame.crs, "EPSG:32611");
    constexpr double kFoot = 1200.0 / 3937.0;
    // 100 by 80 by 60 feet; the projections' scales differ by less than 1e-3.
    EXPECT_NEAR(enclosedVolume(result.value.city) / (480000.0 * std::pow(kFoot, 3)), 1.0, 2e-3);
    EXPECT_NEAR(result.value.city.bounds().max.z, 60.0 * kFoot, 1e-3);
    EXPECT_NE(findDiagnostic(result, "height-unit"), nullptr);
}

TEST(CityJsonCrs, CoordinatesOutsideItsAreaDrawAWarning) {
    json city = boxCity();
    city["transform"]["translate"] = {446000.0, 85000.0, 0.0};
    const auto result = import(city);
    EXPECT_NE(textOf(result, "axes-exchanged")
                  .find("with east and north exchanged they would lie inside"),
              std::string::npos);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    city["transform"]["translate"] = {2'000'000.0, 3'000'000.0, 0.0};
    const auto nowhere = import(city);
    EXPECT_NE(findDiagnostic(nowhere, "outside-area-of-use"), nullptr);
    EXPECT_EQ(findDiagnostic(nowhere, "axes-exchanged"), nullptr);
}

TEST(CityJsonCrs, StrayObjectDoesNotTakeTheFrameAway) {
    json city = withoutCrs(manyPoints());
    city["vertices"].push_back({900'000'000'000, 0, 0});
    city["vertices"].push_back({900'000'010'000, 0, 0});
    city["vertices"].push_back({900'000'000'000, 10'000, 0});
    city["CityObjects"]["stray"] =
        object("Building", json::array({surfaces("1", {{{600, 601, 602}}})}));
    const auto result = import(city, withOption("local"));
    EXPECT_NE(findDiagnostic(result, "far-apart"), nullptr);
    EXPECT_LT(std::abs(result.value.city.frame.origin.x - 85000.0), 2000.0);
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonCrs, InspectionReportsAnUnknownOneAndCountsAllTheSame) {
    const json city = withCrs(boxCity(), "EPSG:999999");
    const TemporaryFolder folder;
    const auto result = inspectCityJson(folder.write("a.city.json", city.dump()), {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->value.triangles, 12U);
    EXPECT_FALSE(result->value.crsHorizontal);
    const Diagnostic* unknown = findDiagnostic(*result, "crs-unknown");
    ASSERT_NE(unknown, nullptr);
    EXPECT_EQ(unknown->severity, Severity::Error);
}

}  // namespace reflet
