// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"
#include "core/io/SightCache.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

namespace reflet {
namespace {

Sight sightOf(std::initializer_list<unsigned char> cells) {
    Sight sight;
    sight.map = std::string(32, 'a');
    sight.seen.grid = {{1.5, -2.0, 0.25}, 4.0, {int(cells.size()) / 2, 2, 1}};
    sight.seen.cells = cells;
    sight.content = 0xfedcba9876543210U;
    return sight;
}

TEST(SightCacheTest, GivesBackWhatWasStored) {
    const test::TemporaryFolder folder;
    const SightCache cache(folder.path());
    EXPECT_TRUE(cache.find("key").empty());
    for (const Sight& sight : {sightOf({0, 1, 1, 0, 0, 1}), sightOf({1, 1, 1, 1}), sightOf({0, 0}),
                               sightOf({1, 0, 1, 0, 1, 0, 1, 0})}) {
        ASSERT_TRUE(cache.store("key", sight));
        const auto found = cache.find("key");
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found[0].map, sight.map);
        EXPECT_EQ(found[0].seen.grid, sight.seen.grid);
        EXPECT_EQ(found[0].seen.cells, sight.seen.cells);
        EXPECT_EQ(found[0].content, sight.content);
    }
}

TEST(SightCacheTest, ADamagedFileCountsAsAbsent) {
    const test::TemporaryFolder folder;
    const SightCache cache(folder.path());
    ASSERT_TRUE(cache.store("key", sightOf({0, 1, 1, 0, 0, 1})));
    const auto path = cache.pathOf("key", std::string(32, 'a'));
    const std::string bytes = *readFile(path, 10'000);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = char(damaged[i] ^ 0x20);
        ASSERT_TRUE(writeFileAtomically(path, damaged));
        EXPECT_TRUE(cache.find("key").empty()) << "byte " << i;
        ASSERT_TRUE(writeFileAtomically(path, bytes.substr(0, i)));
        EXPECT_TRUE(cache.find("key").empty()) << i << " bytes";
    }
}

TEST(SightCacheTest, KeepsTheLastFewOfAKey) {
    const test::TemporaryFolder folder;
    const SightCache cache(folder.path());
    Sight sight = sightOf({0, 1});
    const auto start = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    for (int i = 0; i < 6; ++i) {
        sight.map = std::string(32, char('a' + i));
        ASSERT_TRUE(cache.store("key", sight));
        std::filesystem::last_write_time(cache.pathOf("key", sight.map),
                                         start + std::chrono::minutes(i));
    }
    const auto found = cache.find("key");
    ASSERT_EQ(found.size(), SightCache::kKept);
    EXPECT_EQ(found.front().map, std::string(32, 'f'));
    EXPECT_EQ(found.back().map, std::string(32, 'c'));
    EXPECT_TRUE(cache.find("other").empty());
}

TEST(SightCacheTest, RefusesWhatIsNotComplete) {
    const test::TemporaryFolder folder;
    const SightCache cache(folder.path());
    Sight sight = sightOf({0, 1});
    sight.seen.cells.pop_back();
    EXPECT_FALSE(cache.store("key", sight));
    sight = sightOf({0, 1});
    sight.map = "short";
    EXPECT_FALSE(cache.store("key", sight));
}

}  // namespace
}  // namespace reflet
