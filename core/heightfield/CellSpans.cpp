// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/CellSpans.h"

#include <cassert>
#include <utility>

namespace reflet {

CellMask::CellMask(std::vector<std::uint64_t> words) : m_words(std::move(words)) {
    m_before.reserve(m_words.size() + 1);
    std::uint32_t before = 0;
    for (const std::uint64_t word : m_words) {
        m_before.push_back(before);
        before += std::uint32_t(std::popcount(word));
    }
    m_before.push_back(before);
    m_words.push_back(0);  // rank() may ask for the end
}

std::vector<std::uint32_t> CellMask::cells() const {
    std::vector<std::uint32_t> cells;
    cells.reserve(count());
    for (std::size_t w = 0; w < m_words.size(); ++w) {
        for (std::uint64_t word = m_words[w]; word != 0; word &= word - 1)
            cells.push_back(std::uint32_t(64 * w) + std::uint32_t(std::countr_zero(word)));
    }
    return cells;
}

CellSpans::CellSpans(std::size_t cellCount, const std::vector<std::uint32_t>& cells,
                     std::vector<std::uint32_t> first, std::vector<HeightSpan> spans)
    : m_first(std::move(first)), m_spans(std::move(spans)) {
    assert(m_first.size() == cells.size() + 1 && m_first.back() == m_spans.size());
    if (m_spans.empty()) {
        m_first.clear();
        return;
    }
    std::vector<std::uint64_t> words(cellCount / 64 + 1, 0);
    for (const std::uint32_t cell : cells)
        words[cell / 64] |= std::uint64_t(1) << (cell % 64);
    m_mask = CellMask(std::move(words));
}

}  // namespace reflet
