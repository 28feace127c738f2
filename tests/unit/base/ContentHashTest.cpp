// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ContentHash.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

namespace reflet {
namespace {

TEST(ContentHash, OfNothingIsThePublishedValueOfXxh3) {
    EXPECT_EQ(ContentHash().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, IsTheSameForTheSameInput) {
    const auto key = [] { return ContentHash().add("cell").add(0.5).add(128).hex(); };
    EXPECT_EQ(key(), key());
    EXPECT_EQ(key().size(), 32U);
    EXPECT_EQ(key().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(ContentHash, TellsApartWhereOneStringEndsAndTheNextBegins) {
    const std::set<std::string> keys = {
        ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex(),
        ContentHash().add("abc").hex(), ContentHash().add("abc").add("").hex(),
        ContentHash().add("").add("abc").hex()};
    EXPECT_EQ(keys.size(), 5U);
}

TEST(ContentHash, DependsOnOrderTypeAndEveryBitOfANumber) {
    const std::set<std::string> keys = {ContentHash().add(1).add(2).hex(),
                                        ContentHash().add(2).add(1).hex(),
                                        ContentHash().add(std::int64_t{1}).hex(),
                                        ContentHash().add(1).hex(),
                                        ContentHash().add(1.0).hex(),
                                        ContentHash().add(1.0 + 1e-16).add("").hex(),
                                        ContentHash().add(0.0).hex(),
                                        ContentHash().add(-0.0).hex()};
    EXPECT_EQ(keys.size(), 8U);
}

TEST(ContentHash, OfANumberIsThatOfItsBytes) {
    const double value = 43.6975;
    std::vector<std::byte> bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    EXPECT_EQ(ContentHash().add(value).hex(), ContentHash().addBytes(bytes).hex());
}

TEST(ContentHash, CanBeReadInBetweenAndGoesOn) {
    ContentHash running;
    running.add("first");
    EXPECT_EQ(running.hex(), ContentHash().add("first").hex());
    running.add("second");
    EXPECT_EQ(running.hex(), ContentHash().add("first").add("second").hex());
}

}  // namespace
}  // namespace reflet
