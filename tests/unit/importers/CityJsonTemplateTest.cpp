// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry templates: a shape once, placed many times.
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

namespace {

constexpr std::array<double, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

json instance(int index, int anchor, const std::array<double, 16>& matrix = kIdentity) {
    return {{"type", "GeometryInstance"},
            {"template", index},
            {"boundaries", json::array({anchor})},
            {"transformationMatrix", matrix}};
}

/// A box of 1 m by 2 m by 3 m as the template, and one anchor at (85005, 446006, 7).
json cityWithBoxTemplate() {
    json city = emptyCity();
    json corners = json::array();
    for (const json& v : boxVertices(0, 0, 0, 1, 2, 3))
        corners.push_back(v);
    city["geometry-templates"] = {{"templates", json::array({solid("3")})},
                                  {"vertices-templates", corners}};
    city["vertices"] = {{5000, 6000, 7000}};
    city["CityObjects"]["tree"] = object("SolitaryVegetationObject", json::array({instance(0, 0)}));
    return city;
}

glm::dvec3 absolute(const CityModel& city, const glm::dvec3& p) {
    return p + city.frame.origin;
}

}  // namespace

TEST(CityJsonTemplate, IsPlacedAtItsAnchor) {
    const auto result = import(cityWithBoxTemplate());
    const CityModel& city = result.value.city;
    EXPECT_EQ(city.triangles.size(), 12U);
    EXPECT_NEAR(enclosedVolume(city), 6.0, 1e-4);
    for (const CitySurface& surface : city.surfaces)
        EXPECT_TRUE(surface.instance);
    const Box bounds = city.bounds();
    EXPECT_NEAR(glm::distance(absolute(city, bounds.min), glm::dvec3(85005.0, 446006.0, 7.0)), 0.0,
                1e-3);
    EXPECT_NEAR(glm::distance(absolute(city, bounds.max), glm::dvec3(85006.0, 446008.0, 10.0)), 0.0,
                1e-3);
    EXPECT_EQ(city.objects[0].lod, "3");
    EXPECT_EQ(result.value.summary.instances, 1U);
    EXPECT_EQ(result.value.summary.instanceTriangles, 12U);
    EXPECT_EQ(result.value.summary.triangles, 0U);
    EXPECT_EQ(result.value.summary.surfaces, 0U);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonTemplate, MatrixIsRowMajorAndComesBeforeTheAnchor) {
    json city = cityWithBoxTemplate();
    // A quarter turn to the left about z, twice as large, then 10 m east and 1 m up.
    const std::array<double, 16> matrix{0, -2, 0, 10, 2, 0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 1};
    city["CityObjects"]["tree"]["geometry"][0] = instance(0, 0, matrix);
    const auto result = import(city);
    const CityModel& model = result.value.city;
    EXPECT_NEAR(enclosedVolume(model), 48.0, 1e-3);
    const Box bounds = model.bounds();
    EXPECT_NEAR(glm::distance(absolute(model, bounds.min), glm::dvec3(85011.0, 446006.0, 8.0)), 0.0,
                1e-3);
    EXPECT_NEAR(glm::distance(absolute(model, bounds.max), glm::dvec3(85015.0, 446008.0, 14.0)),
                0.0, 1e-3);
}

TEST(CityJsonTemplate, MirroredOneStillFacesOutwards) {
    json city = cityWithBoxTemplate();
    const std::array<double, 16> matrix{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    city["CityObjects"]["tree"]["geometry"][0] = instance(0, 0, matrix);
    EXPECT_NEAR(enclosedVolume(import(city).value.city), 6.0, 1e-4);
}

TEST(CityJsonTemplate, HomogeneousCoordinateIsDividedOut) {
    json city = cityWithBoxTemplate();
    const std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2};
    city["CityObjects"]["tree"]["geometry"][0] = instance(0, 0, matrix);
    EXPECT_NEAR(enclosedVolume(import(city).value.city), 6.0 / 8.0, 1e-4);
}

TEST(CityJsonTemplate, MayStandBesideGeometryOfItsOwnObject) {
    json city = cityWithBoxTemplate();
    for (const json& vertex : boxVertices(50000))
        city["vertices"].push_back(vertex);
    city["CityObjects"]["tree"]["geometry"].push_back(solid("3", boxShell(1)));
    const auto result = import(city);
    EXPECT_EQ(result.value.city.triangles.size(), 24U);
    EXPECT_FALSE(result.value.city.surfaces.front().instance);
    EXPECT_TRUE(result.value.city.surfaces.back().instance);
    EXPECT_EQ(result.value.summary.triangles, 12U);
    EXPECT_EQ(result.value.summary.instanceTriangles, 12U);
}

TEST(CityJsonTemplate, ThatCannotBePlacedCostsItsObjectOnly) {
    json city = cityWithBoxTemplate();
    const auto with = [&](const char* id, const char* key, const json& value) {
        json geometry = instance(0, 0);
        geometry[key] = value;
        city["CityObjects"][id] = object("CityFurniture", json::array({geometry}));
    };
    with("a", "template", 1);
    with("b", "template", -1);
    with("c", "template", nullptr);
    with("d", "boundaries", {5});
    with("e", "boundaries", json::array());
    with("f", "boundaries", {0, 0});
    with("g", "transformationMatrix", {1, 2, 3});
    with("h", "transformationMatrix", std::array<double, 16>{});
    with("i", "transformationMatrix", nullptr);
    std::array<double, 16> huge = kIdentity;
    huge[3] = 1e300;
    with("j", "transformationMatrix", huge);
    const auto result = import(city);
    EXPECT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 10 skipped");
    EXPECT_EQ(textOf(result, "template-out-of-range", "a"),
              "an instance was left out (1 in all): template 1, counted from 0, of 1");
    EXPECT_EQ(textOf(result, "template-out-of-range", "c"),
              "an instance was left out (1 in all): no template is named");
    EXPECT_EQ(textOf(result, "bad-instance", "d"),
              "an instance was left out (1 in all): the anchor is not one existing vertex");
    EXPECT_EQ(textOf(result, "bad-instance", "g"),
              "an instance was left out (1 in all): the matrix is not 16 numbers");
    EXPECT_EQ(
        textOf(result, "bad-instance", "h"),
        "an instance was left out (1 in all): the matrix takes the template out of the world");
    for (const char* id : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"})
        EXPECT_NE(findDiagnostic(result, "no-usable-geometry", id), nullptr) << id;
}

TEST(CityJsonTemplate, WithFaultsPassesThemOnToItsInstances) {
    json city = cityWithBoxTemplate();
    city["geometry-templates"]["templates"][0]["boundaries"][0][0][0][0] = 99;
    const auto result = import(city);
    EXPECT_EQ(result.value.city.triangles.size(), 10U);
    EXPECT_EQ(
        textOf(result, "index-out-of-range", "tree"),
        "left out: 1 surface with a vertex that does not exist (index 99, counted from 0, of 8)");
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
}

TEST(CityJsonTemplate, ThatIsAnInstanceItselfIsNotPlaced) {
    json city = cityWithBoxTemplate();
    city["geometry-templates"]["templates"][0] = instance(0, 0);
    const auto result = import(city);
    EXPECT_EQ(countsOf(result), "0 loaded, 0 repaired, 1 skipped");
}

TEST(CityJsonTemplate, TexturesAndSemanticsComeAlong) {
    json city = cityWithBoxTemplate();
    city["appearance"] = {{"textures", {{{"image", "leaf.png"}}}},
                          {"vertices-texture", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    json& shape = city["geometry-templates"]["templates"][0];
    shape["semantics"] = {{"surfaces", {{{"type", "RoofSurface"}}}},
                          {"values", {{nullptr, 0, nullptr, nullptr, nullptr, nullptr}}}};
    json rings = json::array();
    for (int i = 0; i < 6; ++i)
        rings.push_back(json::array({i == 1 ? json{0, 0, 1, 2, 3} : json::array({nullptr})}));
    shape["texture"] = {{"t", {{"values", json::array({rings})}}}};
    const auto result = import(city);
    EXPECT_EQ(result.value.city.surfaces[1].type, SurfaceType::Roof);
    EXPECT_EQ(result.value.city.surfaces[1].texture, 0U);
    EXPECT_EQ(result.value.city.surfaces[0].texture, kNone);
    EXPECT_EQ(result.value.city.uv.size(), 12U);
    EXPECT_EQ(result.value.summary.texturesReferenced, 1U);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonTemplate, BombIsRefusedBeforeItGoesOff) {
    // 100 kB of template times 2,000 instances of 40 bytes would be 20 million triangles.
    json city = cityWithBoxTemplate();
    json soup = json::array();
    for (int i = 0; i < 10'000; ++i)
        soup.push_back({{0, 1, 2}});
    city["geometry-templates"]["templates"][0] = surfaces("3", soup);
    json geometries = json::array();
    for (int i = 0; i < 2'000; ++i)
        geometries.push_back(instance(0, 0));
    city["CityObjects"]["tree"]["geometry"] = geometries;
    const Error error = importError(city.dump());
    EXPECT_EQ(error.code, ErrorCode::ResourceLimit);
    EXPECT_NE(error.what.find("places templates with 20000000 triangles in all"),
              std::string::npos);
    EXPECT_EQ(error.remedy, "Import a part with --bbox or --types, or use simpler templates.");
}

}  // namespace reflet
