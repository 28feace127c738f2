// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/PolygonTriangulation.h"

#include "core/city/PolygonPlane.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/assertions_behaviour.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <utility>

namespace reflet {

namespace {

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
constexpr std::uint32_t kBornAtCrossing = 0xffffffffU;

struct VertexInfo {
    std::uint32_t point = kBornAtCrossing;  ///< index into TriangulatedPolygon::points
};
enum class Parity : std::uint8_t { Unvisited, Outside, Inside };
struct FaceInfo {
    Parity parity = Parity::Unvisited;
};

/// A constrained Delaunay triangulation that keeps, for every edge, which constraints run along it:
/// the parity rule needs their number.
template <class Kernel, class IntersectionTag>
using ConstrainedTriangulation =
    CGAL::Constrained_triangulation_plus_2<CGAL::Constrained_Delaunay_triangulation_2<
        Kernel,
        CGAL::Triangulation_data_structure_2<
            CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>,
            CGAL::Constrained_triangulation_face_base_2<
                Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>>,
        IntersectionTag>>;

/// Exact and quick as long as no edges cross; with crossings its born points are rounded, and where
/// three edges meet in one point an edge may pass a rounded one on the wrong side.
using QuickTriangulation = ConstrainedTriangulation<Inexact, CGAL::Exact_predicates_tag>;
/// Exact with crossings too, and several times slower.
using ExactTriangulation = ConstrainedTriangulation<Exact, CGAL::Exact_intersections_tag>;

/// CGAL reports broken preconditions on stderr before it throws; here they become `problem`.
void silenceCgal() {
    static const bool once = [] {
        const auto ignore = [](const char*, const char*, const char*, int, const char*) {};
        CGAL::set_error_handler(ignore);
        CGAL::set_warning_handler(ignore);
        return true;
    }();
    static_cast<void>(once);
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

double triangleArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

constexpr std::size_t kMostCornersOfAFan = 8;  // beyond, a fan makes needles
constexpr std::size_t kMostCornersRound = 32;
enum class Shape : std::uint8_t {
    Convex,  ///< a ring of few corners, each of which turns left
    Round,   ///< a ring of some corners, each of which turns left or goes straight on
    Other,
};

/// One polygon on its way through the recipe. `points` are relative to the polygon's first point.
class Triangulator {
public:
    /// rings, out: borrowed; a polygon's worth of them, to be used again.
    Triangulator(IndexRings& rings, TriangulatedPolygon& out) : m_out(out), m_rings(rings) {}

    void run(std::span<const PolygonRing> rings) {
        reset();
        if (collect(rings))
            triangulate();
        finish(rings);
    }

private:
    void reset();
    bool collect(std::span<const PolygonRing> rings);
    void triangulate();
    void finish(std::span<const PolygonRing> rings);

    [[nodiscard]] Shape shape(const DominantAxis& axis) const;
    void fan();
    [[nodiscard]] bool delaunay(const DominantAxis& axis);
    void constrained(const DominantAxis& axis);
    template <class Triangulation>
    [[nodiscard]] bool insertRings(Triangulation& cdt, const DominantAxis& axis,
                                   std::size_t crossingLimit) const;
    template <class Triangulation>
    void collectInside(Triangulation& cdt, const DominantAxis& axis);
    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    TriangulatedPolygon& m_out;
    glm::dvec3 m_origin{0.0};
    IndexRings& m_rings;
    PolygonPlane m_plane;
};

void Triangulator::reset() {
    m_out.points.clear();
    m_out.triangles.clear();
    m_out.problem.clear();
    m_out.area = m_out.planeDeviation = 0.0;
    m_out.repaired = false;
    m_out.inputPoints = 0;
}

bool Triangulator::collect(std::span<const PolygonRing> rings) {
    std::size_t count = 0;
    for (const PolygonRing& ring : rings)
        count += ring.size();
    m_out.inputPoints = count;
    m_out.points.reserve(count);
    bool finite = true;
    std::size_t kept = 0;
    for (const PolygonRing& ring : rings) {
        m_rings.resize(std::max(m_rings.size(), kept + 1));
        std::vector<std::uint32_t>& indices = m_rings[kept];
        indices.clear();
        for (const glm::dvec3& p : ring) {
            if (m_out.points.empty())
                m_origin = p;
            finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
            const auto index = std::uint32_t(m_out.points.size());
            m_out.points.push_back(p - m_origin);
            if (!indices.empty() && m_out.points[indices.back()] == m_out.points.back())
                m_out.repaired = true;
            else
                indices.push_back(index);
        }
        if (indices.size() > 1 && m_out.points[indices.front()] == m_out.points[indices.back()])
            indices.pop_back();
        if (indices.size() >= 3)
            ++kept;
        else if (kept > 0)
            m_out.repaired = true;  // a hole without area
        else {
            m_out.problem = "fewer than three distinct points";
            return false;
        }
    }
    m_rings.resize(kept);
    if (m_rings.empty())
        m_out.problem = "no ring";
    if (!finite)
        m_out.problem = "a coordinate is not a finite number";
    return m_out.problem.empty();
}

/// Whether a single ring turns left or goes straight on at every corner and goes round once. A
/// direction that only ever turns left by less than half a turn changes the sign of its x exactly
/// twice per round.
Shape Triangulator::shape(const DominantAxis& axis) const {
    const auto& ring = m_rings.front();
    if (m_rings.size() != 1 || ring.size() > kMostCornersRound)
        return Shape::Other;
    const std::size_t n = ring.size();
    std::array<glm::dvec2, kMostCornersRound> corner;
    double scale = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        corner[i] = axis.project(m_out.points[ring[i]]);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2 edge = corner[(i + 1) % n] - corner[i];
        scale = std::max(scale, glm::dot(edge, edge));
    }
    int flips = 0;
    double sign = 0.0;
    double firstSign = 0.0;
    bool straight = false;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2& b = corner[(i + 1) % n];
        const glm::dvec2& c = corner[(i + 2) % n];
        const double left = turn(corner[i], b, c);
        if (!(left > 1e-9 * scale)) {
            if (!(std::abs(left) < 1e-12 * scale && glm::dot(b - corner[i], c - b) > 0.0))
                return Shape::Other;
            straight = true;
        }
        const double dx = b.x - corner[i].x;
        if (dx == 0.0)
            continue;
        if (sign != 0.0 && (dx > 0.0) != (sign > 0.0))
            ++flips;
        if (firstSign == 0.0)
            firstSign = dx;
        sign = dx;
    }
    if ((firstSign > 0.0) != (sign > 0.0))
        ++flips;
    if (flips != 2)
        return Shape::Other;
    return straight || n > kMostCornersOfAFan ? Shape::Round : Shape::Convex;
}

void Triangulator::emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m_out.triangles.push_back({a, b, c});
}

/// From the corner whose fan has the best smallest triangle; for quads that is the choice of the
/// diagonal. The first of equals, so that the result does not depend on rounding.
void Triangulator::fan() {
    const auto& ring = m_rings.front();
    const std::size_t n = ring.size();
    std::size_t best = 0;
    double bestSmallest = -1.0;
    for (std::size_t start = 0; n > 3 && start < n; ++start) {
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k + 1 < n; ++k) {
            const double area =
                triangleArea(m_out.points[ring[start]], m_out.points[ring[(start + k) % n]],
                             m_out.points[ring[(start + k + 1) % n]]);
            smallest = std::min(smallest, area);
        }
        if (smallest > bestSmallest * (1.0 + 1e-9)) {
            bestSmallest = smallest;
            best = start;
        }
    }
    for (std::size_t k = 1; k + 1 < n; ++k)
        emit(ring[best], ring[(best + k) % n], ring[(best + k + 1) % n]);
}

/// The Delaunay triangulation of a round ring: of the corners beyond an edge or a diagonal, that
/// one makes a triangle with it which sees it under the greatest angle, for then no other corner
/// lies in the triangle's circle. The first of equals, as far as rounding can tell. False, and no
/// triangles: one would be flat.
bool Triangulator::delaunay(const DominantAxis& axis) {
    const auto& ring = m_rings.front();
    std::array<glm::dvec2, kMostCornersRound> corner;
    for (std::size_t i = 0; i < ring.size(); ++i)
        corner[i] = axis.project(m_out.points[ring[i]]);
    std::array<std::pair<std::size_t, std::size_t>, kMostCornersRound> open;
    std::size_t count = 0;
    open[count++] = {0, ring.size() - 1};
    while (count > 0) {
        const auto [first, last] = open[--count];
        std::size_t best = first;
        double least = std::numeric_limits<double>::infinity();  // cotangent of the angle
        for (std::size_t k = first + 1; k < last; ++k) {
            const glm::dvec2 a = corner[first] - corner[k];
            const glm::dvec2 b = corner[last] - corner[k];
            const double cross = b.x * a.y - b.y * a.x;
            if (!(cross > 0.0))
                continue;
            const double cotangent = glm::dot(a, b) / cross;
            if (cotangent < least - 1e-9 * (1.0 + std::abs(cotangent))) {
                least = cotangent;
                best = k;
            }
        }
        if (best == first) {
            m_out.triangles.clear();
            return false;
        }
        emit(ring[first], ring[best], ring[last]);
        if (best > first + 1)
            open[count++] = {first, best};
        if (last > best + 1)
            open[count++] = {best, last};
    }
    return true;
}

/// Inserts all points, then all edges, so that an edge through another ring's point meets it
/// exactly. False when more than `crossingLimit` points were born at crossings.
template <class Triangulation>
bool Triangulator::insertRings(Triangulation& cdt, const DominantAxis& axis,
                               std::size_t crossingLimit) const {
    std::vector<std::vector<typename Triangulation::Vertex_handle>> rings;
    typename Triangulation::Face_handle hint;
    for (const auto& ring : m_rings) {
        auto& vertices = rings.emplace_back();
        for (const std::uint32_t i : ring) {
            const glm::dvec2 p = axis.project(m_out.points[i]);
            const auto vertex = cdt.insert(typename Triangulation::Point(p.x, p.y), hint);
            if (vertex->info().point == kBornAtCrossing)
                vertex->info().point = i;
            hint = vertex->face();
            vertices.push_back(vertex);
        }
    }
    const std::size_t limit = cdt.number_of_vertices() + crossingLimit;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto next = ring[(i + 1) % ring.size()];
            if (ring[i] != next)
                cdt.insert_constraint(ring[i], next);
            if (cdt.number_of_vertices() > limit)
                return false;
        }
    return true;
}

/// Floods the faces from outside; parity flips across an edge that an odd number of ring edges
/// runs along, so that an edge shared by a hole and the outer ring counts as none.
template <class Triangulation>
void floodParity(Triangulation& cdt) {
    std::vector<typename Triangulation::Face_handle> stack{cdt.infinite_face()};
    stack.back()->info().parity = Parity::Outside;
    while (!stack.empty()) {
        const auto face = stack.back();
        stack.pop_back();
        for (int i = 0; i < 3; ++i) {
            const auto neighbour = face->neighbor(i);
            if (neighbour->info().parity != Parity::Unvisited)
                continue;
            bool inside = face->info().parity == Parity::Inside;
            if (face->is_constrained(i)) {
                const auto along = cdt.number_of_enclosing_constraints(
                    face->vertex(Triangulation::cw(i)), face->vertex(Triangulation::ccw(i)));
                inside = inside != (along % 2 == 1);
            }
            neighbour->info().parity = inside ? Parity::Inside : Parity::Outside;
            stack.push_back(neighbour);
        }
    }
}

template <class Triangulation>
void Triangulator::collectInside(Triangulation& cdt, const DominantAxis& axis) {
    if (cdt.dimension() < 2) {
        m_out.problem = "all points lie on a line";
        return;
    }
    floodParity(cdt);
    for (const auto& face : cdt.finite_face_handles()) {
        if (face->info().parity != Parity::Inside)
            continue;
        std::array<std::uint32_t, 3> corner{};
        for (int i = 0; i < 3; ++i) {
            const auto vertex = face->vertex(i);
            if (vertex->info().point == kBornAtCrossing) {
                vertex->info().point = std::uint32_t(m_out.points.size());
                m_out.points.push_back(axis.lift(CGAL::to_double(vertex->point().x()),
                                                 CGAL::to_double(vertex->point().y()), m_plane));
            }
            corner[std::size_t(i)] = vertex->info().point;
        }
        emit(corner[0], corner[1], corner[2]);
    }
    if (m_out.triangles.empty())
        m_out.problem = "its rings cancel each other out";
}

void Triangulator::constrained(const DominantAxis& axis) {
    silenceCgal();
    {
        QuickTriangulation cdt;
        if (insertRings(cdt, axis, 0)) {
            collectInside(cdt, axis);
            return;
        }
    }
    m_out.repaired = true;
    // n edges may cross in n²/2 points: hostile input must not cost the memory of the machine.
    const std::size_t limit = 2 * m_out.inputPoints + 1'000;
    ExactTriangulation cdt;
    if (insertRings(cdt, axis, limit))
        collectInside(cdt, axis);
    else
        m_out.problem = "its edges cross each other too often";
}

void Triangulator::triangulate() {
    const bool triangle = m_rings.size() == 1 && m_rings.front().size() == 3;
    if (triangle && ringNormal(m_out.points, m_rings.front()).vanishes()) {
        m_out.problem = "all points lie on a line";
        return;
    }
    if (triangle) {
        fan();
        return;
    }
    const auto plane = fitPlane(m_out.points, m_rings);
    if (!plane) {
        m_out.problem = "all points lie on a line";
        return;
    }
    m_plane = *plane;
    m_out.planeDeviation = planeDeviation(m_plane, m_out.points, m_rings);
    const DominantAxis axis(m_plane.normal);
    const Shape is = shape(axis);
    if (is == Shape::Convex)
        fan();
    else if (is != Shape::Round || !delaunay(axis))
        constrained(axis);
}

void Triangulator::finish(std::span<const PolygonRing> rings) {
    if (!m_out.problem.empty())
        m_out.triangles.clear();
    for (const auto& [a, b, c] : m_out.triangles)
        m_out.area += triangleArea(m_out.points[a], m_out.points[b], m_out.points[c]);
    if (m_out.triangles.empty())
        m_out.points.resize(m_out.inputPoints);
    // Input points come back bit by bit as they were, only the born ones are shifted back.
    std::size_t i = 0;
    for (const PolygonRing& ring : rings)
        for (const glm::dvec3& p : ring)
            m_out.points[i++] = p;
    for (; i < m_out.points.size(); ++i)
        m_out.points[i] += m_origin;
}

}  // namespace

TriangulatedPolygon triangulatePolygon(std::span<const PolygonRing> rings) {
    TriangulatedPolygon polygon;
    triangulatePolygon(rings, polygon);
    return polygon;
}

void triangulatePolygon(std::span<const PolygonRing> rings, TriangulatedPolygon& into) {
    static thread_local IndexRings scratch;
    try {
        Triangulator(scratch, into).run(rings);
    } catch (const std::exception& error) {
        into = {};
        for (const PolygonRing& ring : rings)
            into.points.insert(into.points.end(), ring.begin(), ring.end());
        into.inputPoints = into.points.size();
        into.problem = "the triangulation failed: " + std::string(error.what());
    }
}

}  // namespace reflet
