// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/FormatRegistry.h"
#include "importers/obj/ObjFile.h"
#include "importers/obj/ObjImporter.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// A box from (x, 0, 0), 4 m by 3 m by 2 m, as faces of four corners; `first` is its first vertex.
std::string box(double x, int first, double y = 0.0) {
    std::string text;
    for (const double up : {0.0, 2.0}) {
        for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {4.0, 0.0}, {4.0, 3.0}, {0.0, 3.0}})
            text += fmt::format("v {} {} {}\n", x + dx, y + dy, up);
    }
    for (const auto& f : {std::array{0, 3, 2, 1}, std::array{4, 5, 6, 7}, std::array{0, 1, 5, 4},
                          std::array{1, 2, 6, 5}, std::array{2, 3, 7, 6}, std::array{3, 0, 4, 7}})
        text +=
            fmt::format("f {} {} {} {}\n", first + f[0], first + f[1], first + f[2], first + f[3]);
    return text;
}

ImportOptions local() {
    ImportOptions options;
    options.crs = "local";
    return options;
}

Imported<CityImport> imported(const std::string& text, const ImportOptions& options = local()) {
    auto city = importObjBytes(text, "/nonexistent/town.obj", options, {});
    EXPECT_TRUE(city) << city.error().message();
    return city ? *std::move(city) : Imported<CityImport>();
}

const Diagnostic* remark(const std::vector<Diagnostic>& list, std::string_view code) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Diagnostic& d) { return d.code == code; });
    return found == list.end() ? nullptr : &*found;
}

TEST(ObjImporter, ObjectsBecomeClosedBuildings) {
    const auto city = imported("# two\no left\n" + box(0, 1) + "o right\n" + box(10, 9));
    const CityModel& model = city.value.city;
    ASSERT_EQ(model.objects.size(), 2U);
    EXPECT_EQ(model.objects[0].id, "left");
    EXPECT_EQ(model.objects[1].id, "right");
    EXPECT_EQ(model.objects[0].type, CityObjectType::Building);
    EXPECT_EQ(openEdges(model), 0U);
    EXPECT_NEAR(volume(model), 2 * 4 * 3 * 2, 1e-4);
    EXPECT_EQ(city.value.summary.surfaces, 12U);
    EXPECT_EQ(city.value.summary.format, "OBJ");
}

TEST(ObjImporter, GroupsCountWhereThereIsOneObjectAndTheFileWhereThereIsNone) {
    const auto groups = imported("o all\ng a\n" + box(0, 1) + "g b\n" + box(10, 9));
    ASSERT_EQ(groups.value.city.objects.size(), 2U);
    EXPECT_EQ(groups.value.city.objects[1].id, "b");
    const auto none = imported(box(0, 1));
    ASSERT_EQ(none.value.city.objects.size(), 1U);
    EXPECT_EQ(none.value.city.objects[0].id, "town");
    // A name that comes again goes on with its object.
    EXPECT_EQ(imported("o a\n" + box(0, 1) + "o b\n" + box(10, 9) + "o a\n" + box(20, 17))
                  .value.city.objects.size(),
              2U);
}

TEST(ObjImporter, IndicesMayCountBackAndFacesMayHaveManyCornersAndStrangeNumbers) {
    std::string text = box(0, 1);
    for (const auto& [from, to] :
         {std::pair("f 1 4 3 2", "f -8 -5 -6 -7"), std::pair("f 5 6 7 8", "f 5//1 6//1 7//1 8//1"),
          std::pair("f 1 2 6 5", "f 1 \\\n 2 6 5 # front"), std::pair("v 4 ", "v +4.0e0 ")})
        text.replace(text.find(from), std::string(from).size(), to);
    const auto city = imported(text);
    EXPECT_EQ(openEdges(city.value.city), 0U);
    EXPECT_NEAR(volume(city.value.city), 24.0, 1e-5);
    // An L of six corners, not convex: 10 x 10 less 6 x 6.
    const auto shape = imported(
        "v 0 0 0\r\nv 10 0 0\r\nv 10 4 0\r\nv 4 4 0\r\nv 4 10 0\r\n"
        "v 0 10 0\r\nf 1 2 3 4 5 6\r\n");
    double area = 0.0;
    const CityModel& flat = shape.value.city;
    for (const CityTriangle& t : flat.triangles) {
        const glm::dvec3 a = flat.vertices[t.vertex[0]], b = flat.vertices[t.vertex[1]],
                         c = flat.vertices[t.vertex[2]];
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(area, 64.0, 1e-4);
    // Faces may come before their vertices.
    EXPECT_EQ(imported("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").value.city.triangles.size(), 1U);
}

TEST(ObjImporter, TheUpAxisAndTheUnitAreSeenOrTold) {
    // A town of two boxes, 54 x 43 x 2, written with y up: x, z, -y.
    std::string lying;
    const std::string flat = box(0, 1) + box(50, 9, 40);
    for (std::size_t at = 0; at < flat.size();) {
        const std::size_t end = flat.find('\n', at);
        std::string line = flat.substr(at, end - at);
        double x = 0, y = 0, z = 0;
        if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
            line = fmt::format("v {} {} {}", x, z, -y);
        lying += line + "\n";
        at = end + 1;
    }
    const glm::dvec3 size(54.0, 43.0, 2.0);
    EXPECT_EQ(imported(flat).value.city.bounds().size(), size);
    const auto seen = imported(lying);
    EXPECT_EQ(seen.value.city.bounds().size(), size);
    EXPECT_NE(remark(seen.diagnostics, "up-axis"), nullptr);
    EXPECT_NEAR(volume(seen.value.city), 48.0, 1e-3) << "turned, not mirrored";
    ImportOptions told = local();
    told.upAxis = "z";
    told.unit = 0.3048;
    const auto feet = imported(lying, told);
    EXPECT_EQ(remark(feet.diagnostics, "up-axis"), nullptr);
    EXPECT_NEAR(feet.value.city.bounds().size().y, 2.0 * 0.3048, 1e-3);
    EXPECT_NEAR(feet.value.city.bounds().size().z, 43.0 * 0.3048, 1e-3);
}

TEST(ObjImporter, CoordinatesOfACrsKeepTheirMillimetres) {
    ImportOptions options;
    options.crs = "EPSG:28992";
    const auto city = imported(
        "v 85012.343 447455.577 0.88\nv 85013.343 447455.577 0.88\n"
        "v 85013.343 447456.078 0.88\nf 1 2 3\n",
        options);
    const CityModel& model = city.value.city;
    ASSERT_EQ(model.vertices.size(), 3U);
    EXPECT_EQ(model.frame.crs, "EPSG:28992");
    EXPECT_NEAR(model.frame.origin.x + double(model.vertices[0].x), 85012.343, 1e-4);
    EXPECT_NEAR(double(model.vertices[2].y - model.vertices[1].y), 0.501, 1e-4);
}

TEST(ObjImporter, MaterialsAndTexturesComeFromLibrariesInItsFolder) {
    const TemporaryFolder folder;
    folder.write("looks/town.mtl",
                 "newmtl BuildingWall\nKd 1 0 0\nd 0.25\n"
                 "map_Kd -s 2 2 1 -clamp on brick wall.png\n"
                 "newmtl Terrain\nKd 0.5\nTr 1\n");
    folder.write("looks/brick wall.png", "png");
    const fs::path path =
        folder.write("town.obj",
                     "mtllib looks/town.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5\nv 0 0 0\nv 1 0 0\n"
                     "v 1 1 0\nv 0 1 0\no a\nusemtl BuildingWall\nf 1/1 2/2 3/3\nf 1 3 4\n"
                     "usemtl Terrain\nf 4/1 3/2 1/9\n");
    const auto city = importObj(path, local(), {});
    ASSERT_TRUE(city) << city.error().message();
    const CityModel& model = city->value.city;
    // Materials of two kinds make two objects of one.
    ASSERT_EQ(model.objects.size(), 2U);
    EXPECT_EQ(model.objects[0].id, "a/Building");
    EXPECT_EQ(model.objects[1].id, "a/TINRelief");
    EXPECT_EQ(model.objects[1].type, CityObjectType::TinRelief);
    ASSERT_EQ(model.surfaces.size(), 3U);
    EXPECT_EQ(model.surfaces[0].type, SurfaceType::Wall);
    const CityMaterial& wall = model.materials[model.surfaces[0].material];
    EXPECT_EQ(wall.diffuse, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_FLOAT_EQ(wall.transparency, 0.75F);
    // sRGB 0.5 is 0.21404 in linear light (IEC 61966-2-1).
    EXPECT_NEAR(model.materials[model.surfaces[2].material].diffuse.y, 0.21404F, 1e-4F);
    EXPECT_FLOAT_EQ(model.materials[model.surfaces[2].material].transparency, 0.0F);
    ASSERT_EQ(model.textures.size(), 1U);
    EXPECT_EQ(bytesOf(model.textures[0].path), "png");
    EXPECT_FALSE(model.textures[0].repeat);
    EXPECT_EQ(model.surfaces[0].texture, 0U);
    EXPECT_EQ(model.surfaces[1].texture, kNone) << "no texture coordinates";
    ASSERT_EQ(model.uv.size(), 3U);
    EXPECT_EQ(model.uv[0][1], glm::vec2(1.0F, 0.0F));
}

TEST(ObjImporter, NothingOutsideItsFolderIsRead) {
    const TemporaryFolder folder;
    folder.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("a/images.mtl", "newmtl m\nKd 0 1 0\nmap_Kd ../secret.png\n");
    for (const char* library : {"../secret.mtl", "/etc/passwd", "https://x.example/a.mtl"}) {
        const fs::path path =
            folder.write("a/town.obj", fmt::format("mtllib {}\nusemtl m\n{}", library, box(0, 1)));
        const auto city = importObj(path, local(), {});
        ASSERT_TRUE(city);
        EXPECT_TRUE(city->value.city.materials.empty()) << library;
        const Diagnostic* missing = remark(city->diagnostics, "materials-missing");
        ASSERT_NE(missing, nullptr) << library;
        EXPECT_NE(missing->text.find(library), std::string::npos);
    }
    const auto city = importObj(
        folder.write("a/town.obj", "mtllib images.mtl\nusemtl m\n" + box(0, 1)), local(), {});
    ASSERT_TRUE(city);
    EXPECT_EQ(city->value.city.materials.size(), 1U);
    EXPECT_NE(remark(city->diagnostics, "texture-outside"), nullptr);
}

TEST(ObjImporter, BadFacesCostThemselvesAndAreTold) {
    const auto city = imported("o a\n" + box(0, 1) +
                               "f 1 2 99\nf 0 1 2\nf 1 2\nf 1 two 3\nf -99 1 2\n"
                               "o b\nf 7 8 999\nv 1,5 2,5 3,5\nf 9 1 2\n");
    EXPECT_EQ(city.value.city.triangles.size(), 12U);
    EXPECT_NEAR(volume(city.value.city), 24.0, 1e-5);
    EXPECT_EQ(city.counts.repaired, 1U);
    EXPECT_EQ(city.counts.skipped, 1U);
    EXPECT_NE(remark(city.diagnostics, "vertex-unreadable"), nullptr);
    const Diagnostic* range = remark(city.diagnostics, "index-out-of-range");
    ASSERT_NE(range, nullptr);
    EXPECT_EQ(range->object, "a");
}

TEST(ObjImporter, BadFilesAreErrorsThatNameThem) {
    for (const char* text : {"", "# nothing\n", "v 0 0 0\n", "f 1 2 3\n", "curv 0 1 1 2\n"}) {
        const auto none = importObjBytes(text, "/x/town.obj", local(), {});
        ASSERT_FALSE(none) << text;
        EXPECT_EQ(none.error().code, ErrorCode::Unreadable);
        EXPECT_EQ(none.error().subject, "/x/town.obj");
        EXPECT_FALSE(none.error().remedy.empty());
    }
    const auto endless =
        importObjBytes("f " + std::string(std::size_t(18) << 20, '1'), "/x/town.obj", local(), {});
    ASSERT_FALSE(endless);
    EXPECT_EQ(endless.error().code, ErrorCode::ResourceLimit);
    const auto folder = sharedData("bad/obj");
    if (!folder)
        GTEST_SKIP() << kNoSharedData;
    const std::map<std::string, std::pair<std::size_t, std::size_t>> expected{
        {"duplicate-vertices.obj", {5, 0}},
        {"index-zero.obj", {10, 1}},
        {"malformed-index-out-of-range.obj", {0, 1}}};
    for (const auto& [name, counts] : expected) {
        const auto format = cityFormatOf(*folder / name);
        ASSERT_TRUE(format) << name;
        EXPECT_EQ((*format)->name, "OBJ") << name;
        const auto city = (*format)->read(*folder / name, local(), {});
        ASSERT_TRUE(city) << name << city.error().message();
        EXPECT_EQ(city->counts.repaired, counts.second) << name;
        if (counts.first > 0) {
            EXPECT_EQ(city->value.city.triangles.size(), counts.first) << name;
        }
    }
    EXPECT_FALSE(importObj(*folder / "completely-empty.obj", local(), {}));
}

TEST(ObjImporter, DelftHasItsCounts) {
    const auto path = sharedData("obj/delft-3dfier.obj");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto format = cityFormatOf(*path);
    ASSERT_TRUE(format);
    ASSERT_EQ((*format)->name, "OBJ");
    ImportOptions options;
    options.crs = "EPSG:7415";
    const auto info = (*format)->inspect(*path, options, {});
    ASSERT_TRUE(info) << info.error().message();
    EXPECT_EQ(info->value.surfaces, 28619U);
    EXPECT_EQ(info->value.triangles, 28619U);
    EXPECT_EQ(info->value.objects, 570U);
    EXPECT_EQ(info->value.byType.at("Building"), 160U);
    EXPECT_EQ(info->value.byType.at("TINRelief"), 81U);
    EXPECT_NEAR(info->value.bounds.min.x, 84616.468, 1e-9);
    EXPECT_NEAR(info->value.bounds.max.y, 447750.636, 1e-9);
    EXPECT_NEAR(info->value.bounds.max.z, 13.58, 1e-9);
    const auto city = (*format)->read(*path, options, {});
    ASSERT_TRUE(city);
    EXPECT_EQ(city->value.city.frame.crs, "EPSG:28992");
    EXPECT_EQ(city->counts.skipped, 0U);
    EXPECT_NE(remark(city->diagnostics, "materials-missing"), nullptr);
}

}  // namespace
}  // namespace reflet
