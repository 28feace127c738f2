// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/GridTriangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace reflet::terrain {

namespace {

constexpr int kBlock = 256;  ///< cells along the edge of a root square; a power of two
constexpr float kSplitAlways = std::numeric_limits<float>::infinity();

struct Post {
    int i = 0, j = 0;
};

/// A right triangle: the ends of its hypotenuse and its apex.
struct Right {
    Post a, b, c;

    /// Halved at the middle of the hypotenuse, unless that is no post.
    [[nodiscard]] bool isSmallest() const { return ((a.i + b.i) | (a.j + b.j)) % 2 != 0; }
    [[nodiscard]] Post middle() const { return {(a.i + b.i) / 2, (a.j + b.j) / 2}; }
    [[nodiscard]] Right first() const { return {c, a, middle()}; }
    [[nodiscard]] Right second() const { return {b, c, middle()}; }
};

/// Columns first..last of a row that lie in a triangle. The slopes of its edges are 0, 1, -1 or
/// none, so that both are whole numbers.
struct Span {
    int first = std::numeric_limits<int>::max();
    int last = std::numeric_limits<int>::min();

    void add(const Post& p, const Post& q, int row) {
        if (row < std::min(p.j, q.j) || row > std::max(p.j, q.j))
            return;
        if (p.j == q.j) {
            put(p.i);
            put(q.i);
            return;
        }
        put(p.i + (q.i - p.i) * (row - p.j) / (q.j - p.j));
    }

private:
    void put(int column) {
        first = std::min(first, column);
        last = std::max(last, column);
    }
};

class Triangulator {
public:
    Triangulator(const HeightGrid& grid, const JobContext& job)
        : m_grid(grid),
          m_job(job),
          m_blocksX((grid.columns - 2) / kBlock + 1),
          m_blocksY((grid.rows - 2) / kBlock + 1),
          m_width(std::size_t(m_blocksX) * kBlock + 1),
          m_error(m_width * (std::size_t(m_blocksY) * kBlock + 1), 0.0F) {}

    /// Finds, for each post, the error of not splitting there; from small triangles to large ones,
    /// because no triangle may stay whole while one within it is split.
    bool measure() {
        int depth = 0;
        for (Right t = roots(0, 0)[0]; !t.isSmallest(); t = t.first())
            ++depth;
        for (int level = depth - 1; level >= 0; --level) {
            m_job.progress(double(depth - level) / (depth + 1));
            for (int y = 0; y < m_blocksY; ++y) {
                if (m_job.cancelled())
                    return false;
                for (int x = 0; x < m_blocksX; ++x)
                    for (const Right& root : roots(x, y))
                        measureLevel(root, level);
            }
        }
        return true;
    }

    [[nodiscard]] std::size_t count(double error, std::size_t most) const {
        std::size_t total = 0;
        for (int y = 0; y < m_blocksY && total <= most; ++y)
            for (int x = 0; x < m_blocksX; ++x)
                for (const Right& root : roots(x, y))
                    visit(root, error, [&](const Right& t) { total += isKept(t) ? 1 : 0; });
        return total;
    }

    [[nodiscard]] GridTriangles triangles(double error) {
        m_out.error = error;
        m_number.assign(m_grid.heights.size(), std::numeric_limits<std::uint32_t>::max());
        for (int y = 0; y < m_blocksY; ++y) {
            for (int x = 0; x < m_blocksX; ++x) {
                m_block = std::uint32_t(y * m_blocksX + x);
                for (const Right& root : roots(x, y))
                    visit(root, error, [&](const Right& t) {
                        if (isKept(t))
                            add(t);
                    });
            }
        }
        return std::move(m_out);
    }

    /// The largest error that splitting can take away.
    [[nodiscard]] double largestError() const {
        double largest = 0.0;
        for (const float e : m_error)
            if (std::isfinite(e))
                largest = std::max(largest, double(e));
        return largest;
    }

private:
    [[nodiscard]] static std::array<Right, 2> roots(int x, int y) {
        const Post low{x * kBlock, y * kBlock};
        const Post high{low.i + kBlock, low.j + kBlock};
        return {Right{low, high, {high.i, low.j}}, Right{high, low, {low.i, high.j}}};
    }
    [[nodiscard]] float& errorAt(const Post& p) {
        return m_error[std::size_t(p.j) * m_width + std::size_t(p.i)];
    }
    [[nodiscard]] float errorAt(const Post& p) const {
        return m_error[std::size_t(p.j) * m_width + std::size_t(p.i)];
    }
    /// Beyond the rim the grid goes on as it came there, so that even ground stays even: what lies
    /// there is cut off in the end.
    [[nodiscard]] float heightAt(const Post& p) const {
        const int row = std::min(p.j, m_grid.rows - 1);
        const float z = heightInRow(p.i, row);
        const int beyond = p.j - row;
        if (beyond == 0)
            return z;
        const int back = std::max(row - beyond, 0);
        return continued(z, heightInRow(p.i, back), float(beyond) / float(row - back));
    }
    [[nodiscard]] float heightInRow(int i, int row) const {
        const int column = std::min(i, m_grid.columns - 1);
        const float z = m_grid.at(column, row);
        const int beyond = i - column;
        if (beyond == 0)
            return z;
        const int back = std::max(column - beyond, 0);
        return continued(z, m_grid.at(back, row), float(beyond) / float(column - back));
    }
    [[nodiscard]] static float continued(float z, float back, float times) {
        return std::isnan(back) ? z : z + times * (z - back);
    }
    /// Whether a part of it lies within the grid.
    [[nodiscard]] bool touches(const Right& t) const {
        return std::min({t.a.i, t.b.i, t.c.i}) < m_grid.columns - 1 &&
               std::min({t.a.j, t.b.j, t.c.j}) < m_grid.rows - 1;
    }
    /// Whether it becomes a triangle, once nothing splits it any more.
    [[nodiscard]] bool isKept(const Right& t) const {
        return !std::isnan(heightAt(t.a)) && !std::isnan(heightAt(t.b)) &&
               !std::isnan(heightAt(t.c));
    }

    void measureLevel(const Right& t, int level) {
        if (!touches(t))
            return;
        if (level > 0) {
            measureLevel(t.first(), level - 1);
            measureLevel(t.second(), level - 1);
            return;
        }
        float& error = errorAt(t.middle());
        error = std::max(error, ownError(t));
        if (!t.first().isSmallest()) {
            error = std::max({error, errorAt(t.first().middle()), errorAt(t.second().middle())});
        }
    }

    /// The largest distance of a post from the triangle; infinite where some posts are missing.
    [[nodiscard]] float ownError(const Right& t) const {
        const bool whole = isKept(t);
        const double za = heightAt(t.a);
        const double zb = heightAt(t.b);
        const double zc = heightAt(t.c);
        // z = zc + s * (a - c) + r * (b - c), and both of those stand at right angles.
        const double ai = t.a.i - t.c.i;
        const double aj = t.a.j - t.c.j;
        const double bi = t.b.i - t.c.i;
        const double bj = t.b.j - t.c.j;
        const double square = ai * ai + aj * aj;
        const double dzdi = ((za - zc) * ai + (zb - zc) * bi) / square;
        const double dzdj = ((za - zc) * aj + (zb - zc) * bj) / square;
        const int bottom = std::min(std::max({t.a.j, t.b.j, t.c.j}), m_grid.rows - 1);
        double largest = 0.0;
        bool some = false;
        bool missing = false;
        for (int j = std::min({t.a.j, t.b.j, t.c.j}); j <= bottom; ++j) {
            Span span;
            span.add(t.a, t.b, j);
            span.add(t.b, t.c, j);
            span.add(t.c, t.a, j);
            const int last = std::min(span.last, m_grid.columns - 1);
            for (int i = span.first; i <= last; ++i) {
                const double z = m_grid.at(i, j);
                if (std::isnan(z)) {
                    missing = true;
                    continue;
                }
                some = true;
                const double plane = zc + dzdi * (i - t.c.i) + dzdj * (j - t.c.j);
                largest = std::max(largest, std::abs(z - plane));
            }
        }
        if (some && (missing || !whole))
            return kSplitAlways;
        // Rounded up, so that the bound holds for the double it came from.
        return some ? std::nextafter(float(largest), kSplitAlways) : 0.0F;
    }

    template <class Each>
    void visit(const Right& t, double error, const Each& each) const {
        if (!touches(t))
            return;
        if (t.isSmallest() || !(double(errorAt(t.middle())) > error)) {
            each(t);
            return;
        }
        visit(t.first(), error, each);
        visit(t.second(), error, each);
    }

    // ---- Output ----

    struct Corner {
        double i = 0.0, j = 0.0, z = 0.0;
    };
    using Polygon = std::vector<Corner>;

    [[nodiscard]] Corner cornerOf(const Post& p) const {
        return {double(p.i), double(p.j), double(heightAt(p))};
    }

    void add(const Right& t) {
        Polygon polygon{cornerOf(t.a), cornerOf(t.b), cornerOf(t.c)};
        if (std::max({t.a.i, t.b.i, t.c.i}) > m_grid.columns - 1)
            polygon = cut(polygon, &Corner::i, m_grid.columns - 1);
        if (std::max({t.a.j, t.b.j, t.c.j}) > m_grid.rows - 1)
            polygon = cut(polygon, &Corner::j, m_grid.rows - 1);
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            m_out.triangles.push_back(
                {placeOf(polygon[0]), placeOf(polygon[k - 1]), placeOf(polygon[k])});
            m_out.block.push_back(m_block);
        }
    }

    /// The part up to `limit`. A cut edge gives the same corner bit by bit in both its triangles:
    /// it is always taken from its lower end.
    [[nodiscard]] static Polygon cut(const Polygon& polygon, double Corner::*axis, double limit) {
        Polygon kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Corner& p = polygon[k];
            const Corner& q = polygon[(k + 1) % polygon.size()];
            if (p.*axis <= limit)
                kept.push_back(p);
            if ((p.*axis < limit) == (q.*axis < limit) || p.*axis == limit || q.*axis == limit)
                continue;
            const Corner& low = p.*axis < q.*axis ? p : q;
            const Corner& high = p.*axis < q.*axis ? q : p;
            const double s = (limit - low.*axis) / (high.*axis - low.*axis);
            Corner born{low.i + s * (high.i - low.i), low.j + s * (high.j - low.j),
                        low.z + s * (high.z - low.z)};
            born.*axis = limit;
            kept.push_back(born);
        }
        return kept;
    }

    std::uint32_t placeOf(const Corner& corner) {
        const auto next = std::uint32_t(m_out.places.size());
        const auto i = int(corner.i);
        const auto j = int(corner.j);
        std::uint32_t* number = nullptr;
        if (double(i) == corner.i && double(j) == corner.j) {
            number = &m_number[std::size_t(j) * std::size_t(m_grid.columns) + std::size_t(i)];
        } else {
            number = &m_born.try_emplace({corner.i, corner.j}, kUnset).first->second;
        }
        if (*number != kUnset)
            return *number;
        *number = next;
        m_out.places.emplace_back(corner.i, corner.j);
        m_out.heights.push_back(corner.z);
        return next;
    }

    static constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
    const HeightGrid& m_grid;
    const JobContext& m_job;
    int m_blocksX, m_blocksY;
    std::size_t m_width;
    std::vector<float> m_error;  ///< of the posts, those beyond the rim included
    GridTriangles m_out;
    std::vector<std::uint32_t> m_number;
    std::map<std::pair<double, double>, std::uint32_t> m_born;
    std::uint32_t m_block = 0;
};

/// The least error (within a twentieth) that keeps to the number of triangles.
double affordableError(const Triangulator& triangulator, const Decimation& wanted) {
    const std::size_t most = wanted.mostTriangles;
    if (triangulator.count(wanted.error, most) <= most)
        return wanted.error;
    double low = std::max(wanted.error, 1e-3);
    double high = std::max(low, triangulator.largestError());
    while (high / low > 1.05) {
        const double middle = std::sqrt(low * high);
        (triangulator.count(middle, most) <= most ? high : low) = middle;
    }
    return high;
}

}  // namespace

Result<GridTriangles> triangulateGrid(const HeightGrid& grid, const Decimation& decimation,
                                      const JobContext& job) {
    if (grid.columns < 2 || grid.rows < 2)
        return GridTriangles{};
    Triangulator triangulator(grid, job);
    if (!triangulator.measure())
        return tl::unexpected(JobContext::cancelledError());
    return triangulator.triangles(affordableError(triangulator, decimation));
}

double finestHeight(const std::array<double, 4>& corners, int i, int j, double u, double v) {
    const auto& [upperLeft, upperRight, lowerLeft, lowerRight] = corners;
    if ((i + j) % 2 == 0) {  // halved from the upper left to the lower right
        if (u >= v)
            return upperLeft + u * (upperRight - upperLeft) + v * (lowerRight - upperRight);
        return upperLeft + u * (lowerRight - lowerLeft) + v * (lowerLeft - upperLeft);
    }
    if (u + v <= 1.0)
        return upperLeft + u * (upperRight - upperLeft) + v * (lowerLeft - upperLeft);
    return lowerRight + (1.0 - u) * (lowerLeft - lowerRight) +
           (1.0 - v) * (upperRight - lowerRight);
}

}  // namespace reflet::terrain
