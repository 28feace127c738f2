// SPDX-License-Identifier: GPL-3.0-or-later
// Where glTF cities and their instances stand; places on the Earth are checked with GeographicLib.
#include "importers/gltf/GltfGeoreference.h"
#include "importers/tiles/TilesImporter.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/files/TileText.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr double kLongitude = 9.99, kLatitude = 53.55, kHeight = 60.0;

const Diagnostic* said(const std::vector<Diagnostic>& list, std::string_view code) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Diagnostic& d) { return d.code == code; });
    return found == list.end() ? nullptr : &*found;
}

/// UTM and height of a point by its metres east, north and up of the place above.
glm::dvec3 utmOf(double east, double north, double up) {
    const GeographicLib::LocalCartesian earth(kLatitude, kLongitude, kHeight);
    double lat = 0, lon = 0, h = 0, e = 0, n = 0;
    earth.Reverse(east, north, up, lat, lon, h);
    int zone = 0;
    bool northern = false;
    GeographicLib::UTMUPS::Forward(lat, lon, zone, northern, e, n);
    return {e, n, h};
}

class GltfPlace : public testing::Test {
protected:
    void read(const fs::path& path, const ImportOptions& options = {}) {
        auto imported = importGltfCity(path, options, {});
        ASSERT_TRUE(imported) << imported.error().message();
        city = std::move(imported->value.city);
        diagnostics = std::move(imported->diagnostics);
    }
    [[nodiscard]] bool hasVertexAt(const glm::dvec3& place, double tolerance = 3e-3) const {
        return std::any_of(city.vertices.begin(), city.vertices.end(), [&](const glm::vec3& v) {
            return glm::length(glm::dvec3(v) + city.frame.origin - place) < tolerance;
        });
    }
    /// The box of boxAt(): 4 m east, 3 m north and 2 m up of (100, 200).
    void expectBoxOnEarth() const {
        EXPECT_EQ(city.frame.crs, "EPSG:32632");
        ASSERT_EQ(city.vertices.size(), 8U);
        for (const double east : {100.0, 104.0}) {
            for (const double north : {200.0, 203.0}) {
                for (const double up : {0.0, 2.0})
                    EXPECT_TRUE(hasVertexAt(utmOf(east, north, up))) << east << " " << north;
            }
        }
        EXPECT_GT(volume(city), 23.9) << "not turned inside out";
    }

    TemporaryFolder folder;
    CityModel city;
    std::vector<Diagnostic> diagnostics;
};

json placeOnEarth() {
    return {{"longitude", kLongitude}, {"latitude", kLatitude}, {"height", kHeight}};
}

TEST_F(GltfPlace, ANodeIsPlacedByItsLongitudeAndLatitude) {
    GltfText gltf;
    // -x faces east, y up, z north: the box of boxAt() as seen from there.
    gltf.box({-104, 0, 200}, {-100, 2, 203});
    gltf.root["nodes"][0]["extensions"]["EXT_georeference"] = placeOnEarth();
    gltf.root["extensionsUsed"] = {"EXT_georeference"};
    read(folder.write("node.glb", glb(gltf)));
    expectBoxOnEarth();
    // A mesh beside it without a place would lie at the centre of the Earth.
    gltf.box({0, 0, 0}, {1, 1, 1});
    gltf.root["nodes"].push_back({{"mesh", 1}});
    gltf.root["scenes"][0]["nodes"] = {0, 1};
    read(folder.write("two.glb", glb(gltf)));
    expectBoxOnEarth();
    EXPECT_NE(said(diagnostics, "node-elsewhere"), nullptr);
}

TEST_F(GltfPlace, APlaceThatIsNoneIsTold) {
    GltfText gltf = boxAt(0, 0);
    gltf.root["nodes"][0]["extensions"]["EXT_georeference"] = {{"longitude", 7}, {"latitude", 91}};
    ImportOptions local;
    local.crs = "local";
    auto imported = importGltfCity(folder.write("none.glb", glb(gltf)), local, {});
    ASSERT_TRUE(imported) << imported.error().message();
    EXPECT_NE(said(imported->diagnostics, "georeference-unusable"), nullptr);
}

TEST_F(GltfPlace, AFileInAReferenceSystemHasItsCoordinatesWithZUp) {
    for (const json& format : {json{{"EXT_geospatial_crs_wkid",
                                     {{"authority", "EPSG"}, {"wkid", 25832}, {"vcsWkid", 7837}}}},
                               json{{"EXT_geospatial_crs_wkt2", {{"wkt2", "EPSG:25832+7837"}}}}}) {
        GltfText gltf;
        gltf.box({0, 0, 0}, {4, 3, 2});
        gltf.root["nodes"][0]["translation"] = {565000, 5934000, 12};
        gltf.root["extensions"]["EXT_geospatial_crs"] = {{"format", "wkid"},
                                                         {"extensions", format}};
        read(folder.write("crs.glb", glb(gltf)));
        EXPECT_EQ(city.frame.crs, "EPSG:25832");
        EXPECT_EQ(city.frame.vertical, "EPSG:7837");
        EXPECT_TRUE(hasVertexAt({565004, 5934003, 14}));
    }
    GltfText other = boxAt(0, 0);
    other.root["extensions"]["EXT_geospatial_crs"] = {{"format", "x"}, {"extensions", {{"X", 1}}}};
    read(folder.write("other.glb", glb(other)));
    ASSERT_NE(said(diagnostics, "crs-format"), nullptr);
    EXPECT_FALSE(said(diagnostics, "crs-format")->remedy.empty());
}

TEST_F(GltfPlace, AWorldFileMovesTurnsAndScales) {
    const fs::path path = folder.write("house.glb", glb(boxAt(100, 200)));
    folder.write("house.prj", "PROJCS[\"none\"]");
    folder.write("house.wld3", "100,200,0 565000,5934000,12\n");
    ImportOptions options;
    options.crs = "EPSG:25832";
    fs::remove(folder / "house.prj");
    read(path, options);
    EXPECT_TRUE(hasVertexAt({565000, 5934000, 12}));
    EXPECT_TRUE(hasVertexAt({565004, 5934003, 14}));
    // A quarter turn counter-clockwise and twice the size: 4 m east become 8 m north.
    folder.write("house.wld3", "100,200,0, 565000,5934000,12\n104,200,0 565000,5934008,12");
    read(path, options);
    EXPECT_TRUE(hasVertexAt({565000, 5934008, 12}));
    EXPECT_TRUE(hasVertexAt({564994, 5934000, 16}));
    for (const char* bad : {"", "1,2,3 4,5", "1,2,3 4,5,x", "0,0,0 1,1,1 0,0,5 2,2,2"})
        EXPECT_FALSE(gltf::readWorldFile(bad)) << bad;
    folder.write("house.wld3", "nothing");
    read(path, options);
    EXPECT_NE(said(diagnostics, "georeference-unusable"), nullptr);
}

std::string kml(const std::string& model) {
    return "<?xml version='1.0'?><kml xmlns='http://www.opengis.net/kml/2.2'><Placemark><Model>" +
           model + "</Model></Placemark></kml>";
}

TEST_F(GltfPlace, AKmlModelPlacesIt) {
    const std::string location =
        "<Location><longitude>9.99</longitude><latitude>53.55</latitude>"
        "<altitude>60</altitude></Location>";
    const fs::path path = folder.write("house.glb", glb(boxAt(100, 200)));
    folder.write("house.kml", kml(location));
    read(path);
    expectBoxOnEarth();
    // Heading east, what was north of it is east: (e, n) becomes (n, -e).
    folder.write("house.kml", kml(location + "<Orientation><heading>90</heading></Orientation>"));
    read(path);
    EXPECT_TRUE(hasVertexAt(utmOf(200, -100, 0)));
    EXPECT_TRUE(hasVertexAt(utmOf(203, -104, 2)));
    for (const std::string& bad :
         {std::string("<"), kml(""), kml("<Location><longitude>200</longitude></Location>"),
          kml(location + "<Orientation><tilt>20</tilt></Orientation>")})
        EXPECT_FALSE(gltf::readKmlModel(bad)) << bad;
}

TEST_F(GltfPlace, WhatTheFileSaysCountsBeforeWhatLiesBesideIt) {
    GltfText gltf = boxAt(1, 2);
    gltf.root["asset"]["extras"]["georeference"] = {{"crs", "EPSG:25832"},
                                                    {"origin", {565000, 5934000, 12}}};
    const fs::path path = folder.write("house.glb", glb(gltf));
    folder.write("house.wld3", "0,0,0 1,1,1");
    folder.write("house.kml", kml("<Location><longitude>1</longitude></Location>"));
    read(path);
    EXPECT_TRUE(hasVertexAt({565001, 5934002, 12}));
}

/// Hills of 80 x 80 m with a texture, as one skin; `closed` with a bottom.
GltfText skin(bool textured, bool closed) {
    constexpr int kCells = 8;
    GltfText gltf;
    std::vector<float> points, uv;
    std::vector<std::uint16_t> indices;
    for (int layer = 0; layer < (closed ? 2 : 1); ++layer) {
        const auto first = std::uint16_t(points.size() / 3);
        for (int j = 0; j <= kCells; ++j) {
            for (int i = 0; i <= kCells; ++i) {
                const float height = layer == 0 ? float((i * j) % 3) : -5.0F;
                points.insert(points.end(), {10.0F * float(i), height, -10.0F * float(j)});
                uv.insert(uv.end(), {float(i) / kCells, float(j) / kCells});
            }
        }
        for (int j = 0; j < kCells; ++j) {
            for (int i = 0; i < kCells; ++i) {
                const auto a = std::uint16_t(first + j * (kCells + 1) + i);
                const auto up = std::uint16_t(a + kCells + 1);
                const std::vector<std::uint16_t> quad =
                    layer == 0 ? std::vector<std::uint16_t>{a,
                                                            std::uint16_t(a + 1),
                                                            up,
                                                            std::uint16_t(a + 1),
                                                            std::uint16_t(up + 1),
                                                            up}
                               : std::vector<std::uint16_t>{a,
                                                            up,
                                                            std::uint16_t(a + 1),
                                                            std::uint16_t(a + 1),
                                                            up,
                                                            std::uint16_t(up + 1)};
                indices.insert(indices.end(), quad.begin(), quad.end());
            }
        }
    }
    json& primitive = gltf.mesh(points, indices);
    primitive["attributes"]["TEXCOORD_0"] = gltf.accessor(uv, 5126, "VEC2", 2);
    primitive["material"] = 0;
    gltf.root["materials"] = {{{"name", "photo"}}};
    if (textured) {
        gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
        gltf.root["textures"] = {{{"source", 0}}};
        gltf.root["images"] = {{{"uri", "photo.jpg"}}};
    }
    return gltf;
}

TEST_F(GltfPlace, ASkinOverAllThatThereIsStandsForTheGround) {
    ImportOptions local;
    local.crs = "local";
    const auto typeOf = [&](const GltfText& gltf) {
        read(folder.write("skin.glb", glb(gltf)), local);
        return city.objects.at(0).type;
    };
    EXPECT_EQ(typeOf(skin(true, false)), CityObjectType::TinRelief);
    EXPECT_EQ(typeOf(skin(true, true)), CityObjectType::Building) << "a body with a bottom";
    EXPECT_EQ(typeOf(skin(false, false)), CityObjectType::Building) << "no photo";
    GltfText named = skin(true, false);
    named.root["nodes"][0]["name"] = "Building 7";
    EXPECT_EQ(typeOf(named), CityObjectType::Building) << "it says what it is";
    GltfText placed = skin(true, false);
    for (const char* key : {"translation", "rotation"})
        placed.root["nodes"][0].erase(key);
    // Facing up on the Earth: -x east, y up, z north.
    placed.root["nodes"][0]["rotation"] = {0, 1, 0, 0};
    placed.root["nodes"][0]["extensions"]["EXT_georeference"] = placeOnEarth();
    read(folder.write("earth.glb", glb(placed)));
    EXPECT_EQ(city.objects.at(0).type, CityObjectType::TinRelief);
}

/// A box of 1 m, three of it by the extension, each placed by its translation, rotation and scale.
GltfText threeBoxes() {
    GltfText gltf;
    gltf.box({0, 0, -1}, {1, 1, 0});
    const float h = std::sqrt(0.5F);
    const std::size_t t =
        gltf.accessor(std::vector<float>{0, 0, 0, 10, 0, 0, 20, 5, 0}, 5126, "VEC3", 3);
    const std::size_t r =
        gltf.accessor(std::vector<float>{0, 0, 0, 1, 0, h, 0, h, 0, 0, 0, 1}, 5126, "VEC4", 4);
    const std::size_t s =
        gltf.accessor(std::vector<float>{1, 1, 1, 1, 1, 1, 2, 2, 2}, 5126, "VEC3", 3);
    gltf.root["nodes"][0]["translation"] = {100, 0, 0};
    gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {
        {"attributes", {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}}}};
    gltf.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return gltf;
}

TEST_F(GltfPlace, InstancesOfANodeStandWhereTheirAttributesSay) {
    ImportOptions local;
    local.crs = "local";
    GltfText gltf = threeBoxes();
    read(folder.write("trees.glb", glb(gltf)), local);
    EXPECT_EQ(city.objects.size(), 3U);
    EXPECT_EQ(city.objects[2].id, "trees/thing (3)");
    EXPECT_NEAR(volume(city), 1.0 + 1.0 + 8.0, 1e-4);
    EXPECT_TRUE(hasVertexAt({101, 1, 1})) << "as it is";
    EXPECT_TRUE(hasVertexAt({109, 1, 1})) << "by a quarter about the axis that points up";
    EXPECT_TRUE(hasVertexAt({122, 2, 7})) << "twice as large, 5 m up";
    // A node beside it that stands once stays one object.
    gltf.box({0, 0, -1}, {1, 1, 0});
    gltf.root["nodes"].push_back({{"mesh", 1}, {"name", "house"}});
    gltf.root["scenes"][0]["nodes"] = {0, 1};
    read(folder.write("more.glb", glb(gltf)), local);
    EXPECT_EQ(city.objects.size(), 4U);
}

TEST_F(GltfPlace, InstancesInATileStandInIt) {
    json root = tile("trees.glb");
    root["transform"] = translation(1000, 2000, 0);
    folder.write("trees.glb", glb(threeBoxes()));
    ImportOptions local;
    local.crs = "local";
    auto imported = importTiles(folder.write("tileset.json", tileset(root)), local, {});
    ASSERT_TRUE(imported) << imported.error().message();
    city = std::move(imported->value.city);
    EXPECT_EQ(city.objects.size(), 3U);
    EXPECT_TRUE(hasVertexAt({1122, 2002, 7}));
}

TEST_F(GltfPlace, InstancesThatCannotBeReadAreToldAndLeftOut) {
    ImportOptions local;
    local.crs = "local";
    GltfText gltf = threeBoxes();
    gltf.box({0, 0, -1}, {1, 1, 0});
    gltf.root["nodes"].push_back({{"mesh", 1}, {"name", "house"}});
    gltf.root["scenes"][0]["nodes"] = {0, 1};
    json& attributes = gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const std::size_t two = gltf.accessor(std::vector<float>{0, 0, 0, 1, 1, 1}, 5126, "VEC3", 3);
    for (const json& translation : {json(two), json(999), json("x")}) {
        attributes["TRANSLATION"] = translation;
        read(folder.write("bad.glb", glb(gltf)), local);
        const bool readable = translation == "x";  // no accessor at all: the others tell
        EXPECT_EQ(city.objects.size(), readable ? 4U : 1U) << translation;
        EXPECT_EQ(said(diagnostics, "instances-unreadable") == nullptr, readable) << translation;
    }
    GltfText many = threeBoxes();
    many.root["accessors"][2]["count"] = 4'000'000'000U;
    many.box({0, 0, -1}, {1, 1, 0});
    many.root["nodes"].push_back({{"mesh", 1}});
    many.root["scenes"][0]["nodes"] = {0, 1};
    read(folder.write("many.glb", glb(many)), local);
    EXPECT_EQ(city.objects.size(), 1U);
}

}  // namespace
}  // namespace reflet
