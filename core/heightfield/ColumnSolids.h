// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/CellSpans.h"
#include "core/heightfield/HeightRules.h"

#include <compare>
#include <span>
#include <vector>

// What stands in one column, told from the surfaces that touch it. Internal to core/heightfield.

namespace reflet {

/// What one triangle leaves in one cell. Ordered so that objects and kinds lie together and each
/// is read from above; equal records may be exchanged, so the order says all.
struct SpanRecord {
    enum class Kind : std::uint8_t { Crossing, Piece };

    std::uint32_t object = 0;
    Kind kind = Kind::Piece;
    HeightPolicy policy = HeightPolicy::None;
    std::uint8_t beside = 0;  ///< of a crossing: CenterCrossing
    std::int8_t facing = 0;   ///< of a crossing
    /// A crossing: the height at the cell's centre, twice. A piece: its lowest height rounded down
    /// and its highest rounded up.
    float low = 0.0F;
    float high = 0.0F;

    [[nodiscard]] friend bool operator<(const SpanRecord& a, const SpanRecord& b) {
        if (a.object != b.object)
            return a.object < b.object;
        if (a.kind != b.kind)
            return a.kind < b.kind;
        if (a.high != b.high)
            return a.high > b.high;
        if (a.low != b.low)
            return a.low > b.low;
        return a.facing != b.facing ? a.facing > b.facing : a.beside < b.beside;
    }
};

/// The layers' heights of a cell.
struct ColumnHeights {
    float ground = 0.0F;  ///< not missing
    float topMax = 0.0F;
    float topCenter = 0.0F;
};

/// The solid stretches of one column, at its centre and over its closed cell; empty for one that
/// is solid up to the layer's height.
struct ColumnSpans {
    std::vector<HeightSpan> center;
    std::vector<HeightSpan> maximum;
    bool tunnel = false;  ///< one is among what stands here
};

/// records: sorted; all of one cell.
///
/// At the centre, an object is solid where the line of sight from above has entered it more often
/// than left it, or the other way round (its shell is inside out). Over the closed cell, a height
/// at which there is no surface anywhere in the cell is solid just when the centre is: so the
/// pieces' ranges and the centre's solids make up the column, exactly.
[[nodiscard]] ColumnSpans solidsOf(std::span<const SpanRecord> records,
                                   const ColumnHeights& heights, const CityModel& city,
                                   double clearance);

}  // namespace reflet
