// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/PlanPolygon.h"

#include "core/io/GdalSession.h"
#include "core/io/GdalVector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace reflet {

namespace {

using Ring = std::vector<glm::dvec2>;

bool isFinite(const PlanPolygon& polygon) {
    for (const Ring& ring : polygon.rings) {
        for (const glm::dvec2& p : ring) {
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                return false;
        }
    }
    return true;
}

/// Whether points other than the closing one were dropped.
bool dropRepeated(Ring& ring) {
    if (ring.size() > 1 && ring.front() == ring.back())
        ring.pop_back();
    const std::size_t before = ring.size();
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back())
        ring.pop_back();
    return ring.size() != before;
}

void turn(PlanPolygon& polygon) {
    for (std::size_t r = 0; r < polygon.rings.size(); ++r) {
        Ring& ring = polygon.rings[r];
        if ((doubleArea(ring) < 0.0) == (r == 0))
            std::reverse(ring.begin(), ring.end());
    }
}

OGRPolygon toOgr(const PlanPolygon& polygon) {
    OGRPolygon made;
    for (const Ring& ring : polygon.rings) {
        auto line = std::make_unique<OGRLinearRing>();
        for (const glm::dvec2& p : ring)
            line->addPoint(p.x, p.y);
        line->closeRings();
        made.addRingDirectly(line.release());
    }
    return made;
}

PlanPolygon fromOgr(const OGRPolygon& source) {
    PlanPolygon polygon;
    for (const OGRLinearRing* line : source) {
        Ring ring;
        for (int i = 0; i + 1 < line->getNumPoints(); ++i)
            ring.emplace_back(line->getX(i), line->getY(i));
        dropRepeated(ring);
        if (ring.size() >= 3)
            polygon.rings.push_back(std::move(ring));
    }
    return polygon;
}

/// The areas of what MakeValid() gives: polygons, and also points and lines of what had no area.
void collectAreas(const OGRGeometry& geometry, std::vector<PlanPolygon>& areas) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon) {
        PlanPolygon polygon = fromOgr(*geometry.toPolygon());
        if (!polygon.rings.empty() && doubleArea(polygon.rings.front()) != 0.0) {
            turn(polygon);
            areas.push_back(std::move(polygon));
        }
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection())
            collectAreas(*part, areas);
    }
}

MendedPolygons unusable(std::string problem) {
    return {{}, false, std::move(problem)};
}

}  // namespace

double doubleArea(const Ring& ring) {
    double area = 0.0;
    for (std::size_t i = 2; i < ring.size(); ++i) {
        const glm::dvec2 a = ring[i - 1] - ring[0], b = ring[i] - ring[0];
        area += a.x * b.y - a.y * b.x;
    }
    return area;
}

MendedPolygons mendPolygon(PlanPolygon polygon) {
    if (!isFinite(polygon))
        return unusable("a coordinate is not finite");
    MendedPolygons mended;
    for (Ring& ring : polygon.rings) {
        if (dropRepeated(ring)) {
            mended.repaired = true;
            mended.problem = "points are repeated";
        }
    }
    if (polygon.rings.empty() || polygon.rings.front().size() < 3)
        return unusable("it has fewer than three different corners");
    const auto tiny = std::remove_if(polygon.rings.begin() + 1, polygon.rings.end(),
                                     [](const Ring& ring) { return ring.size() < 3; });
    if (tiny != polygon.rings.end()) {
        polygon.rings.erase(tiny, polygon.rings.end());
        mended.repaired = true;
        mended.problem = "a hole has fewer than three different corners";
    }
    const GdalSession session;
    const OGRPolygon ogr = toOgr(polygon);
    if (ogr.IsValid() != 0) {
        turn(polygon);
        mended.polygons.push_back(std::move(polygon));
        return mended;
    }
    const std::string problem = session.message();
    const std::unique_ptr<OGRGeometry> valid(ogr.MakeValid());
    if (valid)
        collectAreas(*valid, mended.polygons);
    if (mended.polygons.empty())
        return unusable(problem.empty() ? "it has no area" : problem);
    mended.repaired = true;
    mended.problem = problem.empty() ? "its rings cross" : problem;
    return mended;
}

}  // namespace reflet
