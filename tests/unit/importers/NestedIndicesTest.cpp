// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/NestedIndices.h"

#include <gtest/gtest.h>

namespace reflet::cityjson {

namespace {

constexpr std::uint32_t kNo = NestedIndices::kNullArray;

/// Two shells, of two surfaces and of one; the first surface has a hole.
NestedIndices twoShells() {
    NestedIndices nested;
    nested.depth = 4;
    nested.counts[0] = {2};
    nested.counts[1] = {2, 1};
    nested.counts[2] = {2, 1, 1};
    nested.counts[3] = {4, 3, 3, 5};
    nested.leaves.resize(15);
    return nested;
}

NestedIndices semantics(std::vector<std::uint32_t> top, std::vector<std::uint32_t> shells,
                        std::vector<std::uint32_t> leaves) {
    NestedIndices nested;
    nested.depth = 2;
    nested.counts[0] = std::move(top);
    nested.counts[1] = std::move(shells);
    nested.leaves = std::move(leaves);
    return nested;
}

using Indices = std::vector<std::uint32_t>;

}  // namespace

TEST(NestedIndices, ValuesMeetTheirSurfaces) {
    const Alignment alignment = alignSurfaces(twoShells(), semantics({2}, {2, 1}, {7, 8, 9}));
    EXPECT_EQ(alignment.first, (Indices{7, 8, 9}));
    EXPECT_FALSE(alignment.mismatch);
}

TEST(NestedIndices, NullForAShellLeavesTheNextShellInPlace) {
    const Alignment alignment = alignSurfaces(twoShells(), semantics({2}, {kNo, 1}, {9}));
    EXPECT_EQ(alignment.first, (Indices{kNullIndex, kNullIndex, 9}));
    EXPECT_FALSE(alignment.mismatch);
}

TEST(NestedIndices, TooFewAndTooManyValuesDoNotShiftTheRest) {
    const Alignment few = alignSurfaces(twoShells(), semantics({2}, {1, 1}, {7, 9}));
    EXPECT_EQ(few.first, (Indices{7, kNullIndex, 9}));
    EXPECT_TRUE(few.mismatch);
    const Alignment many =
        alignSurfaces(twoShells(), semantics({3}, {4, 1, 2}, {7, 8, 1, 1, 9, 1, 1}));
    EXPECT_EQ(many.first, (Indices{7, 8, 9}));
    EXPECT_TRUE(many.mismatch);
}

TEST(NestedIndices, ArraysMeetTheirRings) {
    NestedIndices values;
    values.depth = 4;
    values.counts[0] = {2};
    values.counts[1] = {2, 1};
    values.counts[2] = {2, kNo, 1};
    values.counts[3] = {5, 4, 1};
    values.leaves.resize(10);
    const Alignment alignment = alignRings(twoShells(), values);
    EXPECT_EQ(alignment.first, (Indices{0, 5, kNullIndex, 9}));
    EXPECT_EQ(alignment.count, (Indices{5, 4, 0, 1}));
    EXPECT_FALSE(alignment.mismatch);
}

TEST(NestedIndices, NoValuesAreAllNull) {
    NestedIndices none;
    none.depth = 2;
    EXPECT_EQ(alignSurfaces(twoShells(), none).first,
              (Indices{kNullIndex, kNullIndex, kNullIndex}));
}

}  // namespace reflet::cityjson
