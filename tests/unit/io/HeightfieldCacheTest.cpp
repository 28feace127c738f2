// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/HeightfieldCache.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace reflet {
namespace {

/// 30 x 20 cells, some of them missing.
Heightfield someField() {
    Heightfield field;
    field.grid = {-7.5, 3.25, 0.5, 30, 20};
    for (std::size_t i = 0; i < field.grid.cellCount(); ++i) {
        field.ground.push_back(0.1F * float(i));
        field.topMax.push_back(i % 7 == 0 ? kMissingHeight : 40.0F + float(i));
        field.topCenter.push_back(i % 5 == 0 ? kMissingHeight : 30.0F - float(i));
    }
    field.spans = CellSpans(field.grid.cellCount(), {7, 130}, {0, 2, 5},
                            {{-kInfinity, 1, CityObjectType::TinRelief, false},
                             {6, 7, CityObjectType::Bridge, false},
                             {-kInfinity, 2, CityObjectType::Building, false},
                             {5, 6, CityObjectType::Bridge, true},
                             {8, 9, CityObjectType::Other, false}});
    field.centerSpans = CellSpans(field.grid.cellCount(), {7}, {0, 2},
                                  {{-kInfinity, 1, CityObjectType::TinRelief, false},
                                   {6.5F, 7, CityObjectType::Bridge, false}});
    return field;
}

/// NaN is equal to itself here.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    });
}

class HeightfieldCacheTest : public testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(cache.store("key", field)); }
    void damage(std::size_t at) const {
        std::string bytes = test::bytesOf(cache.pathOf("key"));
        ASSERT_LT(at, bytes.size());
        bytes[at] = char(bytes[at] ^ 1);
        folder.write(cache.pathOf("key").lexically_relative(folder.path()), bytes);
    }

    test::TemporaryFolder folder;
    HeightfieldCache cache{folder.path()};
    Heightfield field = someField();
};

TEST_F(HeightfieldCacheTest, GivesBackTheSameBits) {
    const auto found = cache.find("key", field.grid);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->grid, field.grid);
    EXPECT_TRUE(sameBits(found->ground, field.ground));
    EXPECT_TRUE(sameBits(found->topMax, field.topMax));
    EXPECT_TRUE(sameBits(found->topCenter, field.topCenter));
    EXPECT_EQ(found->spans, field.spans);
    EXPECT_EQ(found->centerSpans, field.centerSpans);
}

TEST_F(HeightfieldCacheTest, KnowsNothingUnderAnotherKeyOrForAnotherGrid) {
    EXPECT_FALSE(cache.find("other", field.grid));
    GridSpec moved = field.grid;
    moved.x0 += 0.5;
    EXPECT_FALSE(cache.find("key", moved));
    GridSpec turned = field.grid;
    std::swap(turned.columns, turned.rows);
    EXPECT_FALSE(cache.find("key", turned));
    EXPECT_FALSE(cache.find("key", GridSpec{}));
}

TEST_F(HeightfieldCacheTest, TakesADamagedFileForNone) {
    const std::size_t layersEnd = 112 + 3 * 600 * 4;
    const std::size_t end = test::bytesOf(cache.pathOf("key")).size();
    ASSERT_GT(end, layersEnd);
    for (const std::size_t at :
         {std::size_t(0), std::size_t(9), std::size_t(50), std::size_t(55), std::size_t(70),
          std::size_t(100), std::size_t(113), layersEnd - 1, layersEnd, end - 1}) {
        damage(at);
        EXPECT_FALSE(cache.find("key", field.grid)) << at;
        damage(at);
        EXPECT_TRUE(cache.find("key", field.grid)) << at;
    }
}

TEST_F(HeightfieldCacheTest, TakesAFileThatIsTooShortOrTooLongForNone) {
    const std::string bytes = test::bytesOf(cache.pathOf("key"));
    const auto name = cache.pathOf("key").lexically_relative(folder.path());
    for (const std::string& wrong :
         {std::string(), bytes.substr(0, 40), bytes.substr(0, bytes.size() - 1), bytes + "x"}) {
        folder.write(name, wrong);
        EXPECT_FALSE(cache.find("key", field.grid)) << wrong.size();
    }
}

TEST_F(HeightfieldCacheTest, RefusesAHeightfieldWithoutAllItsCells) {
    Heightfield half = field;
    half.topCenter.pop_back();
    const auto stored = cache.store("half", half);
    ASSERT_FALSE(stored);
    EXPECT_EQ(stored.error().code, ErrorCode::Refused);
    EXPECT_FALSE(std::filesystem::exists(cache.pathOf("half")));
}

TEST_F(HeightfieldCacheTest, KeepsTheThreeNewestOnly) {
    const auto longAgo = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    std::filesystem::last_write_time(cache.pathOf("key"), longAgo);
    for (const char* key : {"b", "c", "d"}) {
        ASSERT_TRUE(cache.store(key, field));
    }
    EXPECT_FALSE(cache.find("key", field.grid));
    for (const char* key : {"b", "c", "d"}) {
        EXPECT_TRUE(cache.find(key, field.grid)) << key;
    }
}

TEST_F(HeightfieldCacheTest, SaysWhyNothingCanBeStored) {
    folder.write("file", "not a folder");
    const auto stored = HeightfieldCache(folder / "file").store("key", field);
    ASSERT_FALSE(stored);
    EXPECT_EQ(stored.error().code, ErrorCode::WriteFailed);
}

}  // namespace
}  // namespace reflet
