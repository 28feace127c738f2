// SPDX-License-Identifier: GPL-3.0-or-later
// All files of the shared data, as a planner would hand them to the program: what it says of the
// sound ones is what was counted independently (expected.json); what is damaged gives an error with
// a remedy, or a city with an account of what was left out. A file that no test knows fails.
#include "tests/support/Program.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>

namespace reflet {
namespace {

using nlohmann::json;

test::ProgramResult cli(const std::string& arguments) {
    return test::runProgram(std::string("'") + REFLET_CLI + "' " + arguments);
}

json infoOf(const std::string& path, const std::string& options = {}) {
    const auto file = test::sharedData(path);
    const auto result = cli("info '" + file->string() + "' --json " + options);
    EXPECT_EQ(result.exitCode, 0) << path << result.errors;
    json info = json::parse(result.output, nullptr, false);
    EXPECT_FALSE(info.is_discarded()) << path;
    return info;
}

/// A box as lists of numbers; axes that `expected` does not have are not compared.
void expectBox(const json& info, const json& expected, double tolerance, const std::string& path) {
    for (std::size_t axis = 0; axis < expected[0].size(); ++axis) {
        EXPECT_NEAR(info["bounds"]["min"][axis].get<double>(), expected[0][axis].get<double>(),
                    tolerance)
            << path << " axis " << axis;
        EXPECT_NEAR(info["bounds"]["max"][axis].get<double>(), expected[1][axis].get<double>(),
                    tolerance)
            << path << " axis " << axis;
    }
}

constexpr double kMillimetre = 1e-3;  // of the expected boxes' last digit
constexpr double kDegrees = 1e-6;     // a decimetre

void checkCityJson(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["format"], expected["fmt"]) << path;
    EXPECT_EQ(info["version"], expected["version"]) << path;
    EXPECT_EQ(info["objects"], expected["objs"]) << path;
    EXPECT_EQ(info["byType"], expected["types"]) << path;
    EXPECT_EQ(info["surfaces"], expected.value("surf", 0)) << path;
    EXPECT_EQ(info["triangles"], expected.value("tri", 0)) << path;
    EXPECT_EQ(info["vertices"], expected["verts"]) << path;
    if (expected["bbox"].is_null())
        EXPECT_TRUE(info["bounds"].is_null() || info["instances"]["count"] > 0) << path;
    else
        expectBox(info, expected["bbox"], kMillimetre, path);
}

void checkCityGml(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["format"], "CityGML") << path;
    EXPECT_EQ(info["version"], expected["namespaces"][0]) << path;
    EXPECT_EQ(info["byType"], expected["features"]) << path;
    EXPECT_EQ(info["surfaces"], expected["polygons"]) << path;
    EXPECT_EQ(info["triangles"], expected["tri"]) << path;
    EXPECT_EQ(info["textures"]["referenced"], expected.value("texture_files_referenced", 0));
    EXPECT_EQ(info["textures"]["resolved"], expected.value("texture_files_present", 0));
    json box = expected["bbox_file_axis_order"];
    const bool degrees = box[0][0] < 90.0;
    if (degrees) {  // latitude first
        for (json& corner : box)
            std::swap(corner[0], corner[1]);
        for (json& corner : box)
            corner.erase(2);
    }
    expectBox(info, box, degrees ? kDegrees : kMillimetre, path);
}

/// In metres, y up in the file: east is x, north is -z.
void checkGltfCity(const std::string& path, const json& expected) {
    const json info = infoOf(path, "--crs EPSG:28992");
    EXPECT_EQ(info["triangles"], expected["tri_scene"]) << path;
    const json& low = expected["bbox_scene"][0];
    const json& high = expected["bbox_scene"][1];
    const auto number = [](const json& value) { return value.get<double>(); };
    expectBox(info,
              {{number(low[0]), -number(high[2]), number(low[1])},
               {number(high[0]), -number(low[2]), number(high[1])}},
              kMillimetre, path);
}

/// The box of a tileset in degrees lies in the region that it declares.
void checkTiles(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["format"], "3D Tiles");
    EXPECT_EQ(info["version"], expected["asset"]["version"]);
    EXPECT_EQ(info["triangles"], 12'581) << "those of its one tile";
    EXPECT_EQ(info["crs"]["rule"], "format") << "tiles lie around the Earth, no file says so";
    EXPECT_TRUE(info["crs"]["written"].is_null());
    const json& region = expected["boundingVolume"]["region"];
    constexpr double kRadian = 180.0 / 3.14159265358979323846;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_GT(info["bounds"]["min"][axis], region[axis].get<double>() * kRadian - kDegrees);
        EXPECT_LT(info["bounds"]["max"][axis], region[axis + 2].get<double>() * kRadian + kDegrees);
    }
    EXPECT_GT(info["bounds"]["min"][2], region[4].get<double>() - 1.0);
    EXPECT_LT(info["bounds"]["max"][2], region[5].get<double>() + 1.0);
}

void checkVehicle(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["format"], "glTF") << path;
    EXPECT_EQ(info["fileMaterials"], expected["materials"]) << path;
    EXPECT_EQ(info["triangles"], expected["tri_scene"]) << path;
    expectBox(info, expected["bbox_scene"], 1e-4, path);
}

void checkObj(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["objects"], expected["objects"]) << path;
    EXPECT_EQ(info["triangles"], expected["tri"]) << path;
    EXPECT_EQ(info["vertices"], expected["v"]) << path;
    expectBox(info, expected["bbox"], kMillimetre, path);
}

void checkRaster(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["crs"]["horizontal"], "EPSG:" + std::to_string(expected["epsg"].get<int>()))
        << path;
    const json& nw = expected["upper_left"];
    const json& se = expected["lower_right"];
    json box = {{nw[0], se[1]}, {se[0], nw[1]}};
    if (expected["bands"].size() == 1) {
        box[0].push_back(expected["bands"][0]["min"]);
        box[1].push_back(expected["bands"][0]["max"]);
    }
    expectBox(info, box, kMillimetre, path);
}

void checkFootprints(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["objects"], expected["features"]) << path;
    const bool degrees = expected["crs"].is_null();
    EXPECT_EQ(info["crs"]["horizontal"], degrees ? "EPSG:4326" : "EPSG:28992") << path;
    expectBox(info, expected["bbox"], degrees ? kDegrees : kMillimetre, path);
}

void checkOsm(const std::string& path, const json& expected) {
    const json info = infoOf(path);
    EXPECT_EQ(info["byType"]["Building"],
              expected["building_ways"].get<int>() + expected["building_relations"].get<int>())
        << path;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_GE(info["bounds"]["min"][axis], expected["bbox"][axis]) << path;
        EXPECT_LE(info["bounds"]["max"][axis], expected["bbox"][axis + 2]) << path;
    }
}

using Check = std::function<void(const std::string&, const json&)>;

/// The first that a path begins with. Null: no city (skies belong to the light).
const std::vector<std::pair<std::string, Check>> kChecks{
    {"cityjson/", checkCityJson},
    {"cityjsonseq/", checkCityJson},
    {"citygml/", checkCityGml},
    {"gltf/delfshaven-rd.glb", checkGltfCity},
    {"gltf/sibbe-3dtiles/tileset.json", checkTiles},
    {"gltf/sibbe-3dtiles/content/", nullptr},  // a part of the tileset
    {"gltf/", checkVehicle},
    {"obj/", checkObj},
    {"geotiff/", checkRaster},
    {"geojson/", checkFootprints},
    {"osm/", checkOsm},
    {"hdr/", nullptr},
};

/// Textures, buffers and licences are counted with the files that refer to them.
bool belongsToAnother(const std::filesystem::path& path) {
    static const std::set<std::string> suffixes{".jpg", ".png", ".bin", ".txt", ".md"};
    return suffixes.contains(path.extension().string());
}

TEST(SharedData, EverySoundFileHasTheCountsAndTheBoxThatWereEstablishedIndependently) {
    const auto list = test::sharedData("expected.json");
    if (!list)
        GTEST_SKIP() << test::kNoSharedData;
    std::ifstream stream(*list);
    const json all = json::parse(stream);
    std::size_t checked = 0;
    for (const auto& [path, entry] : all.items()) {
        if (path.starts_with("bad/") || belongsToAnother(path))
            continue;
        const auto check = std::find_if(kChecks.begin(), kChecks.end(),
                                        [&](const auto& c) { return path.starts_with(c.first); });
        ASSERT_NE(check, kChecks.end()) << path << " has no check";
        if (!check->second)
            continue;
        check->second(path, entry["verified"]);
        ++checked;
    }
    EXPECT_GE(checked, 33U);
}

/// What `import` ends with for each damaged file: 0 a city with an account of what was left out,
/// 3 unreadable, 4 readable but refused (nothing of it can be shown, or nothing says where it
/// lies).
const std::map<std::string, int> kBad{
    {"citygml/malformed-poslist.gml", 4},
    {"citygml/qie-i101-1.gml", 0},
    {"citygml/qie-i103-1.gml", 0},
    {"citygml/qie-i104-1.gml", 0},
    {"citygml/qie-i201-1.gml", 0},
    {"citygml/qie-i206-1.gml", 0},
    {"citygml/qie-i301-1.gml", 0},
    {"citygml/qie-i302-1.gml", 0},
    {"citygml/qie-i303-1.gml", 0},
    {"citygml/qie-i305-1.gml", 0},
    {"citygml/qie-i307-1.gml", 0},
    {"citygml/qie-t203-1.gml", 0},
    {"citygml/qie-v004.gml", 0},
    {"cityjson/completely-empty.city.json", 3},
    {"cityjson/empty-primitive.city.json", 0},
    {"cityjson/invalid-json-syntax.city.json", 3},
    {"cityjson/material-index-overflow-1.city.json", 0},
    {"cityjson/missing-type.city.json", 3},
    {"cityjson/overlapping-buildingparts.city.json", 0},
    {"cityjson/overlapping-solids.city.json", 0},
    {"cityjson/several-lods-invalid.city.json", 0},
    {"cityjson/texture-index-overflow-1.city.json", 0},
    {"cityjson/truncated-end.city.json", 3},
    {"cityjson/two-buildings-city-objects-key.city.json", 3},
    {"cityjson/vertex-index-out-of-range-1.city.json", 0},
    {"cityjsonseq/duplicate-feature-ids.city.jsonl", 0},
    {"cityjsonseq/unclosed-bracket.city.jsonl", 3},
    {"geojson/bad-featurelist.geojson", 3},
    {"geojson/bad-json.geojson", 3},
    {"geojson/bad-object-type.geojson", 3},
    {"geojson/badcoord.geojson", 3},
    {"geojson/different-first-last.geojson", 0},
    {"geojson/featurecollection-obj.geojson", 3},
    {"geojson/no-geometry-type.geojson", 4},
    {"geojson/point-string.geojson", 3},
    {"geojson/short-linearring.geojson", 0},
    {"geotiff/corrupt1.tif", 3},
    {"geotiff/fuzz-divide-by-zero-1.tif", 3},
    {"geotiff/fuzz-oom-1.tif", 4},
    {"geotiff/strip-offset-past-eof.tif", 4},
    {"geotiff/truncated-tile.tif", 4},
    {"gltf/accessor-data/out-of-range-elements-float.gltf", 3},
    {"gltf/assimp-index-out-of-range/index-out-of-range.gltf", 0},
    {"gltf/assimp-recursive-nodes.gltf", 3},
    {"gltf/assimp-scene-wrong-type.gltf", 3},
    {"gltf/buffer-not-found.gltf", 3},
    {"gltf/buffer-zero-bytelength.gltf", 3},
    {"gltf/glb-chunk-too-big.glb", 3},
    {"gltf/glb-invalid-json-chunk.glb", 3},
    {"gltf/glb-invalid-magic.glb", 3},
    {"gltf/glb-invalid-version.glb", 3},
    {"gltf/glb-length-mismatch.glb", 3},
    {"gltf/glb-no-header.glb", 3},
    {"gltf/glb-only-header.glb", 3},
    {"gltf/glb-truncated-chunk-data.glb", 3},
    {"gltf/image-not-found.gltf", 3},
    {"gltf/json-invalid-syntax.gltf", 3},
    {"gltf/node-node-loop.gltf", 3},
    {"gltf/node-unresolved-mesh.gltf", 3},
    {"image/bomb-65500x65500.jpg", 4},
    {"image/crash-resolution.hdr", 3},
    {"image/damaged-1.exr", 3},
    {"image/damaged-2.exr", 3},
    {"image/damaged-3.exr", 3},
    {"image/empty.jpg", 3},
    {"image/xc1n0g08.png", 3},
    {"image/xdtn0g01.png", 3},
    {"image/xhdn0g08.png", 3},
    {"json/n-number-nan.json", 3},
    {"json/n-object-trailing-comma.json", 3},
    {"json/n-string-unescaped-newline.json", 3},
    {"json/n-structure-100000-opening-arrays.json", 3},
    {"json/n-structure-lone-invalid-utf-8.json", 3},
    {"json/n-structure-object-with-trailing-garbage.json", 3},
    {"obj/completely-empty.obj", 3},
    {"obj/duplicate-vertices.obj", 0},
    {"obj/index-zero.obj", 0},
    {"obj/malformed-index-out-of-range.obj", 0},
    {"osm/broken-multipolygon.osm", 4},
    {"osm/invalid-location.osm", 4},
    {"osm/missing-node-in-way.osm", 4},
    {"osm/same-coordinate-nodes.osm", 4},
};

/// The damaged files below a folder, by their paths from there, without what belongs to them.
std::set<std::string> filesBelow(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && entry.path().extension() != ".bin")
            files.insert(entry.path().lexically_relative(folder).generic_string());
    }
    return files;
}

/// What an import that failed must tell.
void expectGoodError(const json& report, const test::ProgramResult& result,
                     const std::filesystem::path& file) {
    const json error = report.value("error", json::object());
    EXPECT_FALSE(error.value("what", "").empty()) << file;
    EXPECT_FALSE(error.value("remedy", "").empty()) << file << error;
    EXPECT_NE(result.output.find(file.filename().string()), std::string::npos)
        << file << " is not named: " << error;
}

TEST(SharedData, EveryDamagedFileEndsWithItsExitCodeAndAnErrorOrAnAccount) {
    const auto bad = test::sharedData("bad");
    if (!bad)
        GTEST_SKIP() << test::kNoSharedData;
    std::set<std::string> known;
    for (const auto& [path, code] : kBad)
        known.insert(path);
    EXPECT_EQ(filesBelow(*bad), known);
    const test::TemporaryFolder folder;
    const std::filesystem::path project = folder / "bad.reflet";
    for (const auto& [path, code] : kBad) {
        const std::filesystem::path file = *bad / path;
        const auto result =
            cli("import '" + file.string() + "' -o '" + project.string() + "' --json");
        EXPECT_EQ(result.exitCode, code) << path << result.errors;
        EXPECT_EQ(std::filesystem::exists(project), code == 0) << path;
        const json report = json::parse(result.output, nullptr, false);
        ASSERT_TRUE(report.is_object()) << path << result.output << result.errors;
        if (code != 0) {
            expectGoodError(report, result, file);
            continue;
        }
        const json& counts = report["counts"];
        EXPECT_GT(counts["loaded"].get<int>() + counts["repaired"].get<int>(), 0) << path;
        std::filesystem::remove(project);
    }
}

/// The reason why nothing can be shown is that of an object: its name, the fault and its remedy.
TEST(SharedData, WhereNothingIsLeftTheErrorNamesTheObjectThatWasLost) {
    const auto bad = test::sharedData("bad");
    if (!bad)
        GTEST_SKIP() << test::kNoSharedData;
    const test::TemporaryFolder folder;
    const auto told = [&](const std::string& path) {
        return cli("import '" + (*bad / path).string() + "' -o '" +
                   (folder / "bad.reflet").string() + "'")
            .errors;
    };
    const std::string building = told("citygml/malformed-poslist.gml");
    EXPECT_NE(building.find("coordinates"), std::string::npos) << building;
    const std::string footprint = told("geojson/no-geometry-type.geojson");
    EXPECT_NE(footprint.find("1747: "), std::string::npos) << footprint;
    EXPECT_NE(footprint.find("Fix geometries"), std::string::npos) << footprint;
    const std::string loop = told("gltf/node-node-loop.gltf");
    EXPECT_NE(loop.find("no triangle"), std::string::npos) << loop;
    EXPECT_EQ(loop.find("tileset"), std::string::npos) << loop;
    const std::string mesh = told("gltf/node-unresolved-mesh.gltf");
    EXPECT_NE(mesh.find("node 0: mesh 0"), std::string::npos) << mesh;
    const std::string empty = told("osm/same-coordinate-nodes.osm");
    EXPECT_NE(empty.find("no city object"), std::string::npos) << empty;
}

}  // namespace
}  // namespace reflet
