// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/extrusion/Solid.h"

#include "importers/extrusion/RidgeFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace reflet::extrusion {

namespace {

using Ring = std::vector<glm::dvec2>;
using IndexRing = std::vector<std::uint32_t>;

/// Puts a solid together from a plan whose points each have a height at the top.
class Extrusion {
public:
    /// The rings refer to `plan`: outer ones counter-clockwise, holes clockwise.
    Extrusion(const Ring& plan, const std::vector<IndexRing>& rings, double bottom,
              const std::function<double(std::uint32_t)>& topOf)
        : m_count(std::uint32_t(plan.size())) {
        for (const glm::dvec2& p : plan)
            m_solid.points.emplace_back(p, bottom);
        for (std::uint32_t i = 0; i < m_count; ++i)
            m_solid.points.emplace_back(plan[i], topOf(i));
        addGround(rings);
        for (const IndexRing& ring : rings) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                addWall(ring[i], ring[(i + 1) % ring.size()]);
        }
    }

    /// The point of the roof over a point of the plan. One that meets the ground is that of the
    /// ground.
    [[nodiscard]] std::uint32_t top(std::uint32_t point) const {
        const bool grounded = m_solid.points[point].z == m_solid.points[m_count + point].z;
        return grounded ? point : m_count + point;
    }
    [[nodiscard]] std::uint32_t addPoint(const glm::dvec3& point) {
        m_solid.points.push_back(point);
        return std::uint32_t(m_solid.points.size() - 1);
    }
    void addRoof(IndexRing ring) {
        m_solid.faces.push_back({SurfaceType::Roof, {std::move(ring)}});
    }
    /// Rings of the plan.
    void addRoofOver(const std::vector<IndexRing>& rings) {
        Face face{SurfaceType::Roof, rings};
        for (IndexRing& ring : face.rings) {
            for (std::uint32_t& point : ring)
                point = top(point);
        }
        m_solid.faces.push_back(std::move(face));
    }
    [[nodiscard]] Solid take() { return std::move(m_solid); }

private:
    void addGround(const std::vector<IndexRing>& rings) {
        Face face{SurfaceType::Ground, rings};
        for (IndexRing& ring : face.rings)
            std::reverse(ring.begin(), ring.end());
        m_solid.faces.push_back(std::move(face));
    }
    void addWall(std::uint32_t a, std::uint32_t b) {
        IndexRing ring{a, b};
        if (top(b) != b)
            ring.push_back(top(b));
        if (top(a) != a)
            ring.push_back(top(a));
        if (ring.size() >= 3)
            m_solid.faces.push_back({SurfaceType::Wall, {std::move(ring)}});
    }

    std::uint32_t m_count;
    Solid m_solid;
};

/// A polygon in flat form.
struct Plan {
    Ring points;
    std::vector<IndexRing> rings;

    explicit Plan(const PlanPolygon& polygon) {
        for (const Ring& ring : polygon.rings) {
            IndexRing& indices = rings.emplace_back();
            for (const glm::dvec2& p : ring) {
                indices.push_back(std::uint32_t(points.size()));
                points.push_back(p);
            }
        }
    }
};

Solid flat(const PlanPolygon& polygon, const Levels& levels) {
    const Plan plan(polygon);
    Extrusion extrusion(plan.points, plan.rings, levels.bottom,
                        [&](std::uint32_t) { return levels.top; });
    extrusion.addRoofOver(plan.rings);
    return extrusion.take();
}

std::optional<Solid> gabled(const PlanPolygon& polygon, const Levels& levels, bool across) {
    RidgeFrame frame = ridgeFrame(polygon, across);
    const std::optional<RidgeSplit> split = splitAlong(polygon, frame);
    if (!split || frame.half <= 0.0)
        return std::nullopt;
    const auto topOf = [&](std::uint32_t point) {
        if (split->onRidge[point])
            return levels.top;
        const double share = 1.0 - std::abs(frame.across(split->points[point])) / frame.half;
        return levels.eaves + (levels.top - levels.eaves) * std::clamp(share, 0.0, 1.0);
    };
    Extrusion extrusion(split->points, split->rings, levels.bottom, topOf);
    for (const auto& side : {split->left, split->right}) {
        for (const auto& rings : side)
            extrusion.addRoofOver(rings);
    }
    return extrusion.take();
}

Solid skillion(const PlanPolygon& polygon, const Levels& levels, const Roof& roof) {
    const RidgeFrame frame = ridgeFrame(polygon, roof.ridgeAcross);
    glm::dvec2 down(frame.along.y, -frame.along.x);
    if (roof.slopesTo)
        down = {std::sin(*roof.slopesTo), std::cos(*roof.slopesTo)};
    double low = 0.0, high = 0.0;
    const glm::dvec2 origin = polygon.rings.front().front();
    for (const glm::dvec2& p : polygon.rings.front()) {
        low = std::min(low, glm::dot(p - origin, down));
        high = std::max(high, glm::dot(p - origin, down));
    }
    const Plan plan(polygon);
    const auto topOf = [&](std::uint32_t point) {
        const double share = (high - glm::dot(plan.points[point] - origin, down)) / (high - low);
        return levels.eaves + (levels.top - levels.eaves) * std::clamp(share, 0.0, 1.0);
    };
    Extrusion extrusion(plan.points, plan.rings, levels.bottom, topOf);
    extrusion.addRoofOver(plan.rings);
    return extrusion.take();
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

glm::dvec2 centroid(const Ring& ring) {
    const glm::dvec2 origin = ring[0];
    glm::dvec2 sum(0.0);
    double area = 0.0;
    for (std::size_t i = 2; i < ring.size(); ++i) {
        const glm::dvec2 a = ring[i - 1] - origin, b = ring[i] - origin;
        sum += cross(a, b) * (a + b) / 3.0;
        area += cross(a, b);
    }
    return origin + sum / area;
}

std::optional<Solid> pyramidal(const PlanPolygon& polygon, const Levels& levels) {
    constexpr double kLeastArea = 1e-4;  // square metres: of a roof's face in the plan, twice
    if (polygon.rings.size() != 1)
        return std::nullopt;
    const Ring& ring = polygon.rings.front();
    const glm::dvec2 middle = centroid(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (cross(ring[i] - middle, ring[(i + 1) % ring.size()] - middle) < kLeastArea)
            return std::nullopt;
    }
    const Plan plan(polygon);
    Extrusion extrusion(plan.points, plan.rings, levels.bottom,
                        [&](std::uint32_t) { return levels.eaves; });
    const std::uint32_t apex = extrusion.addPoint({middle, levels.top});
    for (std::uint32_t i = 0; i < ring.size(); ++i)
        extrusion.addRoof(
            {extrusion.top(i), extrusion.top((i + 1) % std::uint32_t(ring.size())), apex});
    return extrusion.take();
}

/// Without corners that lie on the line between their neighbours.
Ring realCorners(const Ring& ring) {
    constexpr double kStraight = 0.05;  // metres
    Ring corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = corners.empty() ? ring.back() : corners.back();
        const glm::dvec2 b = ring[(i + 1) % ring.size()];
        const double length = glm::distance(a, b);
        if (length > 0.0 && std::abs(cross(b - a, ring[i] - a)) / length > kStraight)
            corners.push_back(ring[i]);
    }
    return corners;
}

bool isConvex(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()],
                         c = ring[(i + 2) % ring.size()];
        if (cross(b - a, c - b) <= 0.0)
            return false;
    }
    return true;
}

std::optional<Solid> hipped(const PlanPolygon& polygon, const Levels& levels) {
    if (polygon.rings.size() != 1)
        return std::nullopt;
    Ring corners = realCorners(polygon.rings.front());
    if (corners.size() != 4 || !isConvex(corners))
        return std::nullopt;
    const auto edge = [&](std::size_t i) {
        return glm::distance(corners[i], corners[(i + 1) % 4]);
    };
    if (edge(0) + edge(2) > edge(1) + edge(3))  // the short sides come first and third
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    const glm::dvec2 start = 0.5 * (corners[0] + corners[1]);
    const glm::dvec2 end = 0.5 * (corners[2] + corners[3]);
    const double length = glm::distance(start, end);
    const double inset = 0.25 * (edge(0) + edge(2));
    const PlanPolygon plain{{corners}};
    constexpr double kShortestRidge = 0.1;
    if (length - 2.0 * inset < kShortestRidge)
        return pyramidal(plain, levels);
    const glm::dvec2 along = (end - start) / length;
    const Plan plan(plain);
    Extrusion extrusion(plan.points, plan.rings, levels.bottom,
                        [&](std::uint32_t) { return levels.eaves; });
    const std::array<std::uint32_t, 4> c{extrusion.top(0), extrusion.top(1), extrusion.top(2),
                                         extrusion.top(3)};
    const std::uint32_t first = extrusion.addPoint({start + inset * along, levels.top});
    const std::uint32_t second = extrusion.addPoint({end - inset * along, levels.top});
    extrusion.addRoof({c[0], c[1], first});
    extrusion.addRoof({c[1], c[2], second, first});
    extrusion.addRoof({c[2], c[3], second});
    extrusion.addRoof({c[3], c[0], first, second});
    return extrusion.take();
}

std::optional<Solid> shaped(const PlanPolygon& polygon, const Levels& levels, const Roof& roof) {
    switch (roof.shape) {
        case RoofShape::Gabled:
            return gabled(polygon, levels, roof.ridgeAcross);
        case RoofShape::Hipped:
            return hipped(polygon, levels);
        case RoofShape::Pyramidal:
            return pyramidal(polygon, levels);
        case RoofShape::Skillion:
            return skillion(polygon, levels, roof);
        case RoofShape::Flat:
            break;
    }
    return flat(polygon, levels);
}

}  // namespace

std::optional<RoofShape> roofShape(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, RoofShape>, 16> kShapes{{
        {"flat", RoofShape::Flat},
        {"gabled", RoofShape::Gabled},
        {"gambrel", RoofShape::Gabled},
        {"round", RoofShape::Gabled},
        {"saltbox", RoofShape::Gabled},
        {"hipped", RoofShape::Hipped},
        {"half-hipped", RoofShape::Hipped},
        {"side_hipped", RoofShape::Hipped},
        {"mansard", RoofShape::Hipped},
        {"hipped-and-gabled", RoofShape::Hipped},
        {"pyramidal", RoofShape::Pyramidal},
        {"dome", RoofShape::Pyramidal},
        {"onion", RoofShape::Pyramidal},
        {"cone", RoofShape::Pyramidal},
        {"skillion", RoofShape::Skillion},
        {"lean_to", RoofShape::Skillion},
    }};
    for (const auto& [known, shape] : kShapes) {
        if (known == name)
            return shape;
    }
    return std::nullopt;
}

Extruded extruded(const PlanPolygon& polygon, const Levels& levels, const Roof& roof) {
    constexpr double kNoSlope = 0.01;  // metres
    const bool sloped = roof.shape != RoofShape::Flat && levels.top - levels.eaves > kNoSlope;
    if (!sloped)
        return {flat(polygon, levels), RoofShape::Flat};
    if (auto solid = shaped(polygon, levels, roof))
        return {*std::move(solid), roof.shape};
    if (auto solid = gabled(polygon, levels, roof.ridgeAcross))
        return {*std::move(solid), RoofShape::Gabled};
    return {flat(polygon, levels), RoofShape::Flat};
}

double halfSpan(const PlanPolygon& polygon, bool ridgeAcross) {
    return ridgeFrame(polygon, ridgeAcross).half;
}

}  // namespace reflet::extrusion
