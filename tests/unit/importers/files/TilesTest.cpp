// SPDX-License-Identifier: GPL-3.0-or-later
// 3D Tiles and glTF cities; places are checked with GeographicLib.
#include "importers/FormatRegistry.h"
#include "importers/tiles/TileContent.h"
#include "importers/tiles/TilesImporter.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/files/TileText.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <set>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

const Diagnostic* remark(const std::vector<Diagnostic>& list, std::string_view code) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Diagnostic& d) { return d.code == code; });
    return found == list.end() ? nullptr : &*found;
}

ImportOptions local() {
    ImportOptions options;
    options.crs = "local";
    return options;
}

class Tiles : public testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& bytes) {
        return m_folder.write(name, bytes);
    }
    Imported<CityImport> read(const fs::path& path, const ImportOptions& options = local()) {
        const auto format = cityFormatOf(path);
        EXPECT_TRUE(format) << format.error().message();
        EXPECT_EQ((*format)->name, "3D Tiles");
        auto city = (*format)->read(path, options, {});
        EXPECT_TRUE(city) << city.error().message();
        return city ? *std::move(city) : Imported<CityImport>();
    }
    const TemporaryFolder& folder() const { return m_folder; }

private:
    TemporaryFolder m_folder;
};

TEST_F(Tiles, TheFinestTilesAreShownWhereTilesReplaceAndAllWhereTheyAdd) {
    write("coarse.glb", glb(boxAt(0, 0)));
    write("a.glb", glb(boxAt(0, 0)));
    write("fine/b.glb", glb(boxAt(10, 0)));
    const json children = {tile("a.glb"), tile("fine/b.glb")};
    const auto replaced = read(write("tileset.json", tileset(tile("coarse.glb", children))));
    EXPECT_EQ(replaced.value.city.objects.size(), 2U);
    EXPECT_EQ(openEdges(replaced.value.city), 0U);
    EXPECT_NEAR(volume(replaced.value.city), 48.0, 1e-3) << "turned, not mirrored";
    EXPECT_EQ(replaced.value.city.bounds().size(), glm::dvec3(14.0, 3.0, 2.0));
    EXPECT_EQ(replaced.value.city.objects[1].id, "fine/b.glb/thing");
    const auto added = read(write("tileset.json", tileset(tile("coarse.glb", children, "ADD"))));
    EXPECT_EQ(added.value.city.objects.size(), 3U);
}

TEST_F(Tiles, TransformsAndOtherTilesetsMultiplyOnTheWayDown) {
    write("sub/a.glb", glb(boxAt(0, 0)));
    json inner = tile("a.glb");
    inner["transform"] = translation(1, 2, 3);
    write("sub/inner.json", tileset(inner));
    json outer = tile("sub/inner.json?v=1");
    // A quarter turn counter-clockwise about z: (x, y) becomes (-y, x).
    outer["transform"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 100, 0, 0, 1};
    const auto city = read(write("tileset.json", tileset(outer)));
    const Box box = city.value.city.bounds();
    EXPECT_NEAR(box.min.x, 100.0 - 5.0, 1e-4);
    EXPECT_NEAR(box.max.x, 100.0 - 2.0, 1e-4);
    EXPECT_NEAR(box.min.y, 1.0, 1e-4);
    EXPECT_NEAR(box.max.y, 5.0, 1e-4);
    EXPECT_NEAR(box.max.z, 5.0, 1e-4);
}

TEST_F(Tiles, BatchesAreObjectsWithTheirNames) {
    GltfText gltf = boxAt(0, 0);
    json& primitive = gltf.root["meshes"][0]["primitives"][0];
    primitive["attributes"]["_BATCHID"] =
        gltf.accessor(std::vector<float>{0, 0, 0, 0, 1, 1, 1, 1}, 5126, "SCALAR", 1);
    write("a.b3dm", b3dm(glb(gltf), {{"BATCH_LENGTH", 2}, {"RTC_CENTER", {1000, 0, 50}}},
                         {{"height", {1, 2}}, {"id", {"north", "south"}}}));
    const auto city = read(write("tileset.json", tileset(tile("a.b3dm"))));
    std::set<std::string> ids;
    for (const CityObject& object : city.value.city.objects)
        ids.insert(object.id);
    EXPECT_EQ(ids, (std::set<std::string>{"north", "south"}));
    const glm::dvec3 origin = city.value.city.frame.origin;
    EXPECT_NEAR(origin.x + city.value.city.bounds().min.x, 1000.0, 1e-3);
    EXPECT_NEAR(city.value.city.bounds().max.z, 52.0, 1e-3);
}

TEST_F(Tiles, InstancesStandWhereTheirTableSays) {
    const std::string places = floats({0, 0, 0, 100, 0, 0}) + floats({1, 2});
    const json table = {{"INSTANCES_LENGTH", 2},
                        {"POSITION", {{"byteOffset", 0}}},
                        {"SCALE", {{"byteOffset", 24}}}};
    const std::string model = glb(boxAt(0, 0));
    write("trees.i3dm", i3dm(model, table, places));
    write("both.cmpt", cmpt({i3dm(model, table, places), cmpt({b3dm(glb(boxAt(50, 0)))})}));
    const auto trees = read(write("tileset.json", tileset(tile("trees.i3dm"))));
    EXPECT_EQ(trees.value.city.objects.size(), 2U);
    EXPECT_NEAR(volume(trees.value.city), 24.0 + 8.0 * 24.0, 1e-2);
    EXPECT_NEAR(trees.value.city.bounds().max.x, 108.0, 1e-4);
    const auto both = read(write("tileset.json", tileset(tile("both.cmpt"))));
    EXPECT_EQ(both.value.city.objects.size(), 3U);
    // Turned: right is north, up stays; the box's 4 m then run north, its 3 m west.
    const json turned = {{"INSTANCES_LENGTH", 1},
                         {"POSITION", {{"byteOffset", 0}}},
                         {"NORMAL_UP", {{"byteOffset", 12}}},
                         {"NORMAL_RIGHT", {{"byteOffset", 24}}}};
    write("one.i3dm", i3dm(model, turned, floats({0, 0, 0, -1, 0, 0, 0, 1, 0})));
    const auto one = read(write("tileset.json", tileset(tile("one.i3dm"))));
    EXPECT_NEAR(one.value.city.bounds().max.y, 4.0, 1e-4);
    EXPECT_NEAR(one.value.city.bounds().min.x, -3.0, 1e-4);
    EXPECT_NEAR(volume(one.value.city), 24.0, 1e-3);
}

TEST_F(Tiles, GeocentricTilesComeToLieWhereGeographicLibSays) {
    const double longitude = 4.3571, latitude = 52.0116, height = 43.0;
    const GeographicLib::LocalCartesian earth(latitude, longitude, height);
    json root = tile("a.glb");
    json& matrix = root["transform"] = json::array();
    double x0 = 0, y0 = 0, z0 = 0;
    earth.Reverse(latitude, longitude, height, x0, y0, z0);
    std::vector<double> rotation(9);
    GeographicLib::Geocentric::WGS84().Forward(latitude, longitude, height, x0, y0, z0, rotation);
    for (std::size_t column = 0; column < 3; ++column) {
        for (std::size_t row = 0; row < 3; ++row)
            matrix.push_back(rotation[3 * row + column]);
        matrix.push_back(0);
    }
    for (const double value : {x0, y0, z0, 1.0})
        matrix.push_back(value);
    write("a.glb", glb(boxAt(100, 200)));
    const auto city = read(write("tileset.json", tileset(root)), {});
    const CityModel& model = city.value.city;
    EXPECT_EQ(model.frame.crs, "EPSG:32631");
    EXPECT_NE(remark(city.diagnostics, "ellipsoidal-heights"), nullptr);
    ASSERT_EQ(model.vertices.size(), 8U);
    // Each corner of the box, by another way: local plane, geodetic, UTM.
    std::size_t found = 0;
    for (const double east : {100.0, 104.0}) {
        for (const double north : {200.0, 203.0}) {
            for (const double up : {0.0, 2.0}) {
                double lat = 0, lon = 0, h = 0, e = 0, n = 0;
                int zone = 0;
                bool northern = false;
                earth.Reverse(east, north, up, lat, lon, h);
                GeographicLib::UTMUPS::Forward(lat, lon, zone, northern, e, n);
                const glm::dvec3 expected(e, n, h);
                found += std::size_t(std::count_if(
                    model.vertices.begin(), model.vertices.end(), [&](const glm::vec3& v) {
                        return glm::length(glm::dvec3(v) + model.frame.origin - expected) < 2e-3;
                    }));
            }
        }
    }
    EXPECT_EQ(found, 8U);
}

TEST_F(Tiles, FaultsCostTheirTileAndAreTold) {
    write("good.glb", glb(boxAt(0, 0)));
    const std::string sound = b3dm(glb(boxAt(0, 0)));
    write("cut.b3dm", sound.substr(0, sound.size() / 2));
    write("points.pnts", "pnts" + word(1) + word(28) + std::string(16, '\0'));
    write("odd.vctr", "vctr1234");
    write("self.json", tileset(tile("self.json")));
    write("broken.json", "{\"root\": ");
    const json children = {tile("good.glb"),     tile("cut.b3dm"),
                           tile("points.pnts"),  tile("odd.vctr"),
                           tile("self.json"),    tile("broken.json"),
                           tile("gone.glb"),     tile("../secret.glb"),
                           tile("/etc/passwd"),  tile("https://x.example/a.glb"),
                           tile("tileset.json"), json(7)};
    const auto city = read(write("tileset.json", tileset(tile("", children))));
    EXPECT_EQ(city.value.city.objects.size(), 1U);
    for (const char* code : {"tile-unreadable", "tileset-cycle", "tile-missing", "tile-outside",
                             "tile-remote", "tileset-unreadable"}) {
        const Diagnostic* said = remark(city.diagnostics, code);
        ASSERT_NE(said, nullptr) << code;
        EXPECT_FALSE(said->text.empty());
        EXPECT_FALSE(said->remedy.empty()) << code;
    }
    EXPECT_EQ(remark(city.diagnostics, "tile-outside")->text.substr(0, 2), "2 ");
    EXPECT_EQ(remark(city.diagnostics, "tileset-cycle")->text.substr(0, 2), "2 ");
}

TEST_F(Tiles, WhereFinerTilesAreMissingTheCoarseOneStands) {
    write("coarse.glb", glb(boxAt(0, 0)));
    const auto city = read(write("tileset.json", tileset(tile("coarse.glb", {tile("gone.glb")}))));
    EXPECT_EQ(city.value.city.objects.size(), 1U);
    EXPECT_NE(remark(city.diagnostics, "tile-missing"), nullptr);
}

TEST_F(Tiles, TilesetsWithoutTilesAreErrors) {
    for (const json& root : {tile("https://x.example/a.glb"), tile("gone.b3dm"), tile("")}) {
        const auto none = importTiles(write("tileset.json", tileset(root)), local(), {});
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().code, ErrorCode::Unreadable);
        EXPECT_FALSE(none.error().remedy.empty());
        EXPECT_EQ(none.error().subject, (folder() / "tileset.json").string());
    }
    EXPECT_FALSE(importTiles(write("x.json", std::string(100'000, '[')), local(), {}));
    // A thousand tiles below each other.
    json deep = tile("a.glb");
    for (int i = 0; i < 150; ++i)
        deep = tile("", {deep});
    const auto refused = importTiles(write("tileset.json", tileset(deep)), local(), {});
    ASSERT_FALSE(refused);
    EXPECT_FALSE(refused.error().remedy.empty());
}

TEST_F(Tiles, ContentThatIsCutAnywhereIsAnErrorOrWhole) {
    const std::string places = floats({0, 0, 0});
    const json table = {{"INSTANCES_LENGTH", 1}, {"POSITION", {{"byteOffset", 0}}}};
    const std::string model = glb(boxAt(0, 0));
    const tiles::ContentLimits limits;
    for (const std::string& whole :
         {b3dm(model), i3dm(model, table, places), cmpt({b3dm(model), b3dm(model)})}) {
        ASSERT_TRUE(tiles::readTileContent(whole, "/x/a.b3dm", false, limits, {}));
        for (std::size_t size = 0; size < whole.size(); size += 5) {
            const auto cut =
                tiles::readTileContent(whole.substr(0, size), "/x/a.b3dm", false, limits, {});
            ASSERT_FALSE(cut) << size;
            EXPECT_FALSE(cut.error().remedy.empty()) << size;
        }
    }
    // Counts beyond what is there.
    json many = table;
    many["INSTANCES_LENGTH"] = 4'000'000'000U;
    EXPECT_EQ(
        tiles::readTileContent(i3dm(model, many, places), "/x/a", false, limits, {}).error().code,
        ErrorCode::ResourceLimit);
    many["INSTANCES_LENGTH"] = 1000;
    EXPECT_FALSE(tiles::readTileContent(i3dm(model, many, places), "/x/a", false, limits, {}));
    std::string nested = b3dm(model);
    for (int i = 0; i < 20; ++i)
        nested = cmpt({nested});
    EXPECT_FALSE(tiles::readTileContent(nested, "/x/a", false, limits, {}));
}

TEST_F(Tiles, AGltfFileTellsWhereItLies) {
    GltfText gltf = boxAt(1, 2);
    gltf.root["asset"]["extras"]["georeference"] = {
        {"crs", "EPSG:25832"}, {"vertical", "EPSG:7837"}, {"origin", {565000.25, 5934000.5, 12.0}}};
    const fs::path path = write("house.glb", glb(gltf));
    const auto format = cityFormatOf(path);
    ASSERT_TRUE(format);
    EXPECT_EQ((*format)->name, "glTF");
    const auto city = (*format)->read(path, {}, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.frame.crs, "EPSG:25832");
    EXPECT_EQ(city->value.city.frame.vertical, "EPSG:7837");
    const glm::dvec3 low = city->value.city.bounds().min + city->value.city.frame.origin;
    EXPECT_NEAR(low.x, 565001.25, 1e-3);
    EXPECT_NEAR(low.y, 5934002.5, 1e-3);
    EXPECT_NEAR(low.z, 12.0, 1e-3);
    // The same in a file beside it.
    const fs::path plain = write("plain.glb", glb(boxAt(1, 2)));
    write("plain.glb.geo.json", R"({"crs": "EPSG:25832", "origin": [565000.25, 5934000.5, 12]})");
    const auto beside = importGltfCity(plain, {}, {});
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->value.city.vertices, city->value.city.vertices);
    // CESIUM_RTC on the Earth's surface.
    GltfText rtc;
    rtc.box({0, 0, -1}, {1, 1, 0});
    rtc.root["extensions"]["CESIUM_RTC"] = {{"center", {4014743.25, 411334.96875, 4922395.0}}};
    rtc.root["extensionsRequired"] = {"CESIUM_RTC"};
    const auto info = inspectGltfCity(write("rtc.glb", glb(rtc)), {}, {});
    ASSERT_TRUE(info) << info.error().message();
    double lat = 0, lon = 0, h = 0;
    GeographicLib::Geocentric::WGS84().Reverse(4014743.25, 411334.96875, 4922395.0, lat, lon, h);
    EXPECT_NEAR(info->value.bounds.center().x, lon, 2e-5);
    EXPECT_NEAR(info->value.bounds.center().y, lat, 2e-5);
    EXPECT_NEAR(info->value.bounds.center().z, h, 2.0);
    // Units and axes as told.
    ImportOptions feet = local();
    feet.unit = 0.3048;
    feet.upAxis = "z";
    const auto told = importGltfCity(write("feet.glb", glb(boxAt(0, 0))), feet, {});
    ASSERT_TRUE(told);
    EXPECT_NEAR(told->value.city.bounds().size().y, 2.0 * 0.3048, 1e-3);
    EXPECT_NEAR(told->value.city.bounds().size().z, 3.0 * 0.3048, 1e-3);
}

TEST_F(Tiles, ImplicitTilingsAreReadByTheFilesThatAreThere) {
    json root = tile("t/{level}/{x}_{y}.glb");
    root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"}, {"availableLevels", 3}};
    write("t/0/0_0.glb", glb(boxAt(0, 0)));
    write("t/1/1_0.glb", glb(boxAt(10, 0)));
    write("t/2/0_3.glb", glb(boxAt(20, 0)));
    write("t/3/0_0.glb", glb(boxAt(30, 0)));  // beyond the levels
    const fs::path path = write("tileset.json", tileset(root));
    EXPECT_EQ(read(path).value.city.objects.size(), 2U);
    root["refine"] = "ADD";
    write("tileset.json", tileset(root));
    EXPECT_EQ(read(path).value.city.objects.size(), 3U);
    root["implicitTiling"]["availableLevels"] = 30;
    write("tileset.json", tileset(root));
    const auto deep = importTiles(path, local(), {});
    ASSERT_FALSE(deep);
    EXPECT_NE(deep.error().what.find("implicit tiling of 30 levels"), std::string::npos);
}

TEST_F(Tiles, AFolderWithATilesetIsThatTileset) {
    write("a.glb", glb(boxAt(0, 0)));
    write("sub/inner.json", tileset(tile("a.glb")));
    const fs::path path = write("tileset.json", tileset(tile("a.glb")));
    EXPECT_EQ(placeInFolder(path), PlaceInFolder::Tileset);
    EXPECT_EQ(placeInFolder(folder() / "a.glb"), PlaceInFolder::Other);
}

TEST(TilesFiles, SibbeHasItsHousesAndItsPlace) {
    const auto path = sharedData("gltf/sibbe-3dtiles/tileset.json");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto info = inspectTiles(*path, {}, {});
    ASSERT_TRUE(info) << info.error().message();
    EXPECT_EQ(info->value.triangles, 12581U);
    EXPECT_EQ(info->value.objects, 220U);
    // Its region: west, south, east, north in radians, lowest and highest height.
    const double degrees = 180.0 / 3.14159265358979323846;
    EXPECT_GT(info->value.bounds.min.x, 0.10160054765815166 * degrees);
    EXPECT_LT(info->value.bounds.max.x, 0.10259914663702543 * degrees);
    EXPECT_GT(info->value.bounds.min.y, 0.8870283716791313 * degrees);
    EXPECT_LT(info->value.bounds.max.y, 0.8876579354215639 * degrees);
    EXPECT_GT(info->value.bounds.min.z, 115.0);
    EXPECT_LT(info->value.bounds.max.z, 228.6);
    ImportOptions options;
    options.projectCrs = "EPSG:28992";
    const auto city = importTiles(*path, options, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.frame.crs, "EPSG:28992");
    EXPECT_EQ(city->value.city.objects.front().id.substr(0, 14), "NL.IMBAG.Pand.");
}

TEST(TilesFiles, DelfshavenAsGltfLiesInTheNetherlands) {
    const auto path = sharedData("gltf/delfshaven-rd.glb");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    ImportOptions options;
    options.crs = "EPSG:28992";
    const auto info = inspectGltfCity(*path, options, {});
    ASSERT_TRUE(info) << info.error().message();
    EXPECT_EQ(info->value.triangles, 37437U);
    EXPECT_NEAR(info->value.bounds.min.x, 90409.3203, 1e-3);
    EXPECT_NEAR(info->value.bounds.max.y, 436089.9375, 1e-3);
    EXPECT_NEAR(info->value.bounds.max.z, 41.158, 1e-3);
    EXPECT_EQ(info->value.crsHorizontal, "EPSG:28992");
}

}  // namespace
}  // namespace reflet
