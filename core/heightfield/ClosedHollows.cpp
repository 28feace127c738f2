// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/ClosedHollows.h"

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

using Column = std::span<const HeightSpan>;

/// The air between two solids of a column, or above all of them.
struct Gap {
    float low = 0.0F;
    float high = kInfinity;
};

Gap gapAbove(Column column, std::size_t n) {
    return {column[n].high, column[n + 1].low};
}

double overlap(const Gap& a, const Gap& b) {
    return double(std::min(a.high, b.high)) - double(std::max(a.low, b.low));
}

std::vector<std::uint64_t> wordsOf(std::size_t cellCount, const std::vector<std::uint32_t>& cells) {
    std::vector<std::uint64_t> words(cellCount / 64 + 1, 0);
    for (const std::uint32_t cell : cells)
        words[cell / 64] |= std::uint64_t(1) << (cell % 64);
    return words;
}

/// Which gaps of the conservative columns the open air reaches.
class Air {
public:
    Air(const Heightfield& field, double clearance, const std::vector<std::uint32_t>& open)
        : m_field(field),
          m_opening(0.5 * clearance),
          m_cells(field.spans.cells()),
          m_listed(wordsOf(field.grid.cellCount(), m_cells)),
          m_reached(field.spans.spans().size(), 0) {
        for (const std::uint32_t cell : open) {
            for (std::size_t n = 0; n + 1 < column(cell).size(); ++n)
                reach(cell, n);
        }
        for (const std::uint32_t cell : m_cells) {
            for (std::size_t n = 0; n + 1 < column(cell).size(); ++n) {
                if (touchesOpenAir(cell, gapAbove(column(cell), n)))
                    reach(cell, n);
            }
        }
        flow();
    }

    [[nodiscard]] const std::vector<std::uint32_t>& cells() const { return m_cells; }
    [[nodiscard]] Column column(std::size_t cell) const { return m_field.spans.at(cell); }
    /// Whether air reaches the gap above the n-th solid of a cell.
    [[nodiscard]] bool reached(std::size_t cell, std::size_t n) const {
        return m_reached[place(cell, n)] != 0;
    }
    /// Whether the cell has a gap beside this one that is reached, or that is not.
    [[nodiscard]] bool has(std::size_t cell, const Gap& gap, bool reachedOnes) const {
        const Column of = column(cell);
        for (std::size_t n = 0; n + 1 < of.size(); ++n) {
            if (overlap(gapAbove(of, n), gap) > 0.0 && reached(cell, n) == reachedOnes)
                return true;
        }
        return false;
    }

private:
    [[nodiscard]] std::size_t place(std::size_t cell, std::size_t n) const {
        return m_field.spans.first()[m_listed.rank(cell)] + n;
    }
    void reach(std::uint32_t cell, std::size_t n) {
        char& mark = m_reached[place(cell, n)];
        if (mark == 0)
            m_front.emplace_back(cell, std::uint32_t(n));
        mark = 1;
    }

    /// Calls visit(cell) for the four cells beside; false for one that is not in the grid.
    template <class Visit>
    bool beside(std::uint32_t cell, const Visit& visit) const {
        const GridSpec& grid = m_field.grid;
        const int i = int(cell % std::uint32_t(grid.columns));
        const int j = int(cell / std::uint32_t(grid.columns));
        bool inside = true;
        for (const auto& [x, y] : {std::pair{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}}) {
            if (grid.contains(x, y))
                visit(std::uint32_t(grid.index(x, y)));
            else
                inside = false;
        }
        return inside;
    }

    [[nodiscard]] bool touchesOpenAir(std::uint32_t cell, const Gap& gap) const {
        bool open = false;
        const bool inside = beside(cell, [&](std::uint32_t other) {
            const Column of = column(other);
            const float top = of.empty() ? m_field.topMax[other] : of.back().high;
            open = open || isMissing(top) || overlap({top, kInfinity}, gap) > m_opening;
        });
        return open || !inside;
    }

    void flow() {
        while (!m_front.empty()) {
            const auto [cell, n] = m_front.back();
            m_front.pop_back();
            const Gap gap = gapAbove(column(cell), n);
            beside(cell, [&](std::uint32_t other) {
                const Column of = column(other);
                for (std::size_t k = 0; k + 1 < of.size(); ++k) {
                    if (overlap(gapAbove(of, k), gap) > m_opening)
                        reach(other, k);
                }
            });
        }
    }

    const Heightfield& m_field;
    double m_opening;
    std::vector<std::uint32_t> m_cells;
    CellMask m_listed;
    std::vector<char> m_reached;  ///< by the span below the gap
    std::vector<std::pair<std::uint32_t, std::uint32_t>> m_front;
};

/// Whether a hollow at a cell's centre is open.
bool isOpen(const Air& air, const GridSpec& grid, std::uint32_t cell, const Gap& gap) {
    if (air.has(cell, gap, true))
        return true;
    const int i = int(cell % std::uint32_t(grid.columns));
    const int j = int(cell / std::uint32_t(grid.columns));
    bool open = false;
    for (int y = j - 1; y <= j + 1; ++y) {
        for (int x = i - 1; x <= i + 1; ++x) {
            if (!grid.contains(x, y))
                continue;
            if (air.has(grid.index(x, y), gap, false))
                return false;
            open = open || air.has(grid.index(x, y), gap, true);
        }
    }
    return open;
}

/// The columns with the gaps filled that keep(cell, n, gap) does not keep.
template <class Keep>
CellSpans filled(const CellSpans& columns, std::size_t cellCount, const Keep& keep) {
    std::vector<std::uint32_t> cells, first{0};
    std::vector<HeightSpan> spans;
    for (const std::uint32_t cell : columns.cells()) {
        const Column column = columns.at(cell);
        const std::size_t begin = spans.size();
        spans.push_back(column.front());
        for (std::size_t n = 1; n < column.size(); ++n) {
            if (keep(cell, n - 1, gapAbove(column, n - 1))) {
                spans.push_back(column[n]);
                continue;
            }
            spans.back().high = column[n].high;
            spans.back().kind = column[n].kind;
            spans.back().hollow = false;
        }
        // One that was a single solid before is not what the top layer says.
        if (spans.size() == begin + 1 && column.size() > 1) {
            spans.pop_back();
            continue;
        }
        cells.push_back(cell);
        first.push_back(std::uint32_t(spans.size()));
    }
    return {cellCount, cells, std::move(first), std::move(spans)};
}

}  // namespace

void fillClosedHollows(Heightfield& field, double clearance,
                       const std::vector<std::uint32_t>& open) {
    const Air air(field, clearance, open);
    const std::size_t count = field.grid.cellCount();
    CellSpans centers =
        filled(field.centerSpans, count, [&](std::uint32_t cell, std::size_t, const Gap& gap) {
            return std::binary_search(open.begin(), open.end(), cell) ||
                   isOpen(air, field.grid, cell, gap);
        });
    field.spans = filled(field.spans, count, [&](std::uint32_t cell, std::size_t n, const Gap&) {
        return air.reached(cell, n);
    });
    field.centerSpans = std::move(centers);
}

}  // namespace reflet
