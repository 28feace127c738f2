// SPDX-License-Identifier: GPL-3.0-or-later
// Materials, textures and their coordinates.
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityJsonText.h"

#include <filesystem>

namespace reflet {

using namespace test;

namespace {

/// A square wall in the plane y = 0, with an appearance that has one texture and four corners.
json texturedWall() {
    json city = emptyCity();
    city["vertices"] = {{0, 0, 0}, {10000, 0, 0}, {10000, 0, 10000}, {0, 0, 10000}};
    json geometry = surfaces("2", {{{0, 1, 2, 3}}});
    geometry["texture"] = {{"day", {{"values", {{{0, 0, 1, 2, 3}}}}}}};
    city["CityObjects"]["wall"] = object("Building", json::array({geometry}));
    city["appearance"] = {{"textures", {{{"type", "PNG"}, {"image", "wall.png"}}}},
                          {"vertices-texture", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    return city;
}

json& geometryOf(json& city, const char* id = "wall") {
    return city["CityObjects"][id]["geometry"][0];
}

json boxWithMaterials() {
    json city = boxCity();
    city["appearance"]["materials"] = {{{"name", "brick"}}, {{"name", "glass"}}};
    return city;
}

std::vector<std::uint32_t> materialsOf(const CityModel& city) {
    std::vector<std::uint32_t> materials;
    for (const CitySurface& surface : city.surfaces)
        materials.push_back(surface.material);
    return materials;
}

using Indices = std::vector<std::uint32_t>;

}  // namespace

TEST(CityJsonAppearance, ColoursOfMaterialsBecomeLinear) {
    json city = boxCity();
    city["appearance"]["materials"] = {{{"name", "m"},
                                        {"diffuseColor", {1.0, 0.5, 0.0}},
                                        {"emissiveColor", {0.04, 0.0, 1.0}},
                                        {"shininess", 0.25},
                                        {"transparency", 0.5}},
                                       {{"diffuseColor", {2.0, -1.0, 0.5}}, {"shininess", 7}},
                                       {{"diffuseColor", "red"}}};
    const auto result = import(city);
    const auto& materials = result.value.city.materials;
    ASSERT_EQ(materials.size(), 3U);
    EXPECT_EQ(materials[0].name, "m");
    // sRGB 0.5 is 0.2140 linear, 0.04 lies on the linear foot (IEC 61966-2-1).
    EXPECT_FLOAT_EQ(materials[0].diffuse.r, 1.0F);
    EXPECT_NEAR(materials[0].diffuse.g, 0.21404F, 1e-5F);
    EXPECT_FLOAT_EQ(materials[0].diffuse.b, 0.0F);
    EXPECT_NEAR(materials[0].emission.r, 0.04F / 12.92F, 1e-7F);
    EXPECT_FLOAT_EQ(materials[0].emission.b, 1.0F);
    EXPECT_FLOAT_EQ(materials[0].shininess, 0.25F);
    EXPECT_FLOAT_EQ(materials[0].transparency, 0.5F);
    EXPECT_FLOAT_EQ(materials[1].diffuse.r, 1.0F);
    EXPECT_FLOAT_EQ(materials[1].diffuse.g, 0.0F);
    EXPECT_FLOAT_EQ(materials[1].shininess, 1.0F);
    EXPECT_EQ(materials[2].diffuse, CityMaterial{}.diffuse);
}

TEST(CityJsonAppearance, MaterialsAreGivenForAllSurfacesOrForEach) {
    json city = boxWithMaterials();
    geometryOf(city, "a")["material"] = {{"irradiation", {{"value", 1}}}};
    EXPECT_EQ(materialsOf(import(city).value.city), (Indices{1, 1, 1, 1, 1, 1}));
    geometryOf(city, "a")["material"] = {{"irradiation", {{"values", {{0, 0, 1, nullptr, 1, 0}}}}}};
    const auto result = import(city);
    EXPECT_EQ(materialsOf(result.value.city), (Indices{0, 0, 1, kNone, 1, 0}));
    EXPECT_TRUE(result.diagnostics.empty());
}

TEST(CityJsonAppearance, DefaultThemeCountsBeforeTheFirst) {
    json city = boxWithMaterials();
    geometryOf(city, "a")["material"] = {{"a", {{"value", 0}}}, {"b", {{"value", 1}}}};
    EXPECT_EQ(import(city).value.city.surfaces[0].material, 0U);
    city["appearance"]["default-theme-material"] = "b";
    EXPECT_EQ(import(city).value.city.surfaces[0].material, 1U);
    city["appearance"]["default-theme-material"] = "unknown";
    EXPECT_EQ(import(city).value.city.surfaces[0].material, 0U);
}

TEST(CityJsonAppearance, MaterialThatDoesNotExistIsReportedInAnyTheme) {
    json city = boxWithMaterials();
    geometryOf(city, "a")["material"] = {{"a", {{"values", {{0, 7, 1, 1, 1, 1}}}}},
                                         {"b", {{"value", 4294967295U}}}};
    const auto result = import(city);
    EXPECT_EQ(materialsOf(result.value.city), (Indices{0, kNone, 1, 1, 1, 1}));
    EXPECT_EQ(textOf(result, "material-index-out-of-range", "a"),
              "loaded without material: 2 surfaces (theme a: material 7, counted from 0, of 2)");
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
}

TEST(CityJsonAppearance, TextureCoordinatesReachTheCornersOfTheTriangles) {
    const auto result = import(texturedWall());
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.uv.size(), city.triangles.size());
    ASSERT_EQ(city.triangles.size(), 2U);
    EXPECT_EQ(city.surfaces[0].texture, 0U);
    for (std::size_t t = 0; t < city.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = city.vertices[city.triangles[t].vertex[k]];
            // The corner at the left foot has (0, 0), v runs upwards.
            EXPECT_FLOAT_EQ(city.uv[t][k].x,
                            p.x > 5.0F - city.frame.origin.x + 85000.0 ? 1.0F : 0.0F);
            EXPECT_FLOAT_EQ(city.uv[t][k].y, p.z > 5.0F ? 1.0F : 0.0F);
        }
    }
}

TEST(CityJsonAppearance, TrianglesWithoutTextureStillHaveAPlaceAmongTheCoordinates) {
    json city = texturedWall();
    geometryOf(city)["boundaries"].push_back({{3, 2, 1, 0}});
    geometryOf(city)["texture"]["day"]["values"].push_back({{nullptr}});
    const auto result = import(city);
    EXPECT_EQ(result.value.city.uv.size(), 4U);
    EXPECT_EQ(result.value.city.surfaces[1].texture, kNone);
    EXPECT_EQ(result.value.summary.texturesReferenced, 1U);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonAppearance, PointsWhereEdgesCrossGetCoordinatesOfTheirPlace) {
    json city = texturedWall();
    geometryOf(city)["boundaries"] = {{{0, 1, 3, 2}}};  // a bow-tie through the centre
    geometryOf(city)["texture"]["day"]["values"] = {{{0, 0, 1, 3, 2}}};
    const auto result = import(city);
    const CityModel& model = result.value.city;
    ASSERT_EQ(model.uv.size(), 2U);
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p =
                glm::dvec3(model.vertices[model.triangles[t].vertex[k]]) + model.frame.origin;
            EXPECT_NEAR(model.uv[t][k].x, (p.x - 85000.0) / 10.0, 1e-5);
            EXPECT_NEAR(model.uv[t][k].y, p.z / 10.0, 1e-5);
        }
    }
}

TEST(CityJsonAppearance, TextureIndicesBeyondTheListsAreReported) {
    for (const char* ring : {"[1,0,1,2,3]", "[0,0,1,2,4]", "[0,0,1,2,null]",
                             "[0,0,1,2,99999999999]", "[0,0,1,2,-1]"}) {
        json city = texturedWall();
        geometryOf(city)["texture"]["day"]["values"] =
            json::array({json::array({json::parse(ring)})});
        const auto result = import(city);
        EXPECT_EQ(result.value.city.triangles.size(), 2U);
        EXPECT_EQ(result.value.city.surfaces[0].texture, kNone);
        EXPECT_NE(findDiagnostic(result, "texture-index-out-of-range", "wall"), nullptr) << ring;
        EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
    }
    json city = texturedWall();
    geometryOf(city)["texture"]["day"]["values"] = {{{5, 0, 1, 2, 3}}};
    EXPECT_EQ(textOf(import(city), "texture-index-out-of-range", "wall"),
              "loaded without texture: 1 surface (texture 5, counted from 0, of 1)");
}

TEST(CityJsonAppearance, TexturesThatDoNotFitTheirRingsAreReported) {
    for (const char* values :
         {"[[[0,0,1,2]]]", "[[[0]]]", "[[0,0,1,2,3]]", "[[[[0,0,1,2,3]]]]", "5", "{}"}) {
        json city = texturedWall();
        geometryOf(city)["texture"]["day"]["values"] = json::parse(values);
        const auto result = import(city);
        EXPECT_EQ(result.value.city.triangles.size(), 2U);
        EXPECT_EQ(result.value.city.surfaces[0].texture, kNone);
        EXPECT_NE(findDiagnostic(result, "texture-malformed", "wall"), nullptr) << values;
    }
}

TEST(CityJsonAppearance, NamedByAGeometryButAbsentFromTheFileIsSaidOnce) {
    json city = texturedWall();
    city.erase("appearance");
    geometryOf(city)["material"] = {{"m", {{"value", 0}}}};
    const auto result = import(city);
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
    ASSERT_EQ(result.diagnostics.size(), 1U);
    EXPECT_EQ(result.diagnostics[0].code, "no-appearance");
}

TEST(CityJsonAppearance, ImagesAreFoundBesideTheFileAndInAppearances) {
    const TemporaryFolder folder;
    folder.write("city.city.json", "");
    folder.write("wall.png", "x");
    folder.write("textures/roof.jpg", "x");
    folder.write("appearances/door.png", "x");
    json city = texturedWall();
    city["appearance"]["textures"] = {{{"image", "wall.png"}},
                                      {{"image", "textures\\roof.jpg"}, {"wrapMode", "clamp"}},
                                      {{"image", "door.png"}},
                                      {{"image", "WALL.PNG"}},
                                      {{"image", "nowhere.png"}}};
    const auto result = import(city, {}, folder / "city.city.json");
    const auto& textures = result.value.city.textures;
    ASSERT_EQ(textures.size(), 5U);
    EXPECT_EQ(textures[0].path, (folder / "wall.png").string());
    EXPECT_TRUE(textures[0].repeat);
    EXPECT_EQ(textures[1].path, (folder / "textures/roof.jpg").string());
    EXPECT_FALSE(textures[1].repeat);
    EXPECT_EQ(textures[2].path, (folder / "appearances/door.png").string());
    EXPECT_EQ(textures[3].path, (folder / "wall.png").string());
    EXPECT_EQ(textures[4].path, "");
    EXPECT_EQ(textures[4].reference, "nowhere.png");
    EXPECT_EQ(textOf(result, "texture-missing"),
              "1 of 5 texture images is not found beside the file: nowhere.png");
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonAppearance, UnsafeReferencesAreNotFollowedEvenIfTheyExist) {
    const TemporaryFolder folder;
    folder.write("inner/city.city.json", "");
    const auto outside = folder.write("outside.png", "x");
    std::filesystem::create_symlink(outside, folder / "inner/link.png");
    json city = texturedWall();
    city["appearance"]["textures"] = {{{"image", "../outside.png"}},
                                      {{"image", "a/../../outside.png"}},
                                      {{"image", "..\\outside.png"}},
                                      {{"image", outside.string()}},
                                      {{"image", "C:\\outside.png"}},
                                      {{"image", "http://example.org/a.png"}},
                                      {{"image", "file:///etc/passwd"}},
                                      {{"image", "link.png"}},
                                      {{"image", ""}},
                                      {{"type", "PNG"}},
                                      {{"image", std::string("a\0b.png", 7)}}};
    const auto result = import(city, {}, folder / "inner/city.city.json");
    ASSERT_EQ(result.value.city.textures.size(), 11U);
    for (const CityTexture& texture : result.value.city.textures)
        EXPECT_EQ(texture.path, "") << texture.reference;
    EXPECT_EQ(textOf(result, "texture-outside"),
              "3 of 10 texture images are named by a path that leads out of the file's folder: "
              "../outside.png, a/../../outside.png, ..\\outside.png");
    EXPECT_NE(textOf(result, "texture-absolute").find("2 of 10"), std::string::npos);
    EXPECT_EQ(textOf(result, "texture-remote"),
              "2 of 10 texture images are named by a URL, and nothing is fetched from a network: "
              "http://example.org/a.png, file:///etc/passwd");
    EXPECT_NE(findDiagnostic(result, "texture-missing"), nullptr);
    EXPECT_NE(textOf(result, "texture-unnamed").find("2 of 10"), std::string::npos);
}

}  // namespace reflet
