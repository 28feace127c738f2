// SPDX-License-Identifier: GPL-3.0-or-later
// Which tiles of a tileset are taken, and what the description of a glTF file tells.
#include "importers/gltf/GltfOutline.h"
#include "importers/tiles/TileChoice.h"
#include "importers/tiles/TilesImporter.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/files/TileText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

json withError(json tile, double error) {
    tile["geometricError"] = error;
    return tile;
}

/// A root of one box; below it two tiles of two boxes each, below each of those two of four: 12,
/// 48 and 192 triangles at geometric errors of 20, 5 and 0 m. `refine` as in the tileset.
class TileChoice : public testing::Test {
protected:
    void SetUp() override {
        const auto boxes = [](int count, float east) {
            GltfText gltf;
            json nodes = json::array(), scene = json::array();
            for (int i = 0; i < count; ++i) {
                gltf.box({east + float(i), 0, 0}, {east + float(i) + 1, 1, 1});
                nodes.push_back({{"mesh", i}});
                scene.push_back(i);
            }
            gltf.root["nodes"] = nodes;
            gltf.root["scenes"][0]["nodes"] = scene;
            return gltf;
        };
        folder.write("root.glb", binaryGlb(boxes(1, 0)));
        json middle = json::array();
        for (int i = 0; i < 2; ++i) {
            const std::string name = "middle" + std::to_string(i);
            folder.write(name + ".b3dm", b3dm(binaryGlb(boxes(2, float(10 * i)))));
            json fine = json::array();
            for (int k = 0; k < 2; ++k) {
                const std::string leaf = name + std::to_string(k) + ".glb";
                folder.write(leaf, binaryGlb(boxes(4, float(10 * i + 5 * k))));
                fine.push_back(withError(tile(leaf), 0));
            }
            middle.push_back(withError(tile(name + ".b3dm", fine), 5));
        }
        path = folder.write("tileset.json", tileset(withError(tile("root.glb", middle), 20)));
    }
    [[nodiscard]] std::size_t tilesAt(std::optional<double> error) const {
        const auto tree = tiles::chooseTiles(path, error, {});
        EXPECT_TRUE(tree);
        return tree ? tree->tiles.size() : 0;
    }

    TemporaryFolder folder;
    fs::path path;
};

TEST_F(TileChoice, TilesAreAsCoarseAsIsGoodEnough) {
    EXPECT_EQ(tilesAt(0.0), 4U);
    EXPECT_EQ(tilesAt(4.9), 4U);
    EXPECT_EQ(tilesAt(5.0), 2U);
    EXPECT_EQ(tilesAt(19.0), 2U);
    EXPECT_EQ(tilesAt(20.0), 1U);
    EXPECT_EQ(tilesAt(std::nullopt), 4U) << "a small city is shown at its finest";
    ImportOptions options;
    options.crs = "local";
    options.geometricError = 5.0;
    const auto city = importTiles(path, options, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.triangles.size(), 48U);
}

TEST_F(TileChoice, TheFinestThatFitIsTakenAndTold) {
    const auto at = [&](std::size_t most) {
        auto tree = tiles::chooseTiles(path, std::nullopt, {}, most);
        EXPECT_TRUE(tree);
        return tree ? *std::move(tree) : tiles::TileTree();
    };
    EXPECT_EQ(at(192).tiles.size(), 4U);
    EXPECT_TRUE(at(192).remarks.empty());
    EXPECT_EQ(at(191).tiles.size(), 2U);
    EXPECT_EQ(at(48).tiles.size(), 2U);
    EXPECT_EQ(at(47).tiles.size(), 1U);
    EXPECT_EQ(at(1).tiles.size(), 1U) << "the coarsest, whatever it has";
    const auto coarser = at(191);
    ASSERT_EQ(coarser.remarks.size(), 1U);
    EXPECT_EQ(coarser.remarks[0].code, "tiles-coarser");
    EXPECT_NE(coarser.remarks[0].text.find("up to 5 m were taken, 48 triangles"), std::string::npos)
        << coarser.remarks[0].text;
    EXPECT_FALSE(coarser.remarks[0].remedy.empty());
}

TEST_F(TileChoice, ATileWhoseFileIsMissingIsNoneThatIsGoodEnough) {
    fs::remove(folder / "middle0.b3dm");
    EXPECT_EQ(tilesAt(5.0), 3U) << "the finer ones stand for it";
    const auto tree = tiles::chooseTiles(path, 5.0, {});
    ASSERT_TRUE(tree);
    EXPECT_EQ(tree->missing, 1U) << "told once";
}

TEST_F(TileChoice, LevelsOfImplicitTilingsHalveTheError) {
    json root = withError(tile("t/{level}_{x}_{y}.glb"), 16);
    root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"}, {"availableLevels", 3}};
    for (const char* name : {"0_0_0", "1_0_0", "1_1_0", "2_0_0", "2_1_1", "2_3_0"})
        folder.write(std::string("t/") + name + ".glb", binaryGlb(boxAt(0, 0)));
    path = folder.write("implicit.json", tileset(root));
    EXPECT_EQ(tilesAt(0.0), 3U);
    EXPECT_EQ(tilesAt(8.0), 2U);
    EXPECT_EQ(tilesAt(16.0), 1U);
}

TEST_F(TileChoice, CountsOfContentsNeedNoData) {
    EXPECT_EQ(tiles::countTileTriangles(folder / "middle0.b3dm"), 24U);
    EXPECT_EQ(tiles::countTileTriangles(folder / "middle00.glb"), 48U);
    const json table = {{"INSTANCES_LENGTH", 3}, {"POSITION", {{"byteOffset", 0}}}};
    const std::string one = binaryGlb(boxAt(0, 0));
    const std::string places = floats({0, 0, 0, 1, 0, 0, 2, 0, 0});
    EXPECT_EQ(tiles::countTileTriangles(folder.write("a.i3dm", i3dm(one, table, places))), 36U);
    EXPECT_EQ(tiles::countTileTriangles(folder.write("a.cmpt", cmpt({b3dm(one), b3dm(one)}))), 24U);
    EXPECT_EQ(tiles::countTileTriangles(folder.write("a.glb", "glTF but not really")), 0U);
    EXPECT_EQ(tiles::countTileTriangles(folder.write("b.b3dm", "b3dm" + std::string(24, '\xff'))),
              0U);
    EXPECT_EQ(tiles::countTileTriangles(folder / "gone.glb"), 0U);
}

TEST_F(TileChoice, TheDescriptionOfAFileTellsItsSizeAndWhetherItHasAPlace) {
    GltfText gltf = boxAt(10, 20);
    gltf.root["nodes"][0]["scale"] = {2, 2, 2};
    const fs::path file = folder.write("box.glb", binaryGlb(gltf));
    auto outline = gltf::readOutline(file);
    ASSERT_TRUE(outline) << outline.error().message();
    EXPECT_EQ(outline->triangles, 12U);
    EXPECT_EQ(outline->bounds.size(), glm::dvec3(8, 4, 6));
    EXPECT_FALSE(outline->georeferenced);
    folder.write("box.wld3", "0,0,0 1,1,1");
    EXPECT_TRUE(gltf::readOutline(file)->georeferenced);
    fs::remove(folder / "box.wld3");
    gltf.root["asset"]["extras"]["georeference"] = {{"crs", "EPSG:25832"}};
    EXPECT_TRUE(gltf::readOutline(folder.write("box.gltf", gltf.text()))->georeferenced);
}

}  // namespace
}  // namespace reflet
