// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry types, semantics and objects, on shapes whose area and volume are known.
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

TEST(CityJsonGeometry, SolidEnclosesItsVolume) {
    const auto result = import(boxCity());
    const CityModel& city = result.value.city;
    EXPECT_EQ(city.triangles.size(), 12U);
    EXPECT_EQ(city.surfaces.size(), 6U);
    EXPECT_EQ(city.vertices.size(), 8U);
    EXPECT_NEAR(enclosedVolume(city), 480.0, 1e-4);
    EXPECT_NEAR(areaOf(city), 2.0 * (80.0 + 60.0 + 48.0), 1e-4);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    EXPECT_TRUE(result.diagnostics.empty());
    EXPECT_TRUE(city.uv.empty());
}

TEST(CityJsonGeometry, AllShellsOfASolidAreTaken) {
    json city = boxCity();
    for (const json& vertex : boxVertices(2000, 2000, 2000, 1000, 1000, 1000))
        city["vertices"].push_back(vertex);
    json inner = boxShell(8);
    for (json& surface : inner)
        std::reverse(surface[0].begin(), surface[0].end());
    city["CityObjects"]["a"]["geometry"][0]["boundaries"].push_back(inner);
    const auto result = import(city);
    EXPECT_EQ(result.value.city.triangles.size(), 24U);
    EXPECT_NEAR(enclosedVolume(result.value.city), 479.0, 1e-4);
}

TEST(CityJsonGeometry, OfEverySurfaceTypeIsTaken) {
    const json shell = boxShell();
    const std::array<std::pair<const char*, json>, 5> types{{
        {"MultiSurface", shell},
        {"CompositeSurface", shell},
        {"Solid", json::array({shell})},
        {"MultiSolid", json::array({json::array({shell})})},
        {"CompositeSolid", json::array({json::array({shell})})},
    }};
    for (const auto& [type, boundaries] : types) {
        json city = boxCity();
        city["CityObjects"]["a"]["geometry"][0] = {
            {"type", type}, {"lod", "2"}, {"boundaries", boundaries}};
        const auto result = import(city);
        EXPECT_EQ(result.value.city.triangles.size(), 12U) << type;
        EXPECT_EQ(result.value.summary.surfaces, 6U) << type;
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped") << type;
    }
}

TEST(CityJsonGeometry, SeveralSolidsOfOneGeometryAreAllTaken) {
    json city = boxCity();
    for (const json& vertex : boxVertices(20000))
        city["vertices"].push_back(vertex);
    city["CityObjects"]["a"]["geometry"][0] = {
        {"type", "MultiSolid"},
        {"lod", "2"},
        {"boundaries", json::array({json::array({boxShell()}), json::array({boxShell(8)})})}};
    EXPECT_NEAR(enclosedVolume(import(city).value.city), 960.0, 1e-4);
}

TEST(CityJsonGeometry, PointsAndLinesShowNothing) {
    json city = boxCity();
    city["CityObjects"]["p"] = object(
        "CityFurniture",
        json::array(
            {{{"type", "MultiPoint"}, {"lod", "1"}, {"boundaries", {0, 1, 2}}},
             {{"type", "MultiLineString"}, {"lod", "0"}, {"boundaries", {{0, 1}, {2, 3}}}}}));
    const auto result = import(city);
    EXPECT_EQ(result.value.city.objects.size(), 2U);
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "no-surfaces", "p"), "has points or lines only, which show nothing");
}

TEST(CityJsonGeometry, HolesStayOpen) {
    json city = emptyCity();
    city["vertices"] = {{0, 0, 0},       {10000, 0, 0},   {10000, 0, 10000}, {0, 0, 10000},
                        {2000, 0, 2000}, {2000, 0, 4000}, {4000, 0, 4000},   {4000, 0, 2000}};
    city["CityObjects"]["wall"] =
        object("Building", json::array({surfaces("2", {{{0, 1, 2, 3}, {4, 5, 6, 7}}})}));
    const auto result = import(city);
    EXPECT_NEAR(areaOf(result.value.city), 96.0, 1e-4);
    EXPECT_EQ(result.value.summary.triangles, 8U);
    EXPECT_EQ(result.value.city.triangles.size(), 8U);
}

TEST(CityJsonGeometry, NonPlanarSurfaceKeepsItsPointsAndIsReported) {
    json city = emptyCity();
    city["vertices"] = {{0, 0, 0}, {10000, 0, 0}, {10000, 10000, 400}, {0, 10000, 0}};
    city["CityObjects"]["a"] = object("Road", json::array({surfaces("1", {{{0, 1, 2, 3}}})}));
    const auto result = import(city);
    EXPECT_EQ(result.value.city.triangles.size(), 2U);
    EXPECT_FLOAT_EQ(static_cast<float>(result.value.city.bounds().max.z), 0.4F);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    EXPECT_NE(textOf(result, "not-planar").find("1 surfaces are more than 1 cm out of plane"),
              std::string::npos);
}

TEST(CityJsonGeometry, BowTieIsMendedAndReported) {
    json city = emptyCity();
    city["vertices"] = {{0, 0, 0}, {10000, 0, 0}, {0, 10000, 0}, {10000, 10000, 0}};
    city["CityObjects"]["a"] = object("LandUse", json::array({surfaces("1", {{{0, 1, 2, 3}}})}));
    const auto result = import(city);
    EXPECT_NEAR(areaOf(result.value.city), 50.0, 1e-4);
    EXPECT_EQ(result.value.city.vertices.size(), 5U);
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "polygon-repaired", "a"),
              "mended: 1 surface with repeated points, crossing edges or odd rings");
}

TEST(CityJsonGeometry, SemanticsFollowTheNestingOfEachType) {
    const json types = {{{"type", "GroundSurface"}},
                        {{"type", "RoofSurface"}},
                        {{"type", "WallSurface"}},
                        {{"type", "+Solar"}},
                        {{"type", "Window"}}};
    const json row = {0, 1, 2, 3, 4, nullptr};
    const std::array<std::pair<const char*, json>, 3> nested{{
        {"MultiSurface", row},
        {"Solid", json::array({row})},
        {"MultiSolid", json::array({json::array({row})})},
    }};
    const std::array expected{SurfaceType::Ground, SurfaceType::Roof,   SurfaceType::Wall,
                              SurfaceType::Other,  SurfaceType::Window, SurfaceType::Unknown};
    for (const auto& [type, values] : nested) {
        json boundaries = boxShell();
        for (int depth =
                 type == std::string("MultiSurface") ? 0 : (type == std::string("Solid") ? 1 : 2);
             depth > 0; --depth)
            boundaries = json::array({boundaries});
        json city = boxCity();
        city["CityObjects"]["a"]["geometry"][0] = {
            {"type", type},
            {"lod", "2"},
            {"boundaries", boundaries},
            {"semantics", {{"surfaces", types}, {"values", values}}}};
        const auto result = import(city);
        ASSERT_EQ(result.value.city.surfaces.size(), 6U) << type;
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(result.value.city.surfaces[i].type, expected[i]) << type << " surface " << i;
        EXPECT_TRUE(result.diagnostics.empty()) << type;
    }
}

TEST(CityJsonGeometry, NullMayStandForTheSemanticsOfAWholeShell) {
    json city = boxCity();
    for (const json& vertex : boxVertices(20000))
        city["vertices"].push_back(vertex);
    json& geometry = city["CityObjects"]["a"]["geometry"][0];
    geometry["boundaries"].push_back(boxShell(8));
    geometry["semantics"] = {
        {"surfaces", {{{"type", "RoofSurface"}}}},
        {"values", {nullptr, {nullptr, 0, nullptr, nullptr, nullptr, nullptr}}}};
    const auto result = import(city);
    ASSERT_EQ(result.value.city.surfaces.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ(result.value.city.surfaces[i].type,
                  i == 7 ? SurfaceType::Roof : SurfaceType::Unknown);
    EXPECT_TRUE(result.diagnostics.empty());

    geometry["semantics"]["values"] = nullptr;
    EXPECT_TRUE(import(city).diagnostics.empty());
}

TEST(CityJsonGeometry, SemanticsThatDoNotFitAreReportedAndTheRestIsKept) {
    json city = boxCity();
    json& geometry = city["CityObjects"]["a"]["geometry"][0];
    geometry["semantics"] = {{"surfaces", {{{"type", "RoofSurface"}}}},
                             {"values", {{0, 0, 5, -1}}}};
    auto result = import(city);
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
    EXPECT_EQ(result.value.city.surfaces[1].type, SurfaceType::Roof);
    EXPECT_EQ(result.value.city.surfaces[2].type, SurfaceType::Unknown);
    EXPECT_EQ(
        textOf(result, "semantics-malformed", "a"),
        "the semantics of a geometry (1 in all) do not fit its surfaces: not as many as there "
        "are surfaces");
    EXPECT_EQ(textOf(result, "semantics-index-out-of-range", "a"),
              "loaded without semantics: 2 surfaces (index 5, counted from 0, of 1)");
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");

    geometry["semantics"]["values"] = {0, 0, 0, 0, 0, 0};  // nested as for a MultiSurface
    result = import(city);
    EXPECT_EQ(result.value.city.surfaces[1].type, SurfaceType::Unknown);
    EXPECT_NE(findDiagnostic(result, "semantics-malformed", "a"), nullptr);
}

TEST(CityJsonGeometry, ObjectsOfAllTypesAreKnown) {
    const std::array<std::pair<const char*, CityObjectType>, 14> types{{
        {"Building", CityObjectType::Building},
        {"BuildingPart", CityObjectType::BuildingPart},
        {"BuildingInstallation", CityObjectType::BuildingInstallation},
        {"Bridge", CityObjectType::Bridge},
        {"Tunnel", CityObjectType::Tunnel},
        {"Road", CityObjectType::Road},
        {"Railway", CityObjectType::Railway},
        {"TransportSquare", CityObjectType::TransportSquare},
        {"TINRelief", CityObjectType::TinRelief},
        {"WaterBody", CityObjectType::WaterBody},
        {"PlantCover", CityObjectType::PlantCover},
        {"SolitaryVegetationObject", CityObjectType::SolitaryVegetation},
        {"CityFurniture", CityObjectType::CityFurniture},
        {"GenericCityObject", CityObjectType::Generic},
    }};
    json city = boxCity();
    city["CityObjects"] = json::object();
    for (const auto& [name, type] : types)
        city["CityObjects"][name] = object(name, json::array({solid("1")}));
    city["CityObjects"]["+Noise"] = object("+NoiseBuilding", json::array({solid("1")}));
    city["CityObjects"]["odd"] = object("Bulding", json::array({solid("1")}));
    city["CityObjects"]["bare"] = {{"geometry", json::array({solid("1")})}};
    const auto result = import(city);
    EXPECT_EQ(result.value.city.objects.size(), types.size() + 3);
    for (const CityObject& object : result.value.city.objects) {
        for (const auto& [name, type] : types) {
            if (object.id == name) {
                EXPECT_EQ(object.type, type) << name;
            }
        }
    }
    EXPECT_EQ(result.value.summary.byType.at("+NoiseBuilding"), 1U);
    EXPECT_EQ(
        textOf(result, "unknown-type", "odd"),
        "has the type Bulding, which the format does not define; it was loaded as an object of "
        "unknown kind");
    EXPECT_EQ(findDiagnostic(result, "unknown-type", "+Noise"), nullptr);
    EXPECT_NE(findDiagnostic(result, "no-type", "bare"), nullptr);
    EXPECT_EQ(countsOf(result), "16 loaded, 1 repaired, 0 skipped");
}

TEST(CityJsonGeometry, ParentsAreLinkedAndMayHaveNoGeometry) {
    json city = boxCity();
    json part = city["CityObjects"]["a"];
    part["type"] = "BuildingPart";
    part["parents"] = {"house"};
    city["CityObjects"] = {{"a", part}, {"house", {{"type", "Building"}, {"children", {"a"}}}}};
    city["CityObjects"]["group"] = {{"type", "CityObjectGroup"}, {"children", {"house"}}};
    city["CityObjects"]["lonely"] = {{"type", "Building"}, {"geometry", nullptr}};
    const auto result = import(city);
    const auto& objects = result.value.city.objects;
    ASSERT_EQ(objects.size(), 4U);
    ASSERT_TRUE(objects[0].parent);
    EXPECT_EQ(objects[*objects[0].parent].id, "house");
    EXPECT_FALSE(objects[*objects[0].parent].parent);
    EXPECT_EQ(countsOf(result), "4 loaded, 0 repaired, 0 skipped");
    ASSERT_EQ(result.diagnostics.size(), 1U);
    EXPECT_EQ(result.diagnostics[0].object, "lonely");
    EXPECT_EQ(result.diagnostics[0].code, "no-geometry");
    EXPECT_EQ(result.diagnostics[0].severity, Severity::Info);
}

TEST(CityJsonGeometry, ParentsInACircleAndMissingOnesDoNoHarm) {
    json city = boxCity();
    json box = city["CityObjects"]["a"];
    city["CityObjects"] = json::object();
    for (const auto& [id, parent] :
         {std::pair("a", "b"), std::pair("b", "c"), std::pair("c", "a"), std::pair("d", "d"),
          std::pair("e", "nobody"), std::pair("f", "a")}) {
        city["CityObjects"][id] = box;
        city["CityObjects"][id]["type"] = "BuildingPart";
        city["CityObjects"][id]["parents"] = {parent};
    }
    const auto result = import(city);
    const auto& objects = result.value.city.objects;
    ASSERT_EQ(objects.size(), 6U);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        std::size_t steps = 0;
        for (auto at = objects[i].parent; at; at = objects[*at].parent)
            ASSERT_LT(++steps, objects.size());
    }
    EXPECT_EQ(countsOf(result), "4 loaded, 2 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "parent-missing", "e"),
              "names a parent that is not in the file: nobody");
}

TEST(CityJsonGeometry, OfChosenTypesComesWithAllThatIsBelowIt) {
    json city = boxCity();
    const json box = city["CityObjects"]["a"];
    city["CityObjects"]["house"] = {{"type", "Building"}, {"children", {"part"}}};
    city["CityObjects"]["part"] = box;
    city["CityObjects"]["part"]["type"] = "BuildingPart";
    city["CityObjects"]["part"]["parents"] = {"house"};
    city["CityObjects"]["road"] = box;
    city["CityObjects"]["road"]["type"] = "Road";
    ImportOptions options;
    options.types = {"Building"};
    auto result = import(city, options);
    EXPECT_EQ(result.value.summary.byType,
              (std::map<std::string, std::size_t>{{"Building", 2}, {"BuildingPart", 1}}));
    EXPECT_EQ(result.value.city.triangles.size(), 24U);
    EXPECT_EQ(textOf(result, "filtered-by-type"), "1 objects of other types were left out");
    options.types = {"Road", "BuildingPart"};
    result = import(city, options);
    EXPECT_EQ(result.value.summary.byType,
              (std::map<std::string, std::size_t>{{"BuildingPart", 1}, {"Road", 1}}));
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonGeometry, InABoxComesWithItsParents) {
    json city = boxCity();
    for (const json& vertex : boxVertices(100000))
        city["vertices"].push_back(vertex);
    city["CityObjects"]["a"]["type"] = "BuildingPart";
    city["CityObjects"]["a"]["parents"] = {"house"};
    city["CityObjects"]["house"] = {{"type", "Building"}, {"children", {"a"}}};
    city["CityObjects"]["far"] = object("Building", json::array({solid("2", boxShell(8))}));
    ImportOptions options;
    options.bbox = {85005.0, 446007.9, 85090.0, 446100.0};
    const auto result = import(city, options);
    ASSERT_EQ(result.value.city.objects.size(), 2U);
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
    EXPECT_EQ(textOf(result, "filtered-by-box"), "1 objects outside the box were left out");
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
    EXPECT_EQ(result.value.summary.vertices, 8U);
    EXPECT_NEAR(result.value.summary.bounds.max.x, 85010.0, 1e-9);
}

}  // namespace reflet
