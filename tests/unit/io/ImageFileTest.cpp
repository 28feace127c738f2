// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageFile.h"
#include "core/io/MapCache.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reflet {
namespace {

ReferenceEnvironmentMap someMap(int resolution) {
    ReferenceEnvironmentMap map{"p007",
                                {12.5, -3.25, 1.0 / 3.0},
                                CubeMap<glm::vec3>(resolution),
                                CubeMap<float>(resolution)};
    for (std::size_t i = 0; i < map.distance.texels().size(); ++i) {
        map.radiance.texels()[i] = {float(i % 7) * 0.25F, float(i % 11) * 0.5F, float(i % 1000)};
        map.distance.texels()[i] =
            i % 5 == 0 ? std::numeric_limits<float>::infinity() : 0.1F * float(i) + 1.0F / 3.0F;
    }
    return map;
}

TEST(ImageFile, ReadsBackTheEnvironmentMapThatItWrote) {
    const test::TemporaryFolder folder;
    const ReferenceEnvironmentMap map = someMap(32);
    const auto path = folder / "map.exr";
    ASSERT_TRUE(
        writeEnvironmentMap(map.id, map.center, map.radiance, map.distance, path).has_value());
    const auto read = readEnvironmentMap(path);
    ASSERT_TRUE(read.has_value()) << read.error().message();
    EXPECT_EQ(read->id, map.id);
    EXPECT_EQ(read->center, map.center);
    ASSERT_EQ(read->radiance.resolution(), 32);
    // Radiance was chosen exact in half precision; distances are stored as floats.
    EXPECT_EQ(read->radiance.texels(), map.radiance.texels());
    EXPECT_EQ(read->distance.texels(), map.distance.texels());
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(ImageFile, ClampsRadianceToWhatHalfPrecisionHolds) {
    const test::TemporaryFolder folder;
    ReferenceEnvironmentMap map = someMap(32);
    map.radiance.at(0, 0, 0) = {1e6F, 0.0F, 65504.0F};
    ASSERT_TRUE(
        writeEnvironmentMap("a", {}, map.radiance, map.distance, folder / "a.exr").has_value());
    const auto read = readEnvironmentMap(folder / "a.exr");
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->radiance.at(0, 0, 0), glm::vec3(65504.0F, 0.0F, 65504.0F));
}

TEST(ImageFile, WritesAPngThatReadsBackToTheSameBytes) {
    const test::TemporaryFolder folder;
    DisplayImage image{3, 2, {}};
    for (int i = 0; i < 6; ++i)
        image.pixels.emplace_back(float(i) / 255.0F, float(40 * i) / 255.0F, 1.0F);
    ASSERT_TRUE(writePng(image, folder / "a.png").has_value());
    const auto read = readTexture(folder / "a.png");
    ASSERT_TRUE(read.has_value()) << read.error().message();
    ASSERT_EQ(read->width, 3);
    ASSERT_EQ(read->height, 2);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(int(read->rgba[4 * i]), int(i));
        EXPECT_EQ(int(read->rgba[4 * i + 1]), int(40 * i));
        EXPECT_EQ(int(read->rgba[4 * i + 2]), 255);
        EXPECT_EQ(int(read->rgba[4 * i + 3]), 255);
    }
}

TEST(ImageFile, HalvesAnImageUntilItFits) {
    const test::TemporaryFolder folder;
    DisplayImage image{64, 16, std::vector<glm::vec3>(64 * 16, glm::vec3(0.0F))};
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = glm::vec3((i % 64) % 2 == 0 ? 0.0F : 1.0F);
    ASSERT_TRUE(writePng(image, folder / "a.png").has_value());
    const auto read = readTexture(folder / "a.png", 1'000'000, 32);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->width, 32);
    EXPECT_EQ(read->height, 8);
    for (std::size_t i = 0; i < read->rgba.size(); i += 4)
        EXPECT_EQ(int(read->rgba[i]), 128);
}

TEST(ImageFile, RefusesAnImageThatClaimsTooManyPixelsBeforeDecodingIt) {
    const test::TemporaryFolder folder;
    const DisplayImage image{100, 100, std::vector<glm::vec3>(10'000, glm::vec3(0.5F))};
    ASSERT_TRUE(writePng(image, folder / "a.png").has_value());
    const auto read = readTexture(folder / "a.png", 9'999);
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().code, ErrorCode::ResourceLimit);
    EXPECT_NE(read.error().what.find("100 x 100"), std::string::npos);
}

TEST(ImageFile, RefusesFilesThatAreNoImagesWithTheirName) {
    const test::TemporaryFolder folder;
    for (const auto& path : {folder.write("empty.jpg", ""), folder.write("text.png", "no picture"),
                             folder / "absent.png"}) {
        const auto read = readTexture(path);
        ASSERT_FALSE(read.has_value());
        EXPECT_EQ(read.error().code, ErrorCode::Unreadable);
        EXPECT_EQ(read.error().subject, path.string());
        EXPECT_FALSE(readEnvironmentMap(path).has_value());
    }
}

TEST(ImageFile, SurvivesTheDamagedImagesOfTheSharedData) {
    const auto folder = test::sharedData("bad/image");
    if (!folder)
        GTEST_SKIP() << test::kNoSharedData;
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
        ++files;
        const auto texture = readTexture(entry.path(), 64'000'000);
        if (!texture) {
            EXPECT_EQ(texture.error().subject, entry.path().string());
        }
        EXPECT_FALSE(readEnvironmentMap(entry.path()).has_value()) << entry.path();
    }
    EXPECT_GE(files, 9U);
    EXPECT_EQ(readTexture(*folder / "bomb-65500x65500.jpg").error().code, ErrorCode::ResourceLimit);
}

TEST(ImageFile, LeavesNothingBehindWhenTheFolderIsMissing) {
    const test::TemporaryFolder folder;
    const auto written = writePng({1, 1, {glm::vec3(0.0F)}}, folder / "absent" / "a.png");
    ASSERT_FALSE(written.has_value());
    EXPECT_EQ(written.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(folder.entryCount(), 0U);
}

TEST(MapCache, FindsWhatWasStoredAndNothingElse) {
    const test::TemporaryFolder folder;
    const MapCache cache(folder / "city.cache");
    EXPECT_FALSE(cache.find("0123").has_value());
    ASSERT_TRUE(cache.store("0123", someMap(32)).has_value());
    const auto found = cache.find("0123");
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->id, "p007");
    EXPECT_GT(cache.bytes("0123"), 1000U);
    EXPECT_FALSE(cache.find("4567").has_value());
}

TEST(MapCache, CountsADamagedFileAsAbsent) {
    const test::TemporaryFolder folder;
    const MapCache cache(folder / "city.cache");
    ASSERT_TRUE(cache.store("0123", someMap(32)).has_value());
    const auto bytes = test::bytesOf(cache.pathOf("0123"));
    folder.write("city.cache/rem/0123.exr", bytes.substr(0, bytes.size() / 2));
    EXPECT_FALSE(cache.find("0123").has_value());
}

TEST(MapCache, SaysWhenTheFolderCannotBeMade) {
    const test::TemporaryFolder folder;
    folder.write("city.cache", "a file where the folder should be");
    const auto stored = MapCache(folder / "city.cache").store("0123", someMap(32));
    ASSERT_FALSE(stored.has_value());
    EXPECT_EQ(stored.error().code, ErrorCode::WriteFailed);
}

}  // namespace
}  // namespace reflet
