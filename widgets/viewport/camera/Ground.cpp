// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/Ground.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kFarthest = 20'000.0;  // metres
constexpr double kStep = 0.45;          // metres that one can step up: a kerb, a stair, a low wall
constexpr double kSearch = 50.0;        // metres around a hole in the terrain
constexpr int kSearchDirections = 8;
constexpr int kDragRounds = 4;  // a slope is followed by fixed-point steps
constexpr double kLevelRay = 1e-4;

/// The top of the solid that a ray met in a cell at height z.
double topAt(const HeightfieldTracer& tracer, std::size_t cell, double z) {
    for (const HeightSpan& solid : tracer.spans().at(cell)) {
        if (z <= double(solid.high))
            return double(solid.high);
    }
    return double(tracer.layer()[cell]);
}

}  // namespace

Ground::Ground(std::shared_ptr<const DrawnCity> city) {
    if (!city || !city->heightfield || !city->tracer) {
        return;
    }
    m_city = std::move(city);
    const Heightfield& field = *m_city->heightfield;
    m_floor = std::numeric_limits<double>::infinity();
    double top = -m_floor;
    for (const float z : field.ground) {
        m_floor = isMissing(z) ? m_floor : std::min(m_floor, double(z));
    }
    for (const float z : field.topMax) {
        top = isMissing(z) ? top : std::max(top, double(z));
    }
    if (!std::isfinite(m_floor)) {
        m_floor = 0.0;
    }
    m_bounds.add({field.grid.x0, field.grid.y0, m_floor});
    m_bounds.add({field.grid.xMax(), field.grid.yMax(), std::max(top, m_floor)});
}

double Ground::heightAt(double x, double y) const {
    return m_city ? double(m_city->heightfield->groundAt(x, y)) : 0.0;
}

double Ground::heightNear(double x, double y) const {
    if (const double here = heightAt(x, y); !std::isnan(here)) {
        return here;
    }
    for (double radius = 1.0; radius <= kSearch; radius *= 2.0) {
        for (int k = 0; k < kSearchDirections; ++k) {
            const double angle = 2.0 * kPi * k / kSearchDirections;
            const double z = heightAt(x + radius * std::cos(angle), y + radius * std::sin(angle));
            if (!std::isnan(z)) {
                return z;
            }
        }
    }
    return m_floor;
}

bool Ground::isSolid(double x, double y) const {
    if (!m_city) {
        return false;
    }
    const Heightfield& field = *m_city->heightfield;
    const int i = field.grid.column(x), j = field.grid.row(y);
    if (!field.grid.contains(i, j)) {
        return true;
    }
    const float ground = field.ground[field.grid.index(i, j)];
    const float top = field.standingTop(field.grid.index(i, j));
    return isMissing(ground) || (!isMissing(top) && top > ground + kStep);
}

std::optional<Ground::Hit> Ground::hit(const Ray& ray) const {
    if (m_city) {
        const HeightfieldHit found = m_city->tracer->trace(ray);
        if (found.hit && found.t * glm::length(ray.direction) < kFarthest) {
            const GridSpec& grid = m_city->tracer->grid();
            const glm::dvec3 point = ray.at(found.t);
            const double top = topAt(*m_city->tracer, grid.index(found.i, found.j), point.z);
            // A column's wall is hit below its top; one that is no higher than a step is ground.
            return Hit{point, point.z < top - kStep, top};
        }
    }
    const double t = (m_floor - ray.origin.z) / ray.direction.z;
    if (!std::isfinite(t) || t <= 0.0 || t * glm::length(ray.direction) > kFarthest) {
        return std::nullopt;
    }
    return Hit{ray.at(t), false, m_floor};
}

std::optional<glm::dvec3> Ground::pointUnder(const Ray& ray) const {
    const std::optional<Hit> found = hit(ray);
    return found ? std::optional(found->point) : std::nullopt;
}

std::optional<glm::dvec3> Ground::streetUnder(const Ray& ray) const {
    const std::optional<Hit> found = hit(ray);
    if (!found) {
        return std::nullopt;
    }
    const double z = heightNear(found->point.x, found->point.y);
    if (!m_city || (!found->wall && found->point.z <= z + kStep)) {
        // On the open ground the exact terrain counts, not the stairs that a grid makes of it.
        return draggedOverGround(*this, ray, found->point, 0.0);
    }
    return glm::dvec3(found->point.x, found->point.y, z);
}

std::optional<glm::dvec3> Ground::probePlaceUnder(const Ray& ray) const {
    const std::optional<Hit> found = hit(ray);
    if (!found) {
        return std::nullopt;
    }
    glm::dvec3 place = found->point;
    if (found->wall) {
        // Half a metre and a cell before the wall, so that the probe does not stand in it.
        const double back = 0.5 + (m_city ? m_city->tracer->grid().cellSize : 0.0);
        const glm::dvec2 level(ray.direction.x, ray.direction.y);
        const double length = std::hypot(level.x, level.y);
        if (length > 0.0) {
            place -= glm::dvec3(level / length * back, 0.0);
        }
        return glm::dvec3(place.x, place.y, heightNear(place.x, place.y) + kProbeHeight);
    }
    const double terrain = heightNear(place.x, place.y);
    const bool open = place.z <= terrain + kStep;
    if (open) {
        place = draggedOverGround(*this, ray, place, 0.0).value_or(place);
        return glm::dvec3(place.x, place.y, heightNear(place.x, place.y) + kProbeHeight);
    }
    return glm::dvec3(place.x, place.y, found->standing + kProbeHeight);
}

std::optional<glm::dvec3> draggedOverGround(const Ground& ground, const Ray& ray,
                                            const glm::dvec3& from, double height) {
    glm::dvec3 place = from;
    for (int round = 0; round < kDragRounds; ++round) {
        const double slope = ray.direction.z;
        const double t = (place.z - ray.origin.z) / slope;
        if (std::abs(slope) < kLevelRay || !(t > 0.0) ||
            t * glm::length(ray.direction) > kFarthest) {
            return std::nullopt;
        }
        const glm::dvec3 point = ray.at(t);
        place = {point.x, point.y, ground.heightNear(point.x, point.y) + height};
    }
    return place;
}

double draggedVertically(const Ray& ray, const glm::dvec3& point) {
    // Nearest points of two lines, one of them vertical: in the plan the ray passes nearest to the
    // point at t; there its height is what counts.
    const glm::dvec2 level(ray.direction.x, ray.direction.y);
    const double squared = level.x * level.x + level.y * level.y;
    if (!(squared > 0.0)) {
        return point.z;
    }
    const double t =
        ((point.x - ray.origin.x) * level.x + (point.y - ray.origin.y) * level.y) / squared;
    return t > 0.0 ? ray.at(t).z : point.z;
}

}  // namespace reflet
