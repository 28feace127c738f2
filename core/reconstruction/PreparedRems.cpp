// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/PreparedRems.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

/// Texels along the edge of a face of the map that a node looks at: a ray for each.
constexpr int kNodeResolution = 8;
/// Penalty at which a REM serves a ray by half.
constexpr double kHalfService = 0.1;

/// What is seen from a node in one direction.
struct Sight {
    glm::dvec3 direction{0.0};
    double t = 0.0;       ///< +infinity for sky
    double weight = 0.0;  ///< steradians
};

std::vector<Sight> lookAround(const HeightfieldTracer& tracer, const glm::dvec3& position) {
    std::vector<glm::dvec3> directions;
    std::vector<Sight> sights;
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kNodeResolution; ++row) {
            for (int column = 0; column < kNodeResolution; ++column) {
                directions.push_back(texelDirection(kNodeResolution, face, column, row));
                sights.push_back(
                    {directions.back(), 0.0, texelSolidAngle(kNodeResolution, column, row)});
            }
        }
    }
    std::vector<double> t(directions.size());
    tracer.traceFrom(position, directions, {t, {}});
    for (std::size_t i = 0; i < sights.size(); ++i)
        sights[i].t = t[i];
    return sights;
}

/// How well a REM serves what a node sees: 0..1 for each sight, 0 where it is blind.
std::vector<double> servicesOf(const ReferenceEnvironmentMap& rem, const glm::dvec3& position,
                               const std::vector<Sight>& sights, double tolerance) {
    std::vector<double> services;
    services.reserve(sights.size());
    for (const Sight& sight : sights) {
        const bool sky = std::isinf(sight.t);
        const glm::dvec3 point = sky ? position : position + sight.t * sight.direction;
        const bool valid = sky ? isValidSky(rem, sight.direction) : isValid(rem, point, tolerance);
        const double penalty = sky ? 0.0 : sightPenalty(position, rem.center, point);
        services.push_back(valid ? kHalfService / (kHalfService + penalty) : 0.0);
    }
    return services;
}

}  // namespace

PreparedRems::PreparedRems(std::shared_ptr<const HeightfieldTracer> tracer, RemSet rems)
    : m_tracer(std::move(tracer)), m_rems(std::move(rems)) {}

/// Greedy for the sum over sights of weight times the best service; stops where nothing is gained.
PreparedRems::Choice PreparedRems::choose(const glm::dvec3& position, std::size_t most) const {
    const std::vector<std::size_t> pool = nearestRems(m_rems, position, kPool);
    const std::vector<Sight> sights = lookAround(*m_tracer, position);
    const double tolerance = validityTolerance(m_tracer->grid());
    std::vector<std::vector<double>> services;
    for (const std::size_t rem : pool)
        services.push_back(servicesOf(m_rems[rem], position, sights, tolerance));

    Choice chosen;
    std::vector<double> best(sights.size(), 0.0);
    std::vector<bool> taken(pool.size(), false);
    while (chosen.size() < std::min(most, pool.size())) {
        double largest = 0.0;
        std::size_t next = pool.size();
        for (std::size_t k = 0; k < pool.size(); ++k) {
            double gain = 0.0;
            for (std::size_t i = 0; i < sights.size() && !taken[k]; ++i)
                gain += sights[i].weight * std::max(0.0, services[k][i] - best[i]);
            if (gain > largest) {
                largest = gain;
                next = k;
            }
        }
        if (next == pool.size())
            break;
        taken[next] = true;
        chosen.push_back(pool[next]);
        for (std::size_t i = 0; i < sights.size(); ++i)
            best[i] = std::max(best[i], services[next][i]);
    }
    if (chosen.empty() && !pool.empty())
        chosen.push_back(pool.front());  // all are blind: the nearest one stands in
    return chosen;
}

std::shared_ptr<const PreparedRems::Choice> PreparedRems::node(const Key& key) const {
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_nodes.find(key);
        if (found != m_nodes.end())
            return found->second;
    }
    // Outside the lock: two threads may make the same node, and make it alike.
    const glm::dvec3 position =
        kSpacing * glm::dvec3(double(key[0]), double(key[1]), double(key[2]));
    auto made = std::make_shared<const Choice>(choose(position, std::size_t(key[3])));
    const std::lock_guard lock(m_mutex);
    return m_nodes.emplace(key, std::move(made)).first->second;
}

RemCandidates PreparedRems::at(const glm::dvec3& position, const MemSettings& settings) const {
    if (settings.weighting == Weighting::AsInPaper)
        return candidateRems(m_rems, position, settings);
    const glm::dvec3 place = position / kSpacing;
    const glm::dvec3 low = glm::floor(place);
    const glm::dvec3 part = place - low;
    const std::int64_t most = std::clamp(settings.remsPerVehicle, 1, kMostRems);
    std::map<std::size_t, double> presence;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        Key key{0, 0, 0, most};
        for (int axis = 0; axis < 3; ++axis) {
            const int step = (corner >> axis) & 1;
            weight *= step == 1 ? part[axis] : 1.0 - part[axis];
            key[std::size_t(axis)] = std::int64_t(low[axis]) + step;
        }
        if (!(weight > 0.0))
            continue;
        for (const std::size_t rem : *node(key))
            presence[rem] += weight;
    }
    RemCandidates out{settings.weighting, {}};
    for (const auto& [rem, share] : presence)
        out.rems.push_back({rem, std::min(1.0, share)});
    std::stable_sort(out.rems.begin(), out.rems.end(),
                     [](const auto& x, const auto& y) { return x.presence > y.presence; });
    keepMostPresent(out);
    return out;
}

void PreparedRems::prepare(std::span<const glm::dvec3> positions,
                           const MemSettings& settings) const {
    parallelFor(0, positions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            static_cast<void>(at(positions[i], settings));
    });
}

}  // namespace reflet
