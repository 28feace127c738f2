// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/TriangleRaster.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

// What the layers of a heightfield cut triangles with. Internal to core/heightfield.

namespace reflet {

/// A point of a triangle, seen from the south.
struct ProfilePoint {
    double x = 0.0;
    double z = 0.0;
};

/// The corners of the part of a triangle between two lines of constant y: 5 at most.
struct ProfilePoints {
    std::array<ProfilePoint, 5> point;
    int count = 0;

    void add(const ProfilePoint& p) { point[std::size_t(count++)] = p; }
};

/// A triangle's corners from south to north, and how lines of constant y cut it.
class TriangleCuts {
public:
    explicit TriangleCuts(const TriangleCorners& triangle) : m_corner(triangle) {
        auto& [south, middle, north] = m_corner;
        if (middle.y < south.y)
            std::swap(south, middle);
        if (north.y < middle.y)
            std::swap(middle, north);
        if (middle.y < south.y)
            std::swap(south, middle);
    }

    /// Adds the points where the line crosses the edges between their ends.
    void addCrossings(double y, ProfilePoints& points) const {
        const auto& [south, middle, north] = m_corner;
        if (!(south.y < y && y < north.y))
            return;
        points.add(crossing(south, north, y));
        if (y < middle.y)
            points.add(crossing(south, middle, y));
        else if (middle.y < y)
            points.add(crossing(middle, north, y));
    }

    /// Adds the corners that lie between two lines or on them.
    void addCorners(double from, double to, ProfilePoints& points) const {
        for (const glm::dvec3& corner : m_corner) {
            if (from <= corner.y && corner.y <= to)
                points.add({corner.x, corner.z});
        }
    }

    /// The least and the greatest x of the closed triangle along a line; nothing (from > to) where
    /// the line passes it by. Not for triangles all of whose points have one y.
    [[nodiscard]] std::pair<double, double> range(double y) const {
        const auto& [south, middle, north] = m_corner;
        if (!(south.y <= y && y <= north.y))
            return {1.0, -1.0};
        const double a = crossing(south, north, y).x;
        const double b = y > middle.y         ? crossing(middle, north, y).x
                         : south.y < middle.y ? crossing(south, middle, y).x
                                              : middle.x;
        return {std::min(a, b), std::max(a, b)};
    }

private:
    /// From the southern end northwards, so that the same edge gives the same point in both
    /// triangles beside it; clamped to the edge's own range, so that a level edge stays level and
    /// no point leaves the triangle's box.
    static ProfilePoint crossing(const glm::dvec3& a, const glm::dvec3& b, double y) {
        const double s = (y - a.y) / (b.y - a.y);
        return {between(a.x, b.x, s), between(a.z, b.z, s)};
    }
    static double between(double a, double b, double s) {
        return std::clamp(a + s * (b - a), std::min(a, b), std::max(a, b));
    }

    TriangleCorners m_corner;
};

/// The upper border of the part of a triangle over a row of cells, seen from the south: a concave
/// line above [west, east]. Its highest point over a stretch of x is the highest of the triangle's
/// points there, whether the triangle is upright, level, or shrunk to a segment or a point.
class UpperProfile {
public:
    /// points: one at least.
    explicit UpperProfile(ProfilePoints points) {
        sort(points);
        for (int n = 0; n < points.count; ++n)
            add(points.point[std::size_t(n)]);
        for (int n = 1; n < m_count; ++n) {
            if (at(n).z > at(m_peak).z)
                m_peak = n;
        }
    }

    [[nodiscard]] double west() const { return m_point[0].x; }
    [[nodiscard]] double east() const { return at(m_count - 1).x; }
    [[nodiscard]] double highest() const { return at(m_peak).z; }
    /// Over [from, to], which must touch [west, east].
    [[nodiscard]] double highest(double from, double to) const {
        const ProfilePoint& peak = at(m_peak);
        return to < peak.x ? heightAt(to) : from > peak.x ? heightAt(from) : peak.z;
    }

private:
    [[nodiscard]] const ProfilePoint& at(int n) const { return m_point[std::size_t(n)]; }

    static void sort(ProfilePoints& points) {
        for (int n = 1; n < points.count; ++n) {
            const ProfilePoint p = points.point[std::size_t(n)];
            int k = n;
            for (; k > 0 && isBefore(p, points.point[std::size_t(k - 1)]); --k)
                points.point[std::size_t(k)] = points.point[std::size_t(k - 1)];
            points.point[std::size_t(k)] = p;
        }
    }
    static bool isBefore(const ProfilePoint& a, const ProfilePoint& b) {
        return a.x < b.x || (a.x == b.x && a.z < b.z);
    }

    /// Andrew 1979: drops what lies on or below the line to the new point. Of points above one
    /// another the highest comes last and stays.
    void add(const ProfilePoint& p) {
        while (m_count > 0 && at(m_count - 1).x == p.x)
            --m_count;
        while (m_count > 1 && !isAbove(at(m_count - 1), at(m_count - 2), p))
            --m_count;
        m_point[std::size_t(m_count++)] = p;
    }
    static bool isAbove(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
        return (p.z - a.z) * (b.x - a.x) > (b.z - a.z) * (p.x - a.x);
    }

    [[nodiscard]] double heightAt(double x) const {
        int n = 1;
        while (n < m_count - 1 && at(n).x < x)
            ++n;
        const ProfilePoint& a = at(n - 1);
        const ProfilePoint& b = at(n);
        const double z = a.z + (x - a.x) / (b.x - a.x) * (b.z - a.z);
        return std::clamp(z, std::min(a.z, b.z), std::max(a.z, b.z));
    }

    std::array<ProfilePoint, 5> m_point;  ///< ascending in x
    int m_count = 0;
    int m_peak = 0;
};

/// Calls visit(j, points) for each of those rows that the closed triangle touches, with the corners
/// of the part of the triangle over it.
template <class Visit>
void visitRows(const GridPlan& plan, const TriangleCorners& triangle, CellRange rows,
               const Visit& visit) {
    if (rows.first >= rows.last)
        return;
    const TriangleCuts cuts(triangle);
    ProfilePoints points;
    cuts.addCrossings(plan.rows.border[std::size_t(rows.first)], points);
    for (int j = rows.first; j < rows.last; ++j) {
        const double south = plan.rows.border[std::size_t(j)];
        const double north = plan.rows.border[std::size_t(j) + 1];
        ProfilePoints next;
        cuts.addCrossings(north, next);
        for (int n = 0; n < next.count; ++n)
            points.add(next.point[std::size_t(n)]);
        cuts.addCorners(south, north, points);
        if (points.count > 0)
            visit(j, points);
        points = next;
    }
}

/// Calls visit(i, j, low, high) for each cell of those rows that the closed triangle touches and
/// for which wanted(i, j) holds, with the lowest and the highest height of the triangle over the
/// closed cell.
template <class Wanted, class Visit>
void visitPieces(const GridPlan& plan, const TriangleCorners& triangle, CellRange rows,
                 const Wanted& wanted, const Visit& visit) {
    visitRows(plan, triangle, rows, [&](int j, const ProfilePoints& points) {
        const auto begin = points.point.begin(), end = begin + points.count;
        const auto [west, east] = std::minmax_element(
            begin, end, [](const ProfilePoint& a, const ProfilePoint& b) { return a.x < b.x; });
        const CellRange range = touchedCells(plan.columns, west->x, east->x);
        std::optional<std::pair<UpperProfile, UpperProfile>> profiles;  // the lower one mirrored
        for (int i = range.first; i < range.last; ++i) {
            if (!wanted(i, j))
                continue;
            if (!profiles) {
                ProfilePoints mirrored = points;
                for (int n = 0; n < points.count; ++n)
                    mirrored.point[std::size_t(n)].z *= -1.0;
                profiles.emplace(UpperProfile(points), UpperProfile(mirrored));
            }
            const double from = plan.columns.border[std::size_t(i)];
            const double to = plan.columns.border[std::size_t(i) + 1];
            visit(i, j, -profiles->second.highest(from, to), profiles->first.highest(from, to));
        }
    });
}

/// Twice the signed area of (a, b, p), seen from above. Always computed from the edge's lesser
/// end, so that two triangles on either side of an edge get the same number with opposite signs:
/// no point between them can be outside of both.
class EdgeSide {
public:
    EdgeSide(const glm::dvec3& a, const glm::dvec3& b) {
        const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
        const glm::dvec3& p = swapped ? b : a;
        const glm::dvec3& q = swapped ? a : b;
        m_x = p.x;
        m_y = p.y;
        m_dx = q.x - p.x;
        m_dy = q.y - p.y;
        m_sign = swapped ? -1.0 : 1.0;
    }

    /// Exchanges the sides.
    void turn() { m_sign = -m_sign; }
    [[nodiscard]] double operator()(double x, double y) const {
        return m_sign * (m_dx * (y - m_y) - m_dy * (x - m_x));
    }

private:
    double m_x, m_y, m_dx, m_dy, m_sign;
};

inline double side(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
    return EdgeSide(a, b)(x, y);
}

}  // namespace reflet
