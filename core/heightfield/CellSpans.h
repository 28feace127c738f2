// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

/// A solid stretch of the column over a cell: closed, [low, high], metres in the project frame.
struct HeightSpan {
    float low = 0.0F;                             ///< -infinity: it reaches down into the ground
    float high = 0.0F;                            ///< >= low
    CityObjectType kind = CityObjectType::Other;  ///< of the object whose surface is the top
    bool hollow = false;  ///< a mere surface: the model does not say how thick it is

    friend bool operator==(const HeightSpan&, const HeightSpan&) = default;
};

/// A set of cells with their ranks: a bit a cell, and four bytes for each 64 of them.
class CellMask {
public:
    CellMask() = default;
    /// words: bit c % 64 of word c / 64 says whether cell c belongs to the set.
    explicit CellMask(std::vector<std::uint64_t> words);

    [[nodiscard]] bool has(std::size_t cell) const {
        return (m_words[cell >> 6U] >> (cell & 63U) & 1U) != 0;
    }
    /// The number of cells in the set before this one, which need not be in it.
    [[nodiscard]] std::uint32_t rank(std::size_t cell) const {
        const std::uint64_t before = (std::uint64_t(1) << (cell & 63U)) - 1U;
        return m_before[cell >> 6U] + std::uint32_t(std::popcount(m_words[cell >> 6U] & before));
    }
    [[nodiscard]] std::uint32_t count() const { return m_before.empty() ? 0 : m_before.back(); }
    [[nodiscard]] std::vector<std::uint32_t> cells() const;  ///< ascending

    friend bool operator==(const CellMask&, const CellMask&) = default;

private:
    std::vector<std::uint64_t> m_words;
    std::vector<std::uint32_t> m_before;  ///< one for each word, and the total
};

/// The columns of a grid that are not simply solid up to the top layer. Only they take memory, but
/// for a fifth of a byte for each cell of a grid that has any.
class CellSpans {
public:
    CellSpans() = default;  ///< no such column
    /// cells ascending, of a grid of `cellCount`; spans of cells[n] are [first[n], first[n + 1]),
    /// ascending, at least one, with gaps between them; the first reaches down to -infinity.
    CellSpans(std::size_t cellCount, const std::vector<std::uint32_t>& cells,
              std::vector<std::uint32_t> first, std::vector<HeightSpan> spans);

    [[nodiscard]] bool empty() const { return m_spans.empty(); }
    /// Empty for a column that is solid up to the top layer.
    [[nodiscard]] std::span<const HeightSpan> at(std::size_t cell) const {
        if (m_spans.empty() || !m_mask.has(cell))
            return {};
        const std::uint32_t n = m_mask.rank(cell);
        return std::span(m_spans).subspan(m_first[n], m_first[n + 1] - m_first[n]);
    }
    [[nodiscard]] std::vector<std::uint32_t> cells() const { return m_mask.cells(); }
    [[nodiscard]] const std::vector<std::uint32_t>& first() const { return m_first; }
    [[nodiscard]] const std::vector<HeightSpan>& spans() const { return m_spans; }

    friend bool operator==(const CellSpans&, const CellSpans&) = default;

private:
    CellMask m_mask;
    std::vector<std::uint32_t> m_first;
    std::vector<HeightSpan> m_spans;
};

}  // namespace reflet
