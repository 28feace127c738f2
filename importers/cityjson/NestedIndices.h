// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace reflet::cityjson {

/// A null where an index was expected, and anything else that is no index.
inline constexpr std::uint32_t kNullIndex = 0xfffffffeU;
inline constexpr std::uint32_t kBadIndex = 0xffffffffU;

/// Nested arrays of equal depth with indices in the innermost, as in CityJSON's boundaries and in
/// the values of semantics, materials and textures. Arrays are listed level by level, in the order
/// of the file.
struct NestedIndices {
    static constexpr int kMaxDepth = 5;  ///< solids, shells, surfaces, rings, points
    static constexpr std::uint32_t kNullArray = 0xffffffffU;

    int depth = 0;
    /// Number of children of each array of the level; kNullArray where null stands for an array.
    std::array<std::vector<std::uint32_t>, kMaxDepth> counts;
    std::vector<std::uint32_t> leaves;
    bool malformed = false;  ///< something stood where an array was expected, or the reverse
    bool hasNullArray = false;

    void clear() {
        depth = 0;
        for (auto& level : counts)
            level.clear();
        leaves.clear();
        malformed = false;
        hasNullArray = false;
    }
    [[nodiscard]] bool empty() const { return depth == 0; }
};

/// What `values` says about the parts of `boundaries`, one entry for each array of the level
/// `level` of the boundaries (0 = outermost), in order: the leaf itself when the values are one
/// level of arrays shallower than that, otherwise the index of the first leaf of the array that
/// matches. kNullIndex where the values are null or too short.
struct Alignment {
    std::vector<std::uint32_t> first;  ///< leaf, or index of the first leaf of the part
    std::vector<std::uint32_t> count;  ///< leaves of the part; empty for single leaves
    bool mismatch = false;             ///< the values have too few or too many entries somewhere
};

/// Values with one leaf for each surface: boundaries of depth d, values of depth d - 2.
[[nodiscard]] Alignment alignSurfaces(const NestedIndices& boundaries, const NestedIndices& values);
/// Values with one array for each ring: boundaries and values of depth d.
[[nodiscard]] Alignment alignRings(const NestedIndices& boundaries, const NestedIndices& values);

}  // namespace reflet::cityjson
