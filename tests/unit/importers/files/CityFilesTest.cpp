// SPDX-License-Identifier: GPL-3.0-or-later
// Which files are meant by folders, patterns and lists.
#include "importers/CityFiles.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

constexpr std::string_view kCity = R"({"type": "CityJSON", "CityObjects": {}})";
constexpr std::string_view kGrid =
    "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n";

Paths pathsOf(const Paths& named) {
    auto found = cityFilesOf(named, {});
    EXPECT_TRUE(found) << found.error().message();
    return found ? found->files : Paths();
}

TEST(CityFiles, AFolderStandsForTheModelsInItAndBelow) {
    const TemporaryFolder folder;
    const Paths models{folder.write("a.city.json", kCity), folder.write("tiles/b.json", kCity),
                       folder.write("tiles/damaged.gml", "oops")};
    folder.write("metadata.xml", "<metadata/>");
    folder.write("package.json", "{\"name\": \"x\"}");
    folder.write("readme.txt", "a town");
    folder.write(".git/c.city.json", kCity);
    const auto found = cityFilesOf({folder.path()}, {});
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_EQ(found->files, models);
    ASSERT_EQ(found->remarks.size(), 1U);
    EXPECT_EQ(found->remarks.front().text,
              "3 files are no city models and were passed over: metadata.xml, package.json, "
              "readme.txt");
}

TEST(CityFiles, PicturesWithoutAPlaceAreTexturesAndGridsAreTerrain) {
    const TemporaryFolder folder;
    const fs::path city = folder.write("town.city.json", kCity);
    const fs::path grid = folder.write("ground/dem.asc", kGrid);
    folder.write("appearances/wall.tif", "II*");
    EXPECT_EQ(pathsOf({folder.path()}), (Paths{city, grid}));
    // Alone, rasters of one use are one model: their folder.
    EXPECT_EQ(pathsOf({folder / "ground"}), (Paths{folder / "ground"}));
}

TEST(CityFiles, RealPicturesWithAPlaceAreTold) {
    const auto rasters = sharedData("geotiff");
    if (!rasters)
        GTEST_SKIP() << kNoSharedData;
    // Heights and a picture: each is a file of its own.
    const auto files = pathsOf({*rasters});
    ASSERT_EQ(files.size(), 4U);
    EXPECT_EQ(files[2].filename(), "manila-ortho.tif");
}

TEST(CityFiles, ATilesetStandsForItsTilesAndTheTilesetsBelowIt) {
    const TemporaryFolder folder;
    constexpr std::string_view kTiles = R"({"asset": {}, "geometricError": 1, "root": {}})";
    folder.write("tiles/a/tileset.json", kTiles);
    folder.write("tiles/a/part.json", kTiles);
    folder.write("tiles/a/x.glb", "glTF");
    const fs::path outer = folder.write("tiles/tileset.json", kTiles);
    const fs::path other = folder.write("others/tileset.json", kTiles);
    Paths found = pathsOf({folder.path()});
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (Paths{other, outer}));
}

TEST(CityFiles, PatternsAndListsNameFilesOnce) {
    const TemporaryFolder folder;
    const fs::path a = folder.write("a.city.json", kCity);
    const fs::path b = folder.write("b.city.json", kCity);
    EXPECT_EQ(pathsOf({folder / "?.city.*"}), (Paths{a, b}));
    const fs::path list = folder.write("list.txt", "# two of them\nb.city.json\r\n\na.city.json\n");
    EXPECT_EQ(pathsOf({"@" + list.string()}), (Paths{b, a}));
    const fs::path patterns = folder.write("patterns.txt", "*.city.json\n");
    EXPECT_EQ(pathsOf({b, "@" + patterns.string(), folder.path()}), (Paths{b, a}));
    EXPECT_EQ(pathsOf({"/nonexistent/c.gml"}), (Paths{"/nonexistent/c.gml"}));
    const fs::path odd = folder.write("[x].city.json", kCity);
    EXPECT_EQ(pathsOf({odd}), (Paths{odd})) << "a file that is there is no pattern";
}

TEST(CityFiles, WhatStandsForNothingIsAnErrorThatNamesIt) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "empty");
    const auto empty = cityFilesOf({folder / "empty"}, {});
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().what, "has no city models in it");
    EXPECT_EQ(empty.error().subject, (folder / "empty").string());
    EXPECT_FALSE(empty.error().remedy.empty());
    const auto nothing = cityFilesOf({folder / "*.ifc"}, {});
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().what, "matches no file");
    EXPECT_FALSE(cityFilesOf({"@/nonexistent/list.txt"}, {}));
    const auto hollow = cityFilesOf({"@" + folder.write("list.txt", "\n# none\n").string()}, {});
    ASSERT_FALSE(hollow);
    EXPECT_EQ(hollow.error().what, "names no file");
    // A list may not lead to itself without end.
    const fs::path loop = folder.write("loop.txt", "@loop.txt\n");
    EXPECT_EQ(pathsOf({"@" + loop.string()}), (Paths{folder / "@loop.txt"}));
}

TEST(CityFiles, LinksToFoldersAreNotFollowedAndAJobCanBeCancelled) {
    const TemporaryFolder folder;
    const fs::path city = folder.write("a.city.json", kCity);
    fs::create_directory_symlink(folder.path(), folder / "again");
    EXPECT_EQ(pathsOf({folder.path()}), (Paths{city}));
    std::stop_source stop;
    stop.request_stop();
    const auto cancelled = cityFilesIn(folder.path(), JobContext({}, stop.get_token()));
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet
