// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/BoxesSeen.h"

#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace reflet {

namespace {

constexpr int kPatch = 8;  // texels along an edge of what is passed over at once

/// Some neighbouring texels of a face, in a cone around an axis.
struct Patch {
    int face = 0;
    int column = 0, row = 0;  // the first texel
    glm::dvec3 axis{0.0};
    double cosine = 1.0, sine = 0.0;  // of the cone's half angle
    float reach = 0.0F;               // the largest distance
};

double distanceTo(const Box& box, const glm::dvec3& p) {
    return glm::length(glm::max(glm::max(box.min - p, p - box.max), glm::dvec3(0.0)));
}

/// Distance along a ray to a box; infinite when it misses.
double entry(const glm::dvec3& origin, const glm::dvec3& direction, const Box& box) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    double from = 0.0, to = kNever;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = origin[axis], d = direction[axis];
        if (d == 0.0) {
            if (o < box.min[axis] || o > box.max[axis])
                return kNever;
            continue;
        }
        const double a = (box.min[axis] - o) / d, b = (box.max[axis] - o) / d;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to ? from : kNever;
}

class Sight {
public:
    explicit Sight(const ReferenceEnvironmentMap& map)
        : m_map(map), m_n(map.distance.resolution()) {
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < m_n; row += kPatch) {
                for (int column = 0; column < m_n; column += kPatch)
                    m_patches.push_back(patch(face, column, row));
            }
        }
    }

    [[nodiscard]] bool sees(const Box& box) const {
        const glm::dvec3 towards = box.center() - m_map.center;
        const double distance = glm::length(towards), radius = 0.5 * glm::length(box.size());
        const double nearest = distanceTo(box, m_map.center);
        const double sine = radius < distance ? radius / distance : 1.0;
        const double cosine = std::sqrt(1.0 - sine * sine);
        return std::any_of(m_patches.begin(), m_patches.end(), [&](const Patch& p) {
            if (double(p.reach) < nearest)
                return false;
            // The angle between the axes against the sum of the half angles, with a little room.
            const bool apart =
                radius < distance &&
                glm::dot(p.axis, towards) < (p.cosine * cosine - p.sine * sine - 1e-9) * distance;
            return !apart && enters(p, box);
        });
    }

private:
    [[nodiscard]] Patch patch(int face, int column, int row) const {
        const int right = std::min(column + kPatch, m_n) - 1;
        const int bottom = std::min(row + kPatch, m_n) - 1;
        Patch out{face, column, row, glm::dvec3(0.0), 1.0, 0.0, 0.0F};
        const auto corners = {direction(face, column, row), direction(face, right, row),
                              direction(face, column, bottom), direction(face, right, bottom)};
        for (const glm::dvec3& corner : corners)
            out.axis += corner;
        out.axis = glm::normalize(out.axis);
        // A cone is convex: it holds what lies between the corners.
        for (const glm::dvec3& corner : corners)
            out.cosine = std::min(out.cosine, glm::dot(out.axis, corner));
        out.sine = std::sqrt(std::max(0.0, 1.0 - out.cosine * out.cosine));
        for (int r = row; r <= bottom; ++r) {
            for (int c = column; c <= right; ++c)
                out.reach = std::max(out.reach, m_map.distance.at(face, c, r));
        }
        return out;
    }

    [[nodiscard]] bool enters(const Patch& p, const Box& box) const {
        for (int r = p.row; r < std::min(p.row + kPatch, m_n); ++r) {
            for (int c = p.column; c < std::min(p.column + kPatch, m_n); ++c) {
                const double in = entry(m_map.center, direction(p.face, c, r), box);
                if (std::isfinite(in) && in <= double(m_map.distance.at(p.face, c, r)))
                    return true;
            }
        }
        return false;
    }

    [[nodiscard]] glm::dvec3 direction(int face, int column, int row) const {
        return glm::normalize(texelDirection(m_n, face, column, row));
    }

    const ReferenceEnvironmentMap& m_map;
    int m_n;
    std::vector<Patch> m_patches;
};

}  // namespace

std::optional<std::size_t> nearestBoxSeen(const ReferenceEnvironmentMap& map,
                                          std::span<const Box> boxes) {
    const Sight sight(map);
    std::vector<std::pair<double, std::size_t>> order(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        order[i] = {distanceTo(boxes[i], map.center), i};
    std::sort(order.begin(), order.end());
    const auto seen = std::find_if(order.begin(), order.end(),
                                   [&](const auto& one) { return sight.sees(boxes[one.second]); });
    return seen == order.end() ? std::nullopt : std::optional(seen->second);
}

}  // namespace reflet
