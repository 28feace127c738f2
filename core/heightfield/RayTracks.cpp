// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/RayTracks.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace reflet {

namespace {

/// Components after the last ray that walkTracks() may read.
constexpr std::size_t kSpare = 8;

std::uint64_t mixed(double x, double y) {
    // 0.0 takes the sign from -0.0: the two count as one direction.
    const auto a = std::bit_cast<std::uint64_t>(x + 0.0);
    const auto b = std::bit_cast<std::uint64_t>(y + 0.0);
    return (a ^ std::rotl(b, 32)) * 0x9e3779b97f4a7c15ULL;
}

/// Sorts the rays of a track by their vertical component: few, and mostly nearly in order.
void sortFew(std::span<double> z, std::span<std::uint32_t> ray) {
    for (std::size_t k = 1; k < z.size(); ++k) {
        const double value = z[k];
        const std::uint32_t number = ray[k];
        std::size_t at = k;
        for (; at > 0 && z[at - 1] > value; --at) {
            z[at] = z[at - 1];
            ray[at] = ray[at - 1];
        }
        z[at] = value;
        ray[at] = number;
    }
}

void sortMany(std::span<double> z, std::span<std::uint32_t> ray) {
    if (std::is_sorted(z.begin(), z.end()))
        return;
    std::vector<std::pair<double, std::uint32_t>> both(z.size());
    for (std::size_t k = 0; k < z.size(); ++k)
        both[k] = {z[k], ray[k]};
    std::sort(both.begin(), both.end());
    for (std::size_t k = 0; k < z.size(); ++k) {
        z[k] = both[k].first;
        ray[k] = both[k].second;
    }
}

void sortTrack(std::span<double> z, std::span<std::uint32_t> ray) {
    constexpr std::size_t few = 48;
    if (z.size() > 1)
        (z.size() <= few ? sortFew : sortMany)(z, ray);
}

/// Whether one component of a ray can belong to a ray that hits: 0·inf and 0·NaN are NaN.
bool isFinite(double origin, double direction) {
    return 0.0 * (origin + direction) == 0.0;
}

}  // namespace

bool canHit(const glm::dvec3& origin, const glm::dvec3& direction) {
    return isFinite(origin.x, direction.x) && isFinite(origin.y, direction.y) &&
           isFinite(origin.z, direction.z) && direction != glm::dvec3(0.0);
}

void RayTracks::clear() {
    m_tracks.clear();
    m_abreast = false;
    m_directionZ.clear();
    m_ray.clear();
}

void RayTracks::addSingle(std::span<const Ray> rays) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const auto& [origin, direction] = rays[k];
        if (!canHit(origin, direction))
            continue;
        const auto at = std::uint32_t(m_ray.size());
        m_tracks.push_back({origin.x, origin.y, origin.z, direction.x, direction.y, at, at + 1});
        m_directionZ.push_back(direction.z);
        m_ray.push_back(std::uint32_t(k));
    }
}

inline std::uint32_t RayTracks::groupOf(double x, double y) {
    const std::size_t mask = m_slot.size() - 1;
    const int shift = 64 - std::bit_width(mask);
    for (std::size_t at = mixed(x, y) >> unsigned(shift);; at = (at + 1) & mask) {
        std::uint32_t& slot = m_slot[at];
        if (slot == 0) {
            m_groups.push_back({x, y, kNone, 0});
            slot = std::uint32_t(m_groups.size());
        }
        const Group& group = m_groups[slot - 1];
        if (group.x == x && group.y == y)
            return slot - 1;
    }
}

void RayTracks::addGrouped(const glm::dvec3& origin, std::span<const glm::dvec3> directions) {
    m_groups.clear();
    m_slot.assign(std::bit_ceil(2 * directions.size() + 2), 0);
    m_groupOfRay.resize(directions.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        m_groupOfRay[k] = kNone;
        if (!canHit(origin, directions[k]))
            continue;
        const std::uint32_t group = groupOf(directions[k].x, directions[k].y);
        m_groupOfRay[k] = group;
        ++m_groups[group].count;
        ++count;
    }
    auto end = std::uint32_t(m_ray.size());
    for (Group& group : m_groups) {
        group.next = end;
        end += group.count;
    }
    m_directionZ.resize(m_directionZ.size() + count);
    m_ray.resize(m_ray.size() + count);
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (m_groupOfRay[k] == kNone)
            continue;
        const std::uint32_t at = m_groups[m_groupOfRay[k]].next++;
        m_directionZ[at] = directions[k].z;
        m_ray[at] = std::uint32_t(k);
    }
    for (const Group& group : m_groups)
        addTrack(origin, group.x, group.y, group.next - group.count, group.next);
}

void RayTracks::addTrack(const glm::dvec3& origin, double x, double y, std::uint32_t first,
                         std::uint32_t last) {
    sortTrack(std::span(m_directionZ).subspan(first, last - first),
              std::span(m_ray).subspan(first, last - first));
    m_tracks.push_back({origin.x, origin.y, origin.z, x, y, first, last});
}

void RayTracks::addGrid(const glm::dvec3& origin, const DirectionGrid& directions,
                        std::size_t first, std::size_t last) {
    const bool alongRows = directions.alongRows();
    if (!alongRows && !directions.alongColumns())
        return addGridSingly(origin, directions, first, last);
    const std::size_t columns = directions.column.size();
    m_line.clear();
    for (std::size_t k = 0; k < (alongRows ? columns : directions.row.size()); ++k) {
        const glm::dvec3 direction = alongRows ? directions.at(k, first) : directions.at(first, k);
        if (isFinite(origin.z, direction.z))
            m_line.push_back({direction.z, std::uint32_t(alongRows ? k : k * columns)});
    }
    std::sort(m_line.begin(), m_line.end());
    for (std::size_t line = first; line < last && !m_line.empty(); ++line) {
        const glm::dvec3 way = alongRows ? directions.at(0, line) : directions.at(line, 0);
        if (!isFinite(origin.x, way.x) || !isFinite(origin.y, way.y))
            continue;
        const auto begin = std::uint32_t(m_ray.size());
        const auto number = std::uint32_t(alongRows ? line * columns : line);
        for (const auto& [z, offset] : m_line) {
            if (z == 0.0 && way.x == 0.0 && way.y == 0.0)
                continue;  // no direction
            m_directionZ.push_back(z);
            m_ray.push_back(number + offset);
        }
        if (begin < m_ray.size())
            m_tracks.push_back(
                {origin.x, origin.y, origin.z, way.x, way.y, begin, std::uint32_t(m_ray.size())});
    }
}

void RayTracks::addGridSingly(const glm::dvec3& origin, const DirectionGrid& directions,
                              std::size_t firstColumn, std::size_t lastColumn) {
    m_abreast = true;
    const std::size_t columns = directions.column.size();
    for (std::size_t r = 0; r < directions.row.size(); ++r) {
        for (std::size_t c = firstColumn; c < lastColumn; ++c) {
            const glm::dvec3 direction = directions.at(c, r);
            if (!canHit(origin, direction))
                continue;
            const auto at = std::uint32_t(m_ray.size());
            m_directionZ.push_back(direction.z);
            m_ray.push_back(std::uint32_t(r * columns + c));
            m_tracks.push_back(
                {origin.x, origin.y, origin.z, direction.x, direction.y, at, at + 1});
        }
    }
}

TrackBatch RayTracks::batch(double* t, std::uint32_t* cell) {
    m_directionZ.resize(m_ray.size() + kSpare);
    return {m_tracks, m_directionZ.data(), m_ray.data(), t, cell, m_abreast};
}

}  // namespace reflet
