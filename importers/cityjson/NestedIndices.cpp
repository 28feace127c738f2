// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/NestedIndices.h"

#include <algorithm>

namespace reflet::cityjson {

namespace {

/// Walks boundaries and values side by side down to a level of units (surfaces or rings). Both
/// are stored in the order of the file, so one cursor a level is all the state that is needed.
class SideBySide {
public:
    SideBySide(const NestedIndices& boundaries, const NestedIndices& values, int unitLevel,
               Alignment& result)
        : m_boundaries(boundaries), m_values(values), m_unitLevel(unitLevel), m_result(result) {}

    void walk(int level, bool inBoundaries, bool inValues) {
        const std::uint32_t wanted = inBoundaries ? next(m_boundaries, m_boundaryCursor, level) : 0;
        std::uint32_t given = inValues ? next(m_values, m_valueCursor, level) : 0;
        const bool isNull = given == NestedIndices::kNullArray;
        if (isNull)
            given = 0;
        if (inBoundaries && inValues && !isNull && wanted != given)
            m_result.mismatch = true;
        for (std::uint32_t i = 0; i < std::max(wanted, given); ++i) {
            if (level + 1 < m_unitLevel)
                walk(level + 1, i < wanted, i < given);
            else
                unit(i < wanted, i < given);
        }
    }

private:
    static std::uint32_t next(const NestedIndices& nested,
                              std::array<std::size_t, NestedIndices::kMaxDepth>& cursor,
                              int level) {
        const auto at = static_cast<std::size_t>(level);
        const auto& counts = nested.counts[at];
        return cursor[at] < counts.size() ? counts[cursor[at]++] : NestedIndices::kNullArray;
    }

    void unit(bool inBoundaries, bool inValues) {
        std::uint32_t first = kNullIndex;
        std::uint32_t count = 0;
        if (inValues && m_values.depth == m_unitLevel) {  // one leaf for the unit
            first = m_leaf < m_values.leaves.size() ? m_values.leaves[m_leaf++] : kNullIndex;
        } else if (inValues) {  // an array of leaves for the unit
            const std::uint32_t leaves = next(m_values, m_valueCursor, m_unitLevel);
            if (leaves != NestedIndices::kNullArray) {
                first = static_cast<std::uint32_t>(m_leaf);
                count = leaves;
                m_leaf += leaves;
            }
        }
        if (!inBoundaries)
            return;
        m_result.first.push_back(first);
        m_result.count.push_back(count);
    }

    const NestedIndices& m_boundaries;
    const NestedIndices& m_values;
    int m_unitLevel;
    Alignment& m_result;
    std::array<std::size_t, NestedIndices::kMaxDepth> m_boundaryCursor{};
    std::array<std::size_t, NestedIndices::kMaxDepth> m_valueCursor{};
    std::size_t m_leaf = 0;
};

Alignment align(const NestedIndices& boundaries, const NestedIndices& values, int unitLevel) {
    Alignment result;
    SideBySide(boundaries, values, unitLevel, result).walk(0, true, !values.counts[0].empty());
    return result;
}

}  // namespace

Alignment alignSurfaces(const NestedIndices& boundaries, const NestedIndices& values) {
    return align(boundaries, values, boundaries.depth - 2);
}

Alignment alignRings(const NestedIndices& boundaries, const NestedIndices& values) {
    return align(boundaries, values, boundaries.depth - 1);
}

}  // namespace reflet::cityjson
