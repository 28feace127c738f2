// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/extrusion/RidgeFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace reflet::extrusion {

namespace {

using Ring = std::vector<glm::dvec2>;
using IndexRing = std::vector<std::uint32_t>;

struct Rectangle {
    glm::dvec2 middle{0.0};
    glm::dvec2 along{1.0, 0.0};
    glm::dvec2 half{0.0};  ///< along, across

    [[nodiscard]] double area() const { return half.x * half.y; }
};

Rectangle rectangleAlong(const Ring& ring, const glm::dvec2& along) {
    const glm::dvec2 across(-along.y, along.x);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec2& p : ring) {
        const glm::dvec2 uv(glm::dot(p - ring[0], along), glm::dot(p - ring[0], across));
        low = glm::min(low, uv);
        high = glm::max(high, uv);
    }
    const glm::dvec2 middle = 0.5 * (low + high);
    return {ring[0] + middle.x * along + middle.y * across, along, 0.5 * (high - low)};
}

Rectangle smallestRectangle(const Ring& ring) {
    Rectangle best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 edge = ring[(i + 1) % ring.size()] - ring[i];
        const double length = glm::length(edge);
        if (length < 1e-6)
            continue;
        const Rectangle rectangle = rectangleAlong(ring, edge / length);
        if (rectangle.area() < least) {
            least = rectangle.area();
            best = rectangle;
        }
    }
    return best;
}

/// Moves the line so that it keeps clear of all corners.
bool placeLine(const PlanPolygon& polygon, RidgeFrame& frame) {
    constexpr double kClear = 2e-3;  // metres: points are rounded to a millimetre later
    constexpr double kStep = 5e-3;
    constexpr int kTries = 64;
    const glm::dvec2 across(-frame.along.y, frame.along.x);
    for (int k = 0; k < kTries; ++k) {
        const double shift = (k % 2 == 0 ? 1.0 : -1.0) * kStep * double((k + 1) / 2);
        const bool clear =
            std::all_of(polygon.rings.begin(), polygon.rings.end(), [&](const Ring& ring) {
                return std::all_of(ring.begin(), ring.end(), [&](const glm::dvec2& p) {
                    return std::abs(frame.across(p) - shift) > kClear;
                });
            });
        if (clear) {
            frame.origin += shift * across;
            frame.half += std::abs(shift);
            return true;
        }
    }
    return false;
}

/// Walks along the rings on one side of the line and crosses over along the ridge.
class Splitter {
public:
    Splitter(const PlanPolygon& polygon, const RidgeFrame& frame) : m_frame(frame) {
        for (const Ring& ring : polygon.rings)
            addRing(ring);
        pairCuts();
    }

    std::optional<RidgeSplit> split() {
        m_split.left = side(1.0);
        m_split.right = side(-1.0);
        if (m_lost)
            return std::nullopt;
        for (const std::uint32_t cut : m_cutOf)
            m_split.onRidge.push_back(cut != kNoCut);
        return std::move(m_split);
    }

private:
    struct Place {
        std::uint32_t ring = 0;
        std::uint32_t position = 0;
    };
    struct Cut {
        std::uint32_t point = 0;
        Place place;
        double u = 0.0;
        std::uint32_t partner = 0;  ///< the cut at the other end of its piece of the ridge
    };

    void addRing(const Ring& ring) {
        IndexRing indices;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            indices.push_back(addPoint(ring[i]));
            const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
            const double va = m_frame.across(a), vb = m_frame.across(b);
            if ((va > 0.0) == (vb > 0.0))
                continue;
            const std::uint32_t point = addPoint(a + (va / (va - vb)) * (b - a));
            const Place place{std::uint32_t(m_split.rings.size()), std::uint32_t(indices.size())};
            m_cutOf.resize(m_split.points.size(), kNoCut);
            m_cutOf[point] = std::uint32_t(m_cuts.size());
            m_cuts.push_back({point, place, m_frame.alongOf(m_split.points[point]), 0});
            indices.push_back(point);
        }
        m_split.rings.push_back(std::move(indices));
    }

    std::uint32_t addPoint(const glm::dvec2& p) {
        m_split.points.push_back(p);
        m_cutOf.resize(m_split.points.size(), kNoCut);
        return std::uint32_t(m_split.points.size() - 1);
    }

    /// Along the line, inside and outside alternate.
    void pairCuts() {
        std::vector<std::uint32_t> order(m_cuts.size());
        for (std::uint32_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return m_cuts[a].u < m_cuts[b].u; });
        for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
            m_cuts[order[i]].partner = order[i + 1];
            m_cuts[order[i + 1]].partner = order[i];
        }
    }

    [[nodiscard]] double vOf(std::uint32_t point) const {
        return m_cutOf[point] != kNoCut ? 0.0 : m_frame.across(m_split.points[point]);
    }
    [[nodiscard]] std::uint32_t after(Place& place) const {
        const IndexRing& ring = m_split.rings[place.ring];
        place.position = (place.position + 1) % std::uint32_t(ring.size());
        return ring[place.position];
    }

    std::vector<std::vector<IndexRing>> side(double sign) {
        std::vector<std::vector<IndexRing>> polygons;
        std::vector<bool> done(m_cuts.size(), false);
        for (std::uint32_t c = 0; c < m_cuts.size(); ++c) {
            Place next = m_cuts[c].place;
            if (!done[c] && sign * vOf(after(next)) > 0.0)
                polygons.push_back({walk(c, sign, done)});
        }
        for (const IndexRing& ring : m_split.rings)
            placeWhole(ring, sign, polygons);
        return polygons;
    }

    /// From a cut where the ring enters this side, along it to where it leaves, back over the
    /// ridge.
    IndexRing walk(std::uint32_t first, double sign, std::vector<bool>& done) {
        IndexRing ring;
        std::uint32_t cut = first;
        do {
            done[cut] = true;
            ring.push_back(m_cuts[cut].point);
            Place place = m_cuts[cut].place;
            std::uint32_t point = after(place);
            while (m_cutOf[point] == kNoCut && sign * vOf(point) > 0.0) {
                ring.push_back(point);
                point = after(place);
            }
            if (m_cutOf[point] == kNoCut || m_cuts.size() % 2 != 0) {
                m_lost = true;  // cuts too close to each other to be told apart
                return ring;
            }
            ring.push_back(point);
            cut = m_cuts[m_cutOf[point]].partner;
        } while (cut != first && !done[cut]);
        return ring;
    }

    /// A ring that the line does not cut: the polygon itself, or a hole in one of the pieces.
    void placeWhole(const IndexRing& ring, double sign,
                    std::vector<std::vector<IndexRing>>& polygons) const {
        const bool here = std::all_of(ring.begin(), ring.end(),
                                      [&](std::uint32_t p) { return sign * vOf(p) > 0.0; });
        if (!here)
            return;
        for (std::vector<IndexRing>& polygon : polygons) {
            if (contains(polygon.front(), m_split.points[ring.front()])) {
                polygon.push_back(ring);
                return;
            }
        }
        polygons.push_back({ring});
    }

    [[nodiscard]] bool contains(const IndexRing& ring, const glm::dvec2& p) const {
        bool inside = false;
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            const glm::dvec2 a = m_split.points[ring[i]], b = m_split.points[ring[j]];
            if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
                inside = !inside;
        }
        return inside;
    }

    static constexpr std::uint32_t kNoCut = 0xffffffffU;
    const RidgeFrame& m_frame;
    RidgeSplit m_split;
    std::vector<Cut> m_cuts;
    std::vector<std::uint32_t> m_cutOf;  ///< of each point
    bool m_lost = false;
};

}  // namespace

RidgeFrame ridgeFrame(const PlanPolygon& polygon, bool acrossTheLonger) {
    const Rectangle rectangle = smallestRectangle(polygon.rings.front());
    const bool turned = (rectangle.half.x < rectangle.half.y) != acrossTheLonger;
    RidgeFrame frame{rectangle.middle, rectangle.along, rectangle.half.y};
    if (turned) {
        frame.along = {-rectangle.along.y, rectangle.along.x};
        frame.half = rectangle.half.x;
    }
    return frame;
}

std::optional<RidgeSplit> splitAlong(const PlanPolygon& polygon, RidgeFrame& frame) {
    if (!placeLine(polygon, frame))
        return std::nullopt;
    return Splitter(polygon, frame).split();
}

}  // namespace reflet::extrusion
