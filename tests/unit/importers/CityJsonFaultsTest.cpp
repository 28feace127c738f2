// SPDX-License-Identifier: GPL-3.0-or-later
// One bad object never costs the file: what is mended, what is skipped, and what is said.
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

namespace {

/// A sound box "good" and the object "bad" beside it.
json withBadObject(const json& bad) {
    json city = boxCity();
    city["CityObjects"] = {{"good", city["CityObjects"]["a"]}, {"bad", bad}};
    return city;
}

void expectGoodIsWhole(const Imported<CityImport>& result) {
    const auto& city = result.value.city;
    std::size_t triangles = 0;
    for (const CityTriangle& triangle : city.triangles)
        triangles += city.objects[city.surfaces[triangle.surface].object].id == "good" ? 1 : 0;
    EXPECT_EQ(triangles, 12U);
    EXPECT_EQ(result.counts.loaded + result.counts.repaired + result.counts.skipped, 2U);
}

}  // namespace

TEST(CityJsonFaults, SurfaceWithAnIndexOutOfRangeIsLeftOut) {
    for (const char* index : {"8", "4294967295", "99999999999999999999", "-1", "1.5", "null",
                              "\"1\"", "1e300", "true"}) {
        json shell = boxShell();
        shell[2][0][1] = json::parse(index);
        const auto result =
            import(withBadObject(object("Building", json::array({solid("2", shell)}))));
        expectGoodIsWhole(result);
        EXPECT_EQ(result.value.city.triangles.size(), 22U) << index;
        EXPECT_EQ(countsOf(result), "1 loaded, 1 repaired, 0 skipped") << index;
        EXPECT_NE(findDiagnostic(result, "index-out-of-range", "bad"), nullptr) << index;
    }
    json shell = boxShell();
    shell[2][0][1] = 8;
    const auto result = import(withBadObject(object("Building", json::array({solid("2", shell)}))));
    EXPECT_EQ(
        textOf(result, "index-out-of-range", "bad"),
        "left out: 1 surface with a vertex that does not exist (index 8, counted from 0, of 8)");
}

TEST(CityJsonFaults, ObjectWithNothingButBadIndicesIsSkipped) {
    const auto result = import(withBadObject(
        object("Building", json::array({surfaces("1", {{{50, 51, 52}}, {{60, 61, 62}}})}))));
    expectGoodIsWhole(result);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped");
    EXPECT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(textOf(result, "no-usable-geometry", "bad"),
              "skipped: nothing of its geometry can be used");
}

TEST(CityJsonFaults, ObjectThatUsesAnUnusableVertexIsSkipped) {
    for (const char* vertex :
         {"[1e300,0,0]", "[0,1e12,0]", "[0,0,-1e13]", "[1e400,0,0]", "[0,0,null]", "[0,0]", "[]",
          "[0,\"1\",0]", "7", "null", "{}", "[[0],0,0]"}) {
        json city = withBadObject(object("Building", json::array({solid("2", boxShell(8))})));
        for (const json& corner : boxVertices(20000))
            city["vertices"].push_back(corner);
        city["vertices"][9] = "place";
        std::string text = city.dump();
        text.replace(text.find("\"place\""), 7, vertex);
        const auto result = tryImport(text);
        if (std::string_view(vertex) == "[1e400,0,0]" && !result)
            continue;  // no JSON number for some parsers
        ASSERT_TRUE(result) << vertex << ": " << result.error().message();
        expectGoodIsWhole(*result);
        EXPECT_EQ(countsOf(*result), "1 loaded, 0 repaired, 1 skipped") << vertex;
        EXPECT_EQ(textOf(*result, "bad-vertex", "bad"), "skipped: vertex 9 is no usable point")
            << vertex;
        EXPECT_EQ(result->value.city.vertices.size(), 8U) << vertex;
        EXPECT_EQ(result->value.city.frame.origin, glm::dvec3(85000.0, 446000.0, 0.0)) << vertex;
    }
}

TEST(CityJsonFaults, VertexWithMoreThanThreeNumbersKeepsTheFirstThree) {
    json city = boxCity();
    city["vertices"][0].push_back(5);
    EXPECT_EQ(countsOf(import(city)), "1 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonFaults, UnusableVertexThatNobodyUsesDoesNoHarm) {
    json city = boxCity();
    city["vertices"].push_back({1e300, 0, 0});
    const auto result = import(city);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    EXPECT_LT(result.value.summary.bounds.max.x, 90000.0);
}

TEST(CityJsonFaults, BoundariesNestedWronglyCostTheirGeometry) {
    for (const char* boundaries : {"[[0,1,2]]", "[[[[[[0,1,2]]]]]]", "5", "\"x\"", "{}",
                                   "[[[0,1,2],[3]]]", "[null]", "[[[[0,1,[2]]]]]"}) {
        json geometry = solid("2");
        geometry["boundaries"] = json::parse(boundaries);
        const auto result = import(withBadObject(object("Building", json::array({geometry}))));
        expectGoodIsWhole(result);
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped") << boundaries;
        EXPECT_EQ(textOf(result, "bad-geometry", "bad"),
                  "a geometry was left out (1 in all): boundaries are nested in another way than "
                  "those of a Solid")
            << boundaries;
    }
    json geometry = solid("2");
    geometry.erase("boundaries");
    EXPECT_EQ(
        textOf(import(withBadObject(object("Building", json::array({geometry})))), "bad-geometry"),
        "a geometry was left out (1 in all): a Solid has no boundaries");
}

TEST(CityJsonFaults, EmptyPartsOfGeometriesAreReported) {
    json geometry = {{"type", "CompositeSolid"}, {"lod", "1"}};
    geometry["boundaries"] = json::array({json::array({boxShell()}), json::array()});
    auto result = import(withBadObject(object("Building", json::array({geometry}))));
    EXPECT_EQ(countsOf(result), "1 loaded, 1 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "empty-geometry", "bad"),
              "a solid, shell or geometry has no surface (1 in all)");
    result = import(withBadObject(object("Building", json::array({surfaces("1", json::array())}))));
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped");
    EXPECT_NE(findDiagnostic(result, "empty-geometry", "bad"), nullptr);
}

TEST(CityJsonFaults, GeometryThatIsNoneIsReported) {
    for (const char* geometry : {"5", "{}", "\"none\""}) {
        const auto result =
            import(withBadObject({{"type", "Building"}, {"geometry", json::parse(geometry)}}));
        expectGoodIsWhole(result);
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped") << geometry;
        EXPECT_NE(findDiagnostic(result, "bad-geometry", "bad"), nullptr) << geometry;
    }
    for (const char* entry :
         {"[5]", "[null]", "[{}]", "[{\"type\":\"Sphere\",\"lod\":\"1\"}]", "[{\"type\":5}]"}) {
        const auto result =
            import(withBadObject({{"type", "Building"}, {"geometry", json::parse(entry)}}));
        expectGoodIsWhole(result);
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped") << entry;
        EXPECT_NE(findDiagnostic(result, "unknown-geometry-type", "bad"), nullptr) << entry;
    }
}

TEST(CityJsonFaults, SurfacesWithoutAreaAreLeftOut) {
    const json faces = json::parse("[[[0,1,2,3]],[[0,1]],[[0,0,0]],[[]],[],[[0,1,8]]]");
    json city = withBadObject(object("Building", json::array({surfaces("1", faces)})));
    city["vertices"].push_back({20000, 0, 0});  // on a line with 0 and 1
    const auto result = import(city);
    expectGoodIsWhole(result);
    EXPECT_EQ(result.value.city.triangles.size(), 14U);
    EXPECT_EQ(textOf(result, "degenerate-surface", "bad").substr(0, 33),
              "left out: 5 surfaces without area");
    EXPECT_EQ(countsOf(result), "1 loaded, 1 repaired, 0 skipped");
}

TEST(CityJsonFaults, ObjectsThatAreNoneAreSkipped) {
    for (const char* bad : {"5", "null", "[]", "\"Building\"", "true"}) {
        const auto result = import(withBadObject(json::parse(bad)));
        expectGoodIsWhole(result);
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped") << bad;
        EXPECT_EQ(textOf(result, "not-an-object", "bad"), "skipped: it is no JSON object") << bad;
    }
}

TEST(CityJsonFaults, SecondObjectOfAnIdIsSkipped) {
    std::string text = boxCity().dump();
    const std::string objects = "\"CityObjects\":{";
    text.insert(text.find(objects) + objects.size(), "\"a\":{\"type\":\"Road\"},");
    const auto result = tryImport(text);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(countsOf(*result), "1 loaded, 0 repaired, 1 skipped");
    EXPECT_EQ(result->value.city.objects[0].typeName, "Road");
    EXPECT_EQ(textOf(*result, "duplicate-id", "a"), "skipped: an earlier object has the same id");
}

TEST(CityJsonFaults, StrictImportRefusesWhatWouldBeMended) {
    ImportOptions strict;
    strict.strict = true;
    EXPECT_TRUE(tryImport(boxCity().dump(), strict));
    json shell = boxShell();
    shell[2][0][1] = 8;
    const Error error = importError(
        withBadObject(object("Building", json::array({solid("2", shell)}))).dump(), strict);
    EXPECT_EQ(error.code, ErrorCode::Refused);
    EXPECT_EQ(
        error.what,
        "is not sound, which --strict asks for: object bad: left out: 1 surface with a vertex "
        "that does not exist (index 8, counted from 0, of 8)");
    EXPECT_EQ(error.remedy, "Mend the file, or import it without --strict.");
}

TEST(CityJsonFaults, AreReportedInTheOrderOfTheFile) {
    json city = boxCity();
    json objects;
    std::string text = "{";
    for (const char* id : {"z", "b", "y", "a"})
        text += (text.size() > 1 ? "," : "") + ("\"" + std::string(id) + "\":5");
    std::string whole = city.dump();
    const std::string before = city["CityObjects"].dump();
    whole.replace(whole.find(before), before.size(), text + "}");
    const auto result = tryImport(whole);
    ASSERT_TRUE(result) << result.error().message();
    std::string order;
    for (const Diagnostic& diagnostic : result->diagnostics)
        order += diagnostic.object;
    EXPECT_EQ(order, "zbya");
}

TEST(CityJsonFaults, PolygonWhoseEdgesAllCrossDoesNotCostTheMemory) {
    // A star of n points has about n²/2 crossings: 800 points make 320,000.
    json city = emptyCity();
    json ring = json::array();
    constexpr int kPoints = 801;
    for (int i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * kPi * i / kPoints;
        city["vertices"].push_back(
            {std::lround(1e6 * std::cos(angle)), std::lround(1e6 * std::sin(angle)), 0});
        ring.push_back(i * 400 % kPoints);
    }
    json faces = json::array({json::array({ring})});
    city["CityObjects"]["star"] = object("LandUse", json::array({surfaces("1", faces)}));
    const auto result = tryImport(city.dump());
    if (result) {
        EXPECT_EQ(countsOf(*result), "0 loaded, 0 repaired, 1 skipped");
        EXPECT_NE(findDiagnostic(*result, "degenerate-surface", "star"), nullptr);
    } else {
        EXPECT_EQ(result.error().code, ErrorCode::ResourceLimit);
    }
}

}  // namespace reflet
