// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/RayTracks.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace reflet {

namespace {

std::uint64_t mixed(double x, double y) {
    // 0.0 takes the sign from -0.0: the two count as one direction.
    const auto a = std::bit_cast<std::uint64_t>(x + 0.0);
    const auto b = std::bit_cast<std::uint64_t>(y + 0.0);
    return (a ^ std::rotl(b, 32)) * 0x9e3779b97f4a7c15ULL;
}

/// Sorts the rays of a track by their vertical component. They mostly come in order, upwards or
/// downwards.
void sortTrack(std::span<double> z, std::span<std::uint32_t> ray) {
    if (std::is_sorted(z.begin(), z.end()))
        return;
    std::reverse(z.begin(), z.end());
    std::reverse(ray.begin(), ray.end());
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

}  // namespace

bool canHit(const glm::dvec3& origin, const glm::dvec3& direction) {
    // 0·inf and 0·NaN are NaN.
    const glm::dvec3 zero = 0.0 * (origin + direction);
    return zero == glm::dvec3(0.0) && direction != glm::dvec3(0.0);
}

void RayTracks::clear() {
    m_tracks.clear();
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

std::uint32_t RayTracks::groupOf(double x, double y) {
    const std::size_t mask = m_slot.size() - 1;
    const int shift = 64 - std::bit_width(mask);
    for (std::size_t at = mixed(x, y) >> unsigned(shift);; at = (at + 1) & mask) {
        std::uint32_t& slot = m_slot[at];
        if (slot == 0) {
            m_groups.push_back({x, y, kNone});
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
    m_before.resize(directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (!canHit(origin, directions[k]))
            continue;
        Group& group = m_groups[groupOf(directions[k].x, directions[k].y)];
        m_before[k] = group.latest;
        group.latest = std::uint32_t(k);
    }
    for (const Group& group : m_groups)
        addTrack(origin, group, directions);
}

void RayTracks::addTrack(const glm::dvec3& origin, const Group& group,
                         std::span<const glm::dvec3> directions) {
    const auto first = std::uint32_t(m_ray.size());
    for (std::uint32_t k = group.latest; k != kNone; k = m_before[k]) {
        m_directionZ.push_back(directions[k].z);
        m_ray.push_back(k);
    }
    closeTrack(origin, group.x, group.y, first);
}

void RayTracks::closeTrack(const glm::dvec3& origin, double x, double y, std::uint32_t first) {
    const auto last = std::uint32_t(m_ray.size());
    if (first == last)
        return;
    sortTrack(std::span(m_directionZ).subspan(first), std::span(m_ray).subspan(first));
    m_tracks.push_back({origin.x, origin.y, origin.z, x, y, first, last});
}

void RayTracks::addGrid(const glm::dvec3& origin, const DirectionGrid& directions,
                        std::size_t first, std::size_t last) {
    const bool alongRows = directions.columnAxis.z != 0.0 && directions.rowAxis.z == 0.0;
    const bool alongColumns = directions.columnAxis.z == 0.0 && directions.rowAxis.z != 0.0;
    const std::size_t columns = directions.column.size();
    const std::size_t others = alongRows ? columns : directions.row.size();
    for (std::size_t line = first; line < last; ++line) {
        auto begin = std::uint32_t(m_ray.size());
        for (std::size_t other = 0; other < others; ++other) {
            const std::size_t c = alongRows ? other : line;
            const std::size_t r = alongRows ? line : other;
            const glm::dvec3 direction = directions.at(c, r);
            if (!canHit(origin, direction))
                continue;
            m_directionZ.push_back(direction.z);
            m_ray.push_back(std::uint32_t(r * columns + c));
            if (!alongRows && !alongColumns) {
                closeTrack(origin, direction.x, direction.y, begin);
                ++begin;
            }
        }
        if ((alongRows || alongColumns) && begin < m_ray.size()) {
            const glm::dvec3 direction =
                alongRows ? directions.at(0, line) : directions.at(line, 0);
            closeTrack(origin, direction.x, direction.y, begin);
        }
    }
}

TrackBatch RayTracks::batch(double* t, std::uint32_t* cell) {
    return {m_tracks, m_directionZ.data(), m_ray.data(), t, cell};
}

}  // namespace reflet
