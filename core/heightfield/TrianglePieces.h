// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/TriangleRaster.h"

#include <algorithm>
#include <limits>
#include <utility>

// What the layers of a heightfield cut triangles with. Internal to core/heightfield.

namespace reflet {

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
inline glm::dvec3 crossing(glm::dvec3 a, glm::dvec3 b, int axis, double line) {
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
inline Piece clipped(const Piece& piece, int axis, double line, double sign) {
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
inline Piece slab(const Piece& piece, int axis, double from, double to) {
    const bool below = piece.lowest(axis) < from;
    const bool above = piece.highest(axis) > to;
    if (!below && !above) {
        return piece;
    }
    const Piece upper = below ? clipped(piece, axis, from, 1.0) : piece;
    return above ? clipped(upper, axis, to, -1.0) : upper;
}

inline Piece wholePiece(const TriangleCorners& triangle) {
    Piece whole;
    for (const glm::dvec3& corner : triangle) {
        whole.add(corner);
    }
    return whole;
}

/// Twice the signed area of (a, b, p), seen from above. Always computed from the edge's lesser
/// end, so that two triangles on either side of an edge get the same number with opposite signs:
/// no point between them can be outside of both.
inline double side(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
    const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
    const glm::dvec3& p = swapped ? b : a;
    const glm::dvec3& q = swapped ? a : b;
    const double area = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    return swapped ? -area : area;
}

/// x range of a triangle along the line at y.
inline std::pair<double, double> rangeAlong(const TriangleCorners& t, double y) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t n = 0; n < 3; ++n) {
        const glm::dvec3& a = t[n];
        const glm::dvec3& b = t[(n + 1) % 3];
        if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) {
            continue;
        }
        const double s = a.y == b.y ? 0.0 : (y - a.y) / (b.y - a.y);
        for (const double x : {a.x + s * (b.x - a.x), a.y == b.y ? b.x : a.x + s * (b.x - a.x)}) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
    }
    return {low, high};
}

/// Calls visit(i, j, piece) for each cell of those rows that the closed triangle touches and for
/// which wanted(i, j) holds, with the part of the triangle over the closed cell.
template <class Wanted, class Visit>
void visitPieces(const GridPlan& plan, const TriangleCorners& triangle, CellRange rows,
                 const Wanted& wanted, const Visit& visit) {
    const Piece whole = wholePiece(triangle);
    for (int j = rows.first; j < rows.last; ++j) {
        const Piece strip =
            slab(whole, 1, plan.rows.border[std::size_t(j)], plan.rows.border[std::size_t(j) + 1]);
        if (strip.count == 0) {
            continue;
        }
        const CellRange range = touchedCells(plan.columns, strip.lowest(0), strip.highest(0));
        for (int i = range.first; i < range.last; ++i) {
            if (!wanted(i, j)) {
                continue;
            }
            const auto at = std::size_t(i);
            const Piece piece =
                slab(strip, 0, plan.columns.border[at], plan.columns.border[at + 1]);
            if (piece.count > 0) {
                visit(i, j, piece);
            }
        }
    }
}

}  // namespace reflet
