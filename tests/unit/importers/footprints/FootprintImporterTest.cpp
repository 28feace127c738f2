// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ClosedCity.h"
#include "tests/unit/importers/footprints/FootprintText.h"

#include <GeographicLib/UTMUPS.hpp>
#include <set>

namespace reflet {
namespace {

using namespace test;

std::size_t surfacesOf(const CityModel& city, SurfaceType type) {
    return std::size_t(std::count_if(city.surfaces.begin(), city.surfaces.end(),
                                     [&](const CitySurface& s) { return s.type == type; }));
}

TEST(FootprintImporter, ExtrudesAFootprintToAClosedBuildingThatLooksOutward) {
    const auto result =
        imported(collection({feature(rectangle(85000, 446000), R"({"height": 7})")}));
    const CityModel& city = result.value.city;
    EXPECT_EQ(result.counts.loaded, 1U);
    ASSERT_EQ(city.objects.size(), 1U);
    EXPECT_EQ(city.objects[0].type, CityObjectType::Building);
    EXPECT_EQ(city.objects[0].lod, "1");
    EXPECT_EQ(surfacesOf(city, SurfaceType::Ground), 1U);
    EXPECT_EQ(surfacesOf(city, SurfaceType::Wall), 4U);
    EXPECT_EQ(surfacesOf(city, SurfaceType::Roof), 1U);
    EXPECT_EQ(city.triangles.size(), 12U);
    EXPECT_EQ(city.vertices.size(), 8U);
    EXPECT_EQ(openEdges(city), 0U);
    EXPECT_NEAR(volume(city), 200.0 * 7.0, 1e-2);
    EXPECT_EQ(city.frame.crs, "EPSG:28992");
    EXPECT_EQ(city.frame.origin, glm::dvec3(85000, 446000, 0));
    EXPECT_EQ(result.value.aboveGround, std::vector<std::uint32_t>{0});
    for (std::size_t t = 0; t < city.triangles.size(); ++t) {
        if (city.surfaces[city.triangles[t].surface].type == SurfaceType::Roof) {
            EXPECT_GT(city.normal(t).z, 0.99F);
        }
    }
}

TEST(FootprintImporter, KeepsHolesAndPartsWhateverTheDirectionOfRings) {
    // Clockwise outside, counter-clockwise inside, and a second part.
    const std::string parts =
        R"({"type": "MultiPolygon", "coordinates": [
            [[[0,0],[0,10],[20,10],[20,0],[0,0]], [[5,4],[15,4],[15,7],[5,7],[5,4]]],
            [[[30,0],[40,0],[40,10],[30,10],[30,0]]]]})";
    ImportOptions options;
    options.crs = "local";
    const auto result = imported(collection({feature(parts, R"({"height": 3})")}, ""), options);
    EXPECT_EQ(result.counts.loaded, 1U);
    EXPECT_EQ(openEdges(result.value.city), 0U);
    EXPECT_NEAR(volume(result.value.city), (170.0 + 100.0) * 3.0, 1e-3);
    EXPECT_FALSE(result.value.city.frame.crs);
}

TEST(FootprintImporter, BringsDegreesIntoTheUtmZone) {
    const std::string ring =
        "[[9.9900,53.5500],[9.9906,53.5500],[9.9906,53.5503],[9.9900,53.5503],[9.9900,53.5500]]";
    const auto result = imported(collection({feature(polygon(ring), R"({"height": 10})")}, ""));
    const CityModel& city = result.value.city;
    EXPECT_EQ(result.value.summary.crsHorizontal, "EPSG:4326");
    ASSERT_EQ(city.frame.crs, "EPSG:32632");
    for (const auto& [lon, lat] : {std::pair(9.99, 53.55), std::pair(9.9906, 53.55),
                                   std::pair(9.9906, 53.5503), std::pair(9.99, 53.5503)}) {
        int zone = 0;
        bool north = false;
        double x = 0.0, y = 0.0;
        GeographicLib::UTMUPS::Forward(lat, lon, zone, north, x, y);
        ASSERT_EQ(zone, 32);
        bool near = false;
        for (const glm::vec3& v : city.vertices)
            near = near || glm::distance(glm::dvec2(v) + glm::dvec2(city.frame.origin),
                                         glm::dvec2(x, y)) < 2e-3;
        EXPECT_TRUE(near) << lon << " " << lat;
    }
    EXPECT_EQ(openEdges(city), 0U);
    EXPECT_GT(volume(city), 0.0);
    EXPECT_NE(remark(result.diagnostics, "reprojected"), nullptr);
}

TEST(FootprintImporter, TakesMetresWithoutACrsForMetresAndObeysTheUser) {
    const std::string text = collection({feature(rectangle(385000, 5746000))}, "");
    const auto local = imported(text);
    EXPECT_FALSE(local.value.city.frame.crs);
    EXPECT_NE(remark(local.diagnostics, "no-crs"), nullptr);
    ImportOptions options;
    options.crs = "EPSG:25832";
    EXPECT_EQ(imported(text, options).value.city.frame.crs, "EPSG:25832");
}

TEST(FootprintImporter, ReadsLatitudeFirstAndStillLooksOutward) {
    const std::string ring =
        "[[53.5500,9.9900],[53.5500,9.9906],[53.5503,9.9906],[53.5503,9.9900],[53.5500,9.9900]]";
    ImportOptions options;
    options.crs = "EPSG:4258";  // ETRS89, made for Europe: there the order is seen
    const auto result =
        imported(collection({feature(polygon(ring), R"({"height": 10})")}, ""), options);
    EXPECT_NE(remark(result.diagnostics, "axis-order"), nullptr);
    EXPECT_GT(volume(result.value.city), 0.0);
    EXPECT_EQ(openEdges(result.value.city), 0U);
}

TEST(FootprintImporter, MendsCrossingRingsAndSaysSo) {
    const std::string bowTie = polygon("[[0,0],[10,0],[0,10],[10,10],[0,0]]");
    const std::string repeated = polygon("[[20,0],[30,0],[30,0],[30,10],[20,0]]");
    ImportOptions options;
    options.crs = "local";
    const auto result = imported(collection({feature(bowTie, R"({"id": "bow", "height": 2})"),
                                             feature(repeated, R"({"id": "twice", "height": 2})")},
                                            ""),
                                 options);
    EXPECT_EQ(result.counts.repaired, 2U);
    EXPECT_EQ(result.counts.skipped, 0U);
    EXPECT_EQ(openEdges(result.value.city), 0U);
    EXPECT_NEAR(volume(result.value.city), (50.0 + 50.0) * 2.0, 1e-3);
    const Diagnostic* told = remark(result.diagnostics, "footprint-repaired");
    ASSERT_NE(told, nullptr);
    EXPECT_EQ(told->object, "bow");
}

TEST(FootprintImporter, AccountsForEachFeatureThatIsNoArea) {
    const auto result = imported(collection({
        feature(rectangle(85000, 446000), R"({"height": 7})"),
        feature("null"),
        feature(R"({"type": "Point", "coordinates": [85000, 446000]})"),
        feature(polygon("[[85000,446000],[85010,446000],[85020,446000],[85000,446000]]")),
    }));
    EXPECT_EQ(result.counts.loaded, 1U);
    EXPECT_EQ(result.counts.skipped, 3U);
    EXPECT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(std::count_if(result.diagnostics.begin(), result.diagnostics.end(),
                            [](const Diagnostic& d) { return d.code == "no-area"; }),
              3);
}

TEST(FootprintImporter, TakesHeightsFromTheUsualAttributes) {
    const auto top = [](const std::string& properties, const ImportOptions& options = {}) {
        const auto result =
            imported(collection({feature(rectangle(85000, 446000), properties)}), options);
        const Box box = result.value.city.bounds();
        return std::pair(box.min.z, box.max.z);
    };
    using Span = std::pair<double, double>;
    EXPECT_EQ(top(R"({"height": "12.5 m"})"), Span(0.0, 12.5));
    EXPECT_EQ(top(R"({"building:levels": 4})").second, double(float(12.4)));
    EXPECT_EQ(top(R"({"num_floors": 2, "height": null})").second, double(float(6.2)));
    EXPECT_EQ(top(R"({"height": 20, "min_height": 5})"), Span(5.0, 20.0));
    EXPECT_EQ(top(R"({"b3_h_dak_70p": 16.0, "b3_h_maaiveld": 1.5})"), Span(1.5, 16.0));
    EXPECT_EQ(top(R"({"height": 8, "ground_elevation": 30})"), Span(30.0, 38.0));
    ImportOptions options;
    options.heightField = "rise";
    options.baseField = "foot";
    EXPECT_EQ(top(R"({"height": 99, "rise": 4, "foot": 100})", options), Span(100.0, 104.0));
    options = {};
    options.defaultHeight = 5.0;
    EXPECT_EQ(top("{}", options), Span(0.0, 5.0));
}

TEST(FootprintImporter, SaysForHowManyTheHeightWasAssumed) {
    const std::string text = collection({
        feature(rectangle(85000, 446000), R"({"height": 7})"),
        feature(rectangle(85100, 446000), R"({"height": "tall"})"),
        feature(rectangle(85200, 446000), R"({"height": 0})"),
    });
    const auto result = imported(text);
    const Diagnostic* assumed = remark(result.diagnostics, "height-assumed");
    ASSERT_NE(assumed, nullptr);
    EXPECT_NE(assumed->text.find("2 of 3 buildings"), std::string::npos) << assumed->text;
    EXPECT_NE(assumed->text.find("9 m"), std::string::npos) << assumed->text;
    const Diagnostic* unreadable = remark(result.diagnostics, "height-unreadable");
    ASSERT_NE(unreadable, nullptr);
    EXPECT_NE(unreadable->text.find("tall"), std::string::npos) << unreadable->text;
    EXPECT_EQ(result.counts.loaded, 3U);
    ImportOptions strict;
    strict.strict = true;
    const auto refused = importFootprintBytes(text, "test.geojson", strict, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Refused);
}

TEST(FootprintImporter, RefusesAFieldThatIsNotThereAndNamesThoseThatAre) {
    ImportOptions options;
    options.heightField = "hohe";
    const auto result = importFootprintBytes(
        collection({feature(rectangle(85000, 446000), R"({"height": 7, "use": "shop"})")}),
        "test.geojson", options, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Usage);
    EXPECT_NE(result.error().remedy.find("height, use"), std::string::npos)
        << result.error().remedy;
}

TEST(FootprintImporter, KeepsWhatTouchesTheBoxAndGivesEachObjectAnIdOfItsOwn) {
    const std::string text = collection({
        feature(rectangle(85000, 446000), R"({"id": "a", "height": 7})"),
        feature(rectangle(85100, 446000), R"({"id": "a", "height": 7})"),
        feature(rectangle(85200, 446000), R"({"height": 7})"),
    });
    std::set<std::string> ids;
    for (const CityObject& object : imported(text).value.city.objects)
        ids.insert(object.id);
    EXPECT_EQ(ids.size(), 3U);
    EXPECT_TRUE(ids.contains("a"));
    ImportOptions options;
    options.bbox = {85090, 445990, 85130, 446020};
    const auto result = imported(text, options);
    EXPECT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(result.counts.loaded, 1U);
}

TEST(FootprintImporter, BuildsTheRoofsThatAttributesTellOf) {
    const auto result = imported(collection({feature(
        rectangle(85000, 446000), R"({"height": 9, "roof_shape": "gabled", "roof_height": 3})")}));
    const CityModel& city = result.value.city;
    EXPECT_EQ(city.objects.at(0).lod, "2");
    EXPECT_EQ(openEdges(city), 0U);
    EXPECT_NEAR(volume(city), 200.0 * 6.0 + 300.0, 0.5);
}

}  // namespace
}  // namespace reflet
