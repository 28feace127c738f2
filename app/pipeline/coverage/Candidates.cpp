// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/Candidates.h"

#include "app/pipeline/Edit.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/base/ParallelFor.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace reflet {

namespace {

constexpr double kMayMove = 0.45;     // of the spacing (the rule of DDGI for relocated probes)
constexpr double kShared = 0.4;       // of the spacing: nearer ones are the same place
constexpr double kTurnOver = 15.0;    // metres
constexpr double kTurn = 0.70710678;  // cosine of 45 degrees
constexpr double kJunctionsApart = 10.0;
constexpr double kMeeting = 4.0;   // metres between lines that meet
constexpr double kTogether = 0.9;  // cosine between lines that share a street
const glm::dvec3 kUp(0.0, 0.0, kProbeHeight);

/// Places of which none is nearer to another in the plan than a distance.
class SparsePlaces {
public:
    explicit SparsePlaces(double apart) : m_apart(apart) {}

    bool add(const glm::dvec3& place) {
        const std::int64_t i = cell(place.x), j = cell(place.y);
        for (std::int64_t dj = -1; dj <= 1; ++dj) {
            for (std::int64_t di = -1; di <= 1; ++di) {
                const auto found = m_cells.find({i + di, j + dj});
                if (found == m_cells.end())
                    continue;
                for (const glm::dvec3& other : found->second) {
                    if (glm::distance(other, place) < m_apart)
                        return false;
                }
            }
        }
        m_cells[{i, j}].push_back(place);
        m_places.push_back(place);
        return true;
    }
    [[nodiscard]] std::vector<glm::dvec3> take() { return std::move(m_places); }

private:
    [[nodiscard]] std::int64_t cell(double v) const {
        return std::int64_t(std::floor(v / m_apart));
    }
    double m_apart;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<glm::dvec3>> m_cells;
    std::vector<glm::dvec3> m_places;
};

std::vector<glm::dvec3> wishes(const CoveragePlan& plan, double spacing) {
    SparsePlaces places(kShared * spacing);
    for (const DemandLine& line : plan.lines) {
        for (const double s : line.route->stations(spacing))
            places.add(line.route->at(s) + kUp);
    }
    if (plan.ground) {
        SparsePlaces sparse(spacing);
        for (const glm::dvec3& place : plan.ground->places)
            sparse.add(place + kUp);
        return sparse.take();
    }
    return places.take();
}

bool isForbidden(const PreparedCity& city, const glm::dvec3& place) {
    return std::any_of(city.project().noProbes.begin(), city.project().noProbes.end(),
                       [&](const NoProbeArea& area) {
                           const glm::dvec2 center(city.inFrame(glm::dvec3(area.center, 0.0)));
                           return glm::distance(center, glm::dvec2(place)) <= area.radius;
                       });
}

void remark(Candidates& out, const PreparedCity& city, const char* code, std::size_t count,
            const char* why, const char* remedy) {
    if (count > 0) {
        out.remarks.push_back({Severity::Info, code, city.project().name,
                               fmt::format("{} places were left out: {}.", count, why), remedy});
    }
}

}  // namespace

Result<Candidates> probeCandidates(const PreparedCity& city, const CoveragePlan& plan,
                                   double spacing, const JobContext& job) {
    const auto scene = city.scene(job.phase("city", 0.0, 0.7));
    if (!scene)
        return tl::unexpected(scene.error());
    const std::vector<glm::dvec3> wished = wishes(plan, spacing);
    enum class Fate : std::uint8_t { Taken, Forbidden, InSolid };
    std::vector<Fate> fate(wished.size(), Fate::Taken);
    std::vector<glm::dvec3> places = wished;
    const JobContext testing = job.phase("places", 0.7, 1.0);
    parallelFor(0, wished.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled(); ++i) {
            const auto free = nearestFreePosition(**scene, &city.heightfield(), wished[i]);
            if (!free || glm::distance(*free, wished[i]) > kMayMove * spacing)
                fate[i] = Fate::InSolid;
            else if (isForbidden(city, *free))
                fate[i] = Fate::Forbidden;
            else
                places[i] = *free;
        }
    });
    if (testing.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    testing.progress(1.0);
    Candidates out;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (fate[i] == Fate::Taken)
            out.places.push_back(places[i]);
    }
    remark(out, city, "candidates-in-solids",
           std::size_t(std::count(fate.begin(), fate.end(), Fate::InSolid)),
           "they lie in buildings, and no free place is near",
           "Move the route into the street if that is not meant.");
    remark(out, city, "candidates-forbidden",
           std::size_t(std::count(fate.begin(), fate.end(), Fate::Forbidden)),
           "they lie in circles without probes", "Remove the circle to have them considered.");
    return out;
}

std::vector<glm::dvec3> evenPlaces(const CoveragePlan& plan, std::size_t count) {
    std::vector<glm::dvec3> places;
    if (plan.ground) {
        const auto& ground = plan.ground->places;
        for (std::size_t k = 0; k < count && !ground.empty(); ++k) {
            const double at = (double(k) + 0.5) / double(count) * double(ground.size());
            places.push_back(ground[std::min(std::size_t(at), ground.size() - 1)] + kUp);
        }
        return places;
    }
    double total = 0.0;
    for (const DemandLine& line : plan.lines)
        total += line.route->length();
    for (std::size_t k = 0; k < count; ++k) {
        double at = (double(k) + 0.5) / double(count) * total;
        for (const DemandLine& line : plan.lines) {
            if (at <= line.route->length() || &line == &plan.lines.back()) {
                places.push_back(line.route->at(at) + kUp);
                break;
            }
            at -= line.route->length();
        }
    }
    return places;
}

std::vector<glm::dvec3> junctionPlaces(const CoveragePlan& plan) {
    SparsePlaces places(kJunctionsApart);
    constexpr double kStep = 2.0;
    for (const DemandLine& line : plan.lines) {
        const Route& route = *line.route;
        places.add(route.at(0.0) + kUp);
        places.add(route.at(route.length()) + kUp);
        for (const double s : route.stations(kStep)) {
            const glm::dvec3 before = route.tangent(std::max(0.0, s - 0.5 * kTurnOver));
            const glm::dvec3 after = route.tangent(std::min(route.length(), s + 0.5 * kTurnOver));
            if (glm::dot(before, after) < kTurn)
                places.add(route.at(s) + kUp);
            for (const DemandLine& other : plan.lines) {
                if (&other <= &line)
                    continue;
                for (const double t : other.route->stations(kStep)) {
                    if (glm::distance(route.at(s), other.route->at(t)) < kMeeting &&
                        std::abs(glm::dot(route.tangent(s), other.route->tangent(t))) < kTogether)
                        places.add(route.at(s) + kUp);
                }
            }
        }
    }
    return places.take();
}

}  // namespace reflet
