// SPDX-License-Identifier: GPL-3.0-or-later
// Textures of glTF, 3D Tiles and OBJ from the file to the colour of a point: an image of 4 x 4
// pixels lies on 4 x 4 m of ground, so that each square metre must have the colour of its pixel.
#include "app/pipeline/TextureDecoding.h"
#include "core/baking/CityAppearance.h"
#include "core/baking/Pattern.h"
#include "importers/FormatRegistry.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/files/CityTextureText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace reflet {
namespace {

using namespace test;

glm::vec3 linear(const std::array<std::uint8_t, 4>& pixel) {
    const auto& table = linearFromSrgbTable();
    return {table[pixel[0]], table[pixel[1]], table[pixel[2]]};
}

class CityTextureTest : public testing::Test {
protected:
    void read(const std::filesystem::path& path) {
        const auto format = cityFormatOf(path);
        ASSERT_TRUE(format) << format.error().message();
        ImportOptions options;
        options.crs = "local";
        auto imported = (*format)->read(path, options, {});
        ASSERT_TRUE(imported) << imported.error().message();
        city = std::move(imported->value.city);
        summary = std::move(imported->value.summary);
        diagnostics = std::move(imported->diagnostics);
        auto textures = std::make_shared<std::vector<MipTexture>>();
        const auto images = decodeTextures(city.textures, diagnostics, {});
        for (std::size_t i = 0; i < images.size(); ++i)
            textures->emplace_back(images[i], city.textures[i].repeat);
        appearance.emplace(city, std::make_shared<const SurfaceLooks>(city), textures, 0.0F);
    }
    /// Of the ground at a place, from right above; black where there is none.
    [[nodiscard]] glm::vec3 colourAt(double east, double north) const {
        const glm::dvec2 p = glm::dvec2(east, north) - glm::dvec2(city.frame.origin);
        for (std::size_t t = 0; t < city.triangles.size(); ++t) {
            std::array<glm::dvec2, 3> c{};
            for (std::size_t k = 0; k < 3; ++k)
                c[k] = glm::dvec2(glm::dvec3(city.vertices[city.triangles[t].vertex[k]]));
            const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) {
                return a.x * b.y - a.y * b.x;
            };
            const double area = cross(c[1] - c[0], c[2] - c[0]);
            const double u = cross(p - c[0], c[2] - c[0]) / area;
            const double v = cross(c[1] - c[0], p - c[0]) / area;
            if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
                return appearance
                    ->at(std::uint32_t(t), glm::vec3(glm::vec2(p), 0.0F), city.normal(t),
                         glm::vec2(u, v), Footprint{})
                    .albedo;
        }
        return glm::vec3(0.0F);
    }
    using Expected = std::function<glm::vec3(int column, int row)>;
    /// Each square metre has the colour that `expected` says; row 0 is the northernmost.
    void expectMap(const Expected& expected, double east = 0.0, double north = 0.0,
                   float tolerance = 2e-3F) const {
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                const glm::vec3 seen = colourAt(east + column + 0.5, north + 3.5 - row);
                EXPECT_LT(glm::length(seen - expected(column, row)), tolerance)
                    << "column " << column << ", row " << row << ": " << seen.x << " " << seen.y
                    << " " << seen.z;
            }
        }
    }
    void expectMap(double east = 0.0, double north = 0.0) const {
        expectMap([](int column, int row) { return linear(pixelOf(column, row)); }, east, north);
        EXPECT_EQ(summary.texturesReferenced, 1U);
        EXPECT_EQ(summary.texturesResolved, 1U);
        EXPECT_EQ(city.textures.size(), 1U);
    }
    [[nodiscard]] const Diagnostic* said(std::string_view code) const {
        for (const Diagnostic& d : diagnostics) {
            if (d.code == code)
                return &d;
        }
        return nullptr;
    }

    TemporaryFolder folder;
    CityModel city;
    SourceSummary summary;
    std::vector<Diagnostic> diagnostics;
    std::optional<CityAppearance> appearance;
};

TEST_F(CityTextureTest, AnImageWithinAGlbLiesAsItsCoordinatesSay) {
    read(folder.write("photo.glb", binaryGlb(photoSquare())));
    expectMap();
    ASSERT_EQ(city.textures.size(), 1U);
    ASSERT_TRUE(city.textures[0].embedded);
    EXPECT_EQ(city.textures[0].embedded->bytes, nullptr) << "it is read where it lies";
    EXPECT_EQ(folder.entryCount(), 1U) << "nothing was written beside the file";
}

TEST_F(CityTextureTest, AnImageInADataUriOrABufferOfOneIsKept) {
    read(folder.write("buffer.gltf", photoSquare().text()));
    expectMap();
    GltfText gltf = mapSquare();
    GltfText other;
    other.view(chequered());
    const std::string uri = json::parse(other.text())["buffers"][0]["uri"];
    gltf.root["images"] = {{{"uri", "data:image/png" + uri.substr(uri.find(';'))}}};
    read(folder.write("uri.gltf", gltf.text()));
    expectMap();
}

TEST_F(CityTextureTest, AnImageBesideTheFileIsFoundByItsEscapedName) {
    GltfText gltf = mapSquare();
    gltf.root["images"] = {{{"uri", "pictures/map%20one.png"}}};
    folder.write("pictures/map one.png", chequered());
    read(folder.write("photo.gltf", gltf.text()));
    expectMap();
    EXPECT_EQ(city.textures[0].reference, "pictures/map one.png");
}

TEST_F(CityTextureTest, AnImageInABufferBesideTheFileIsReadFromThere) {
    json root = json::parse(photoSquare().text());
    root["buffers"][0]["uri"] = "scene.bin";
    folder.write("scene.bin", photoSquare().bytes());
    read(folder.write("photo.gltf", root.dump()));
    expectMap();
    EXPECT_EQ(city.textures[0].path, (folder / "scene.bin").string());
}

TEST_F(CityTextureTest, TilesHaveTheTexturesOfTheirContents) {
    folder.write("tiles/a.b3dm", b3dm(binaryGlb(photoSquare(10.0F, 20.0F))));
    json children = json::array({tile("tiles/a.b3dm")});
    GltfText beside = mapSquare(30.0F, 0.0F);
    beside.root["images"] = {{{"uri", "../pictures/map.png"}}};
    folder.write("pictures/map.png", chequered());
    folder.write("tiles/b.gltf", beside.text());
    children.push_back(tile("tiles/b.gltf"));
    read(folder.write("tileset.json", tileset(tile("", children))));
    const Expected whole = [](int column, int row) { return linear(pixelOf(column, row)); };
    expectMap(whole, 10.0, 20.0);
    expectMap(whole, 30.0, 0.0);
    EXPECT_EQ(summary.texturesReferenced, 2U);
    EXPECT_EQ(summary.texturesResolved, 2U);
}

TEST_F(CityTextureTest, InstancesShareOneTexture) {
    const json table = {{"INSTANCES_LENGTH", 2}, {"POSITION", {{"byteOffset", 0}}}};
    const std::string places = floats({0, 0, 0, 50, 0, 0});
    folder.write("two.cmpt", cmpt({i3dm(binaryGlb(photoSquare()), table, places)}));
    read(folder.write("tileset.json", tileset(tile("two.cmpt"))));
    expectMap();
    expectMap(50.0, 0.0);
    EXPECT_EQ(city.objects.size(), 2U);
}

TEST_F(CityTextureTest, TheFactorAndTheColoursOfVerticesMultiplyTheImage) {
    GltfText gltf = photoSquare();
    gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1.0, 0.25, 1.0};
    read(folder.write("factor.glb", binaryGlb(gltf)));
    const glm::vec3 factor(0.5F, 1.0F, 0.25F);
    expectMap([&](int column, int row) { return factor * linear(pixelOf(column, row)); });
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = gltf.accessor(
        std::vector<float>{.5F, .5F, 1, .5F, .5F, 1, .5F, .5F, 1, .5F, .5F, 1}, 5126, "VEC3", 3);
    read(folder.write("vertices.glb", binaryGlb(gltf)));
    // Colours of vertices are rounded to 31 steps of their square root.
    expectMap(
        [&](int column, int row) {
            return factor * glm::vec3(0.5F, 0.5F, 1.0F) * linear(pixelOf(column, row));
        },
        0.0, 0.0, 0.03F);
}

TEST_F(CityTextureTest, TheTransformOfATextureTurnsItAsTheExtensionSays) {
    GltfText gltf = photoSquare();
    // By a quarter: (u, v) becomes (v, -u), of which the sampler repeats.
    gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"rotation", std::acos(0.0)}}}};
    gltf.root["extensionsRequired"] = {"KHR_texture_transform"};
    read(folder.write("turned.glb", binaryGlb(gltf)));
    expectMap([](int column, int row) { return linear(pixelOf(row, 3 - column)); });
    // By a pixel to the left and two up, of which the sampler repeats.
    gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"offset", {0.25, 0.5}}}}};
    read(folder.write("moved.glb", binaryGlb(gltf)));
    expectMap([](int column, int row) { return linear(pixelOf((column + 1) % 4, (row + 2) % 4)); });
}

TEST_F(CityTextureTest, ASecondSetOfCoordinatesIsUsedWhereItIsMeant) {
    GltfText gltf = photoSquare();
    auto& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"];
    attributes["TEXCOORD_0"] =
        gltf.accessor(std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC2", 2);
    gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    read(folder.write("second.glb", binaryGlb(gltf)));
    expectMap();
}

/// A square whose image spans a half of it: its coordinates run from 0 to 2 along both axes.
GltfText twiceAround(int wrapS, int wrapT) {
    GltfText gltf = photoSquare();
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        gltf.accessor(std::vector<float>{0, 2, 2, 2, 2, 0, 0, 0}, 5126, "VEC2", 2);
    gltf.root["samplers"] = {{{"wrapS", wrapS}, {"wrapT", wrapT}}};
    gltf.root["textures"][0]["sampler"] = 0;
    return gltf;
}

TEST_F(CityTextureTest, TheSamplerSaysHowTheImageGoesOn) {
    constexpr int kRepeat = 10497, kClamp = 33071, kMirror = 33648;
    // Pixels are half a metre wide: compare at their middles.
    const auto pixelAt = [&](double east, double north) { return colourAt(east, north); };
    read(folder.write("repeat.glb", binaryGlb(twiceAround(kRepeat, kRepeat))));
    EXPECT_LT(glm::length(pixelAt(0.75, 3.75) - linear(pixelOf(1, 0))), 2e-3F);
    EXPECT_LT(glm::length(pixelAt(2.75, 3.75) - linear(pixelOf(1, 0))), 2e-3F);
    EXPECT_LT(glm::length(pixelAt(2.75, 0.25) - linear(pixelOf(1, 3))), 2e-3F);
    EXPECT_EQ(said("texture-wrap"), nullptr);
    read(folder.write("clamp.glb", binaryGlb(twiceAround(kClamp, kClamp))));
    EXPECT_LT(glm::length(pixelAt(2.75, 3.75) - linear(pixelOf(3, 0))), 2e-3F);
    EXPECT_LT(glm::length(pixelAt(2.75, 0.25) - linear(pixelOf(3, 3))), 2e-3F);
    EXPECT_FALSE(city.textures[0].repeat);
    // What mirrors within a triangle is told, and repeats.
    read(folder.write("mirror.glb", binaryGlb(twiceAround(kMirror, kClamp))));
    ASSERT_NE(said("texture-wrap"), nullptr);
    EXPECT_EQ(said("texture-wrap")->text.substr(0, 14), "on 2 triangles");
}

TEST_F(CityTextureTest, AWholeTurnThatIsMirroredIsExact) {
    constexpr int kMirror = 33648;
    GltfText gltf = twiceAround(kMirror, kMirror);
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        gltf.accessor(std::vector<float>{1, 1, 2, 1, 2, 0, 1, 0}, 5126, "VEC2", 2);
    read(folder.write("mirror.glb", binaryGlb(gltf)));
    expectMap([](int column, int row) { return linear(pixelOf(3 - column, row)); });
    EXPECT_EQ(said("texture-wrap"), nullptr);
}

TEST_F(CityTextureTest, OpaqueImagesHideNothingAndHolesAreClosedWithTheMean) {
    std::vector<std::array<std::uint8_t, 4>> pixels;
    for (int i = 0; i < 16; ++i) {
        auto pixel = pixelOf(i % 4, i / 4);
        pixel[3] = i % 4 < 2 ? 0 : 255;  // the western half is cut out
        pixels.push_back(pixel);
    }
    GltfText gltf = mapSquare();
    gltf.root["images"] = {{{"bufferView", gltf.view(png(4, 4, pixels))}}};
    read(folder.write("opaque.glb", binaryGlb(gltf)));
    expectMap();
    EXPECT_EQ(said("texture-holes"), nullptr);
    gltf.root["materials"][0]["alphaMode"] = "MASK";
    read(folder.write("mask.glb", binaryGlb(gltf)));
    glm::vec3 mean(0.0F);
    for (int row = 0; row < 4; ++row)
        mean += (linear(pixelOf(2, row)) + linear(pixelOf(3, row))) / 8.0F;
    EXPECT_LT(glm::length(colourAt(0.5, 1.5) - mean), 5e-3F);
    EXPECT_LT(glm::length(colourAt(3.5, 1.5) - linear(pixelOf(3, 2))), 2e-3F);
    EXPECT_NE(said("texture-holes"), nullptr);
}

TEST_F(CityTextureTest, AMaterialFileOfObjNamesTheImageOfItsColour) {
    folder.write("map.png", chequered());
    folder.write("ground.mtl", "newmtl photo\nKd 1 1 1\nmap_Kd map.png\n");
    read(folder.write("ground.obj",
                      "mtllib ground.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"
                      "v 0 0 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl photo\n"
                      "f 1/1 2/2 3/3 4/4\n"));
    expectMap();
}

TEST_F(CityTextureTest, APhotoMeshOfObjThatCoversAllIsTerrainAndHousesAreNot) {
    folder.write("map.png", chequered());
    folder.write("photo.mtl", "newmtl photo\nmap_Kd map.png\n");
    const std::string head =
        "mtllib photo.mtl\nusemtl photo\nv 0 0 0\nv 80 0 0\nv 80 80 9\n"
        "v 0 80 0\nv 0 0 -9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    read(folder.write("skin.obj", head + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"));
    EXPECT_EQ(city.objects.at(0).type, CityObjectType::TinRelief);
    read(folder.write("half.obj", head + "f 1/1 2/2 3/3\n"));
    EXPECT_EQ(city.objects.at(0).type, CityObjectType::Building) << "it covers only half";
}

TEST_F(CityTextureTest, ImagesThatCannotBeHadAreToldAndLeaveTheColour) {
    struct Case {
        const char* name;
        json image;
        const char* code;
    };
    GltfText gltf = mapSquare();
    const int text = gltf.view("no image at all");
    const int cut = gltf.view(chequered().substr(0, 40));
    gltf.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.2, 0.4, 0.6, 1.0};
    folder.write("broken.png", "these are no pixels");
    const std::vector<Case> cases = {
        {"missing", {{"uri", "gone.png"}}, "texture-missing"},
        {"outside", {{"uri", "../../etc/secret.png"}}, "texture-outside"},
        {"absolute", {{"uri", "/etc/passwd"}}, "texture-absolute"},
        {"remote", {{"uri", "https://x.example/a.png"}}, "texture-remote"},
        {"unnamed", json::object(), "texture-broken"},
        {"base64", {{"uri", "data:image/png;base64,!!!!"}}, "texture-broken"},
        {"plain data", {{"uri", "data:image/png,hello"}}, "texture-broken"},
        {"no image", {{"bufferView", text}}, "texture-broken"},
        {"no view", {{"bufferView", 99}}, "texture-broken"},
        {"cut", {{"bufferView", cut}}, "texture-unreadable"},
        {"broken", {{"uri", "broken.png"}}, "texture-unreadable"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        gltf.root["images"] = json::array({c.image});
        read(folder.write("bad.gltf", gltf.text()));
        ASSERT_NE(said(c.code), nullptr);
        EXPECT_FALSE(said(c.code)->text.empty());
        EXPECT_FALSE(said(c.code)->remedy.empty());
        EXPECT_EQ(summary.texturesReferenced, 1U);
        expectMap([](int, int) { return 0.6F * glm::vec3(0.2F, 0.4F, 0.6F); });
    }
}

TEST_F(CityTextureTest, AnImageThatClaimsToBeHugeIsNotDecoded) {
    GltfText gltf = mapSquare();
    gltf.root["images"] = {{{"bufferView", gltf.view(png(100'000, 100'000, {}))}}};
    read(folder.write("bomb.glb", binaryGlb(gltf)));
    ASSERT_NE(said("texture-unreadable"), nullptr);
    EXPECT_NE(said("texture-unreadable")->text.find("100000 x 100000"), std::string::npos);
}

TEST_F(CityTextureTest, CoordinatesThatDoNotFitLeaveTheColour) {
    GltfText gltf = photoSquare();
    auto& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = gltf.accessor(std::vector<float>{0, 1, 1, 1}, 5126, "VEC2", 2);
    read(folder.write("few.glb", binaryGlb(gltf)));
    ASSERT_NE(said("texture-coordinates"), nullptr);
    EXPECT_EQ(said("texture-coordinates")->text.substr(0, 12), "2 triangles ");
    expectMap([](int, int) { return glm::vec3(0.6F); });
    attributes["TEXCOORD_0"] =
        gltf.accessor(std::vector<float>{0, std::nanf(""), 1, 1, 1, 0, 0, 0}, 5126, "VEC2", 2);
    read(folder.write("nan.glb", binaryGlb(gltf)));
    EXPECT_NE(said("texture-coordinates"), nullptr);
}

TEST(TextureCap, KeepsAllImagesTogetherWithinTheBudget) {
    const std::vector<glm::ivec2> sizes(100, glm::ivec2(2048, 1024));
    const double megabyte = 1024.0 * 1024.0;
    const TextureCap all = textureCap(sizes, 800.0 * megabyte);
    EXPECT_EQ(all.edge, 2048);
    EXPECT_EQ(all.reduced, 0U);
    const TextureCap half = textureCap(sizes, 799.0 * megabyte);
    EXPECT_EQ(half.edge, 1024);
    EXPECT_EQ(half.reduced, 100U);
    EXPECT_EQ(textureCap(sizes, 1.0).edge, 64);
    // A few large ones among many small ones stay as they are.
    std::vector<glm::ivec2> mixed(5000, glm::ivec2(32, 32));
    mixed.emplace_back(2048, 2048);
    EXPECT_EQ(textureCap(mixed, 256.0 * megabyte).edge, 2048);
}

}  // namespace
}  // namespace reflet
