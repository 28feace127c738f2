// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TrianglePieces.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

void raiseRow(RisingLayer& layer, const GridLines& columns, const Piece& strip, int j) {
    const float stripHighest = roundedUp(strip.highest(2));
    const CellRange range = touchedCells(columns, strip.lowest(0), strip.highest(0));
    for (int i = range.first; i < range.last; ++i) {
        if (layer.at(i, j) >= stripHighest) {
            continue;
        }
        const Piece piece =
            slab(strip, 0, columns.border[std::size_t(i)], columns.border[std::size_t(i) + 1]);
        if (piece.count > 0) {
            layer.raise(i, j, roundedUp(piece.highest(2)));
        }
    }
}

}  // namespace

float roundedUp(double value) {
    const auto nearest = float(value);
    return double(nearest) < value ? std::nextafter(nearest, kInfinity) : nearest;
}

float roundedDown(double value) {
    const auto nearest = float(value);
    return double(nearest) > value ? std::nextafter(nearest, -kInfinity) : nearest;
}

CellRange touchedCells(const GridLines& lines, double from, double to) {
    return {std::max(0, lines.nearCell(from) - 1), std::min(lines.count(), lines.nearCell(to) + 2)};
}

CellRange touchedRows(const GridPlan& plan, const TriangleCorners& triangle) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return touchedCells(plan.rows, low, high);
}

void raiseMaximum(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows) {
    const Piece whole = wholePiece(triangle);
    for (int j = rows.first; j < rows.last; ++j) {
        const Piece strip =
            slab(whole, 1, plan.rows.border[std::size_t(j)], plan.rows.border[std::size_t(j) + 1]);
        if (strip.count > 0) {
            raiseRow(layer, plan.columns, strip, j);
        }
    }
}

}  // namespace reflet
