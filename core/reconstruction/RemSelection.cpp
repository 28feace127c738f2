// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/RemSelection.h"

#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return glm::dot(d, d);
}

/// A REM and how far it is from a position; equal distances go by id, equal ids by index.
struct Entry {
    double distance;  ///< squared
    std::size_t rem;
};
bool isNearer(const RemSet& rems, const Entry& x, const Entry& y) {
    if (x.distance != y.distance)
        return x.distance < y.distance;
    const int order = rems[x.rem].id.compare(rems[y.rem].id);
    return order != 0 ? order < 0 : x.rem < y.rem;
}

/// The nearest REM for which accept(index) holds.
template <class Accept>
std::optional<std::size_t> nearestRem(const RemSet& rems, const glm::dvec3& position,
                                      const Accept& accept) {
    std::optional<Entry> best;
    for (std::size_t i = 0; i < rems.size(); ++i) {
        if (!accept(i))
            continue;
        const Entry entry{squaredDistance(rems[i].center, position), i};
        if (!best || isNearer(rems, entry, *best))
            best = entry;
    }
    return best ? std::optional(best->rem) : std::nullopt;
}

/// Share of the way to the first REM left out over which a candidate fades.
constexpr double kFading = 0.25;
/// What a metre that a REM is farther from the point than the vehicle counts, for each metre
/// between the point and the vehicle; against the angle at the point, in radians. Measured.
constexpr double kFartherCost = 1.0;
/// Keeps weights finite where a REM stands at the vehicle.
constexpr double kLeastPenalty = 1e-6;

}  // namespace

RemChoice chooseRems(const RemSet& rems, const glm::dvec3& position) {
    RemChoice choice;
    choice.a = nearestRem(rems, position, [](std::size_t) { return true; });
    if (!choice.a)
        return choice;
    const std::size_t a = *choice.a;
    const glm::dvec3 towardsA = rems[a].center - position;
    choice.b = nearestRem(rems, position, [&](std::size_t i) {
        return i != a && glm::dot(towardsA, rems[i].center - position) < 0.0;
    });
    if (!choice.b)
        choice.b = nearestRem(rems, position, [&](std::size_t i) { return i != a; });
    return choice;
}

std::vector<std::size_t> nearestRems(const RemSet& rems, const glm::dvec3& position,
                                     std::size_t most) {
    std::vector<Entry> entries;
    entries.reserve(rems.size());
    for (std::size_t i = 0; i < rems.size(); ++i)
        entries.push_back({squaredDistance(rems[i].center, position), i});
    const auto count = std::ptrdiff_t(std::min(most, entries.size()));
    std::partial_sort(entries.begin(), entries.begin() + count, entries.end(),
                      [&](const Entry& x, const Entry& y) { return isNearer(rems, x, y); });
    std::vector<std::size_t> nearest;
    for (std::ptrdiff_t i = 0; i < count; ++i)
        nearest.push_back(entries[std::size_t(i)].rem);
    return nearest;
}

void keepMostPresent(RemCandidates& candidates) {
    if (candidates.rems.size() <= kMostCandidates)
        return;
    // Presences add up to kMostRems at most, so that this one is below 1.
    const double least = candidates.rems[kMostCandidates].presence;
    candidates.rems.resize(kMostCandidates);
    std::erase_if(candidates.rems, [&](const RemCandidate& c) { return c.presence <= least; });
    for (RemCandidate& candidate : candidates.rems)
        candidate.presence = (candidate.presence - least) / (1.0 - least);
}

RemCandidates candidateRems(const RemSet& rems, const glm::dvec3& position,
                            const MemSettings& settings) {
    RemCandidates out{settings.weighting, {}};
    if (settings.weighting == Weighting::AsInPaper) {
        const RemChoice choice = chooseRems(rems, position);
        for (const auto& rem : {choice.a, choice.b}) {
            if (rem)
                out.rems.push_back({*rem, 1.0});
        }
        return out;
    }
    const auto most = std::size_t(std::clamp(settings.remsPerVehicle, 1, kMostRems));
    std::vector<std::size_t> nearest = nearestRems(rems, position, most + 1);
    const bool leavesOneOut = nearest.size() > most;
    const double end = leavesOneOut ? glm::distance(rems[nearest[most]].center, position) : 0.0;
    nearest.resize(std::min(nearest.size(), most));
    for (const std::size_t rem : nearest) {
        const double room = end - glm::distance(rems[rem].center, position);
        const double presence = leavesOneOut ? std::min(1.0, room / (kFading * end)) : 1.0;
        if (presence > 0.0 || out.rems.empty())  // as many at the same distance: one must stay
            out.rems.push_back({rem, presence > 0.0 ? presence : 1.0});
    }
    return out;
}

double blendParameter(const glm::dvec3& centerA, const glm::dvec3& centerB,
                      const glm::dvec3& point) {
    const glm::dvec3 axis = centerB - centerA;
    const double squaredLength = glm::dot(axis, axis);
    if (!(squaredLength > 0.0))
        return 0.0;
    return std::clamp(glm::dot(point - centerA, axis) / squaredLength, 0.0, 1.0);
}

bool isValid(const ReferenceEnvironmentMap& rem, const glm::dvec3& point, double epsilon) {
    const glm::dvec3 direction = point - rem.center;
    const double distance = glm::length(direction);
    if (!(distance > epsilon))
        return true;
    return seenDistance(rem, direction) >= distance - epsilon;
}

bool isValidSky(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction) {
    return std::isinf(seenDistance(rem, direction));
}

double seenDistance(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction) {
    const CubeMap<float>& distance = rem.distance;
    const int n = distance.resolution();
    const FacePoint point = facePoint(direction);
    const double x = (point.st.x + 1.0) * 0.5 * n - 0.5;
    const double y = (point.st.y + 1.0) * 0.5 * n - 0.5;
    if (x >= 0.0 && y >= 0.0 && x < n - 1 && y < n - 1) {
        const float* texel = &distance.at(point.face, int(x), int(y));
        return double(std::max(std::max(texel[0], texel[1]), std::max(texel[n], texel[n + 1])));
    }
    float largest = -std::numeric_limits<float>::infinity();
    for (const Texel& texel : bilinearFootprint(n, point).texel)
        largest = std::max(largest, distance.at(texel.face, texel.column, texel.row));
    return double(largest);
}

double sightPenalty(const glm::dvec3& position, const glm::dvec3& center, const glm::dvec3& point) {
    const glm::dvec3 fromPosition = point - position;
    const glm::dvec3 fromCenter = point - center;
    const double near = glm::length(fromPosition);
    const double far = glm::length(fromCenter);
    if (!(near > 0.0) || !(far > 0.0))
        return near > far ? kLeastPenalty : 2.0;
    const double cosine = glm::dot(fromPosition, fromCenter) / (near * far);
    const double chord = std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine));
    return chord + kFartherCost * std::max(0.0, far / near - 1.0) + kLeastPenalty;
}

}  // namespace reflet
