// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TriangleRaster.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

/// A convex polygon in space; a triangle clipped by four half-planes has at most 7 corners.
struct Piece {
    std::array<glm::dvec3, 8> corner;
    int count = 0;

    void add(const glm::dvec3& p) { corner[std::size_t(count++)] = p; }
    [[nodiscard]] double lowest(int axis) const {
        double value = corner[0][axis];
        for (int n = 1; n < count; ++n) {
            value = std::min(value, corner[std::size_t(n)][axis]);
        }
        return value;
    }
    [[nodiscard]] double highest(int axis) const {
        double value = corner[0][axis];
        for (int n = 1; n < count; ++n) {
            value = std::max(value, corner[std::size_t(n)][axis]);
        }
        return value;
    }
};

/// Where the edge crosses the line p[axis] == line. From its lower end upwards, so that the same
/// edge gives the same point whichever way it is walked; clamped to the edge's own range, so that
/// a level edge stays level and no point leaves the triangle's box.
glm::dvec3 crossing(glm::dvec3 a, glm::dvec3 b, int axis, double line) {
    if (a[axis] > b[axis]) {
        std::swap(a, b);
    }
    const double s = (line - a[axis]) / (b[axis] - a[axis]);
    glm::dvec3 p = glm::clamp(a + s * (b - a), glm::min(a, b), glm::max(a, b));
    p[axis] = line;
    return p;
}

/// Sutherland & Hodgman 1974: the part of the piece with sign·(p[axis] - line) >= 0. Closed: what
/// only touches the line stays, as a segment or a point.
Piece clipped(const Piece& piece, int axis, double line, double sign) {
    Piece result;
    for (int n = 0; n < piece.count; ++n) {
        const glm::dvec3& a = piece.corner[std::size_t(n)];
        const glm::dvec3& b = piece.corner[std::size_t(n + 1 < piece.count ? n + 1 : 0)];
        const double sideA = sign * (a[axis] - line);
        const double sideB = sign * (b[axis] - line);
        if (sideA >= 0.0) {
            result.add(a);
        }
        if ((sideA > 0.0 && sideB < 0.0) || (sideA < 0.0 && sideB > 0.0)) {
            result.add(crossing(a, b, axis, line));
        }
    }
    return result;
}

/// The part of the piece between two lines; the piece itself when it lies there already.
Piece slab(const Piece& piece, int axis, double from, double to) {
    const bool below = piece.lowest(axis) < from;
    const bool above = piece.highest(axis) > to;
    if (!below && !above) {
        return piece;
    }
    const Piece upper = below ? clipped(piece, axis, from, 1.0) : piece;
    return above ? clipped(upper, axis, to, -1.0) : upper;
}

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

CellRange touchedCells(const GridLines& lines, double from, double to) {
    return {std::max(0, lines.nearCell(from) - 1), std::min(lines.count(), lines.nearCell(to) + 2)};
}

CellRange touchedRows(const GridPlan& plan, const TriangleCorners& triangle) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return touchedCells(plan.rows, low, high);
}

void raiseMaximum(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows) {
    Piece whole;
    for (const glm::dvec3& corner : triangle) {
        whole.add(corner);
    }
    for (int j = rows.first; j < rows.last; ++j) {
        const Piece strip =
            slab(whole, 1, plan.rows.border[std::size_t(j)], plan.rows.border[std::size_t(j) + 1]);
        if (strip.count > 0) {
            raiseRow(layer, plan.columns, strip, j);
        }
    }
}

}  // namespace reflet
