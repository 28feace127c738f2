// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/Demand.h"

#include "core/base/ParallelFor.h"
#include "core/coverage/QuasiRandom.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

constexpr double kEyeHeight = 1.6;    // metres
constexpr double kNearestKerb = 3.0;  // metres beside a vehicle's middle line
constexpr double kFarthestKerb = 9.0;
constexpr double kAlongPavement = 25.0;
constexpr double kShareOfEyes = 0.5;
/// Half the two-sided 95 % width of Student's t with kRuns - 1 = 15 degrees of freedom.
constexpr double kStudent = 2.131;
static_assert(Demand::kRuns == 16);
constexpr std::size_t kGrain = 256;  // samples to a task

using Sequence = QuasiRandom<6>;

/// Where a vehicle is and which way it goes.
struct Standing {
    glm::dvec3 ground{0.0};
    glm::dvec2 heading{1.0, 0.0};
    const BodyReflections* reflections = nullptr;
    std::uint32_t line = 0;
    float station = 0.0F;
};

/// A direction of the vehicle's frame and one of the project's.
glm::dvec3 toProject(const glm::dvec3& v, const glm::dvec2& heading) {
    return {heading.x * v.x - heading.y * v.y, heading.y * v.x + heading.x * v.y, v.z};
}
glm::dvec3 toVehicle(const glm::dvec3& v, const glm::dvec2& heading) {
    return {heading.x * v.x + heading.y * v.y, -heading.y * v.x + heading.x * v.y, v.z};
}

/// The eye that looks, in the vehicle's frame.
glm::dvec3 eyeFor(const Standing& standing, const Onlookers& onlookers, double who, double where) {
    std::vector<glm::dvec3> near;
    for (const glm::dvec3& eye : onlookers.eyes) {
        if (glm::distance(eye, standing.ground) < onlookers.reach)
            near.push_back(eye);
    }
    if (!near.empty() && who < kShareOfEyes) {
        const auto one = std::size_t(who / kShareOfEyes * double(near.size()));
        return toVehicle(near[std::min(one, near.size() - 1)] - standing.ground, standing.heading);
    }
    // What is left of `who` says the side and how far from it, `where` how far ahead.
    const double rest = near.empty() ? who : (who - kShareOfEyes) / (1.0 - kShareOfEyes);
    const double side = rest < 0.5 ? -1.0 : 1.0;
    const double apart = 2.0 * rest - std::floor(2.0 * rest);
    return {kAlongPavement * (2.0 * where - 1.0),
            side * (kNearestKerb + apart * (kFarthestKerb - kNearestKerb)), kEyeHeight};
}

template <class Stand>
Demand sample(const HeightfieldTracer& tracer, const Onlookers& onlookers, std::size_t count,
              std::uint64_t seed, const Stand& stand) {
    std::vector<Sequence> runs;
    for (std::size_t r = 0; r < Demand::kRuns; ++r)
        runs.emplace_back(seed * Demand::kRuns + r);
    const std::size_t each = (count + Demand::kRuns - 1) / Demand::kRuns;
    Demand demand;
    demand.samples.resize(each * Demand::kRuns);
    parallelFor(0, demand.samples.size(), kGrain, [&](std::size_t first, std::size_t last) {
        std::vector<Ray> rays;
        for (std::size_t i = first; i < last; ++i) {
            const Sequence::Point x = runs[i % Demand::kRuns].at(i / Demand::kRuns);
            const Standing standing = stand(x[0], x[5]);
            const glm::dvec3 eye = eyeFor(standing, onlookers, x[1], x[2]);
            const glm::dvec3 direction = standing.reflections->direction(eye, {x[3], x[4]});
            DemandSample& s = demand.samples[i];
            s.vehicle =
                standing.ground + glm::dvec3(0.0, 0.0, standing.reflections->centerHeight());
            s.direction = glm::vec3(toProject(direction, standing.heading));
            s.line = standing.line;
            s.station = standing.station;
            rays.push_back({s.vehicle, glm::dvec3(s.direction)});
        }
        std::vector<double> t(rays.size());
        std::vector<std::uint32_t> cell(rays.size());
        tracer.trace(rays, RayHits{t, cell});
        for (std::size_t i = first; i < last; ++i) {
            DemandSample& s = demand.samples[i];
            s.cell = cell[i - first];
            s.distance = float(t[i - first]);
            if (!s.sky())
                s.normal = surfaceNormal(tracer, s.cell, s.point(), s.vehicle);
        }
    });
    return demand;
}

float heightOf(const HeightfieldTracer& tracer, int i, int j) {
    const GridSpec& grid = tracer.grid();
    return tracer
        .layer()[grid.index(std::clamp(i, 0, grid.columns - 1), std::clamp(j, 0, grid.rows - 1))];
}

}  // namespace

glm::vec3 surfaceNormal(const HeightfieldTracer& tracer, std::uint32_t cell,
                        const glm::dvec3& point, const glm::dvec3& from) {
    const GridSpec& grid = tracer.grid();
    const int column = int(cell % std::uint32_t(grid.columns));
    const int row = int(cell / std::uint32_t(grid.columns));
    const double top = double(tracer.layer()[cell]);
    const double s = grid.cellSize;
    glm::dvec3 normal(0.0);
    if (point.z < top - 1e-3 * s) {
        // A wall: away from the columns around that are as high as the point.
        constexpr int reach = 2;
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                if (double(heightOf(tracer, column + i, row + j)) > point.z)
                    normal -= glm::dvec3(double(i), double(j), 0.0);
            }
        }
    } else {
        // A top: steps to other things are no slopes.
        const auto slope = [&](int i, int j) {
            const double rise = double(heightOf(tracer, column + i, row + j)) - top;
            return std::abs(rise) < 2.0 * s ? rise / s : 0.0;
        };
        normal = {0.5 * (slope(-1, 0) - slope(1, 0)), 0.5 * (slope(0, -1) - slope(0, 1)), 1.0};
    }
    const glm::dvec3 towards = from - point;
    const double length = glm::length(normal);
    // Nothing told (a lone post, a wall on all sides), or a stair: what was met faces the ray.
    if (!(length > 0.0) || !(glm::dot(normal, towards) > 0.0))
        normal = towards;
    return glm::vec3(glm::normalize(normal));
}

Demand sampleDemand(const HeightfieldTracer& tracer, const std::vector<DemandLine>& lines,
                    const Onlookers& onlookers, std::size_t count, std::uint64_t seed) {
    std::vector<double> ends;
    double total = 0.0;
    for (const DemandLine& line : lines) {
        total += line.weight * line.route->length();
        ends.push_back(total);
    }
    if (!(total > 0.0))
        return {};
    return sample(tracer, onlookers, count, seed, [&](double along, double) {
        const double place = along * total;
        const auto found = std::upper_bound(ends.begin(), ends.end() - 1, place);
        const auto index = std::size_t(found - ends.begin());
        const DemandLine& line = lines[index];
        const double before = index > 0 ? ends[index - 1] : 0.0;
        const double station = (place - before) / line.weight;
        return Standing{line.route->at(station), glm::dvec2(line.route->tangent(station)),
                        line.reflections.get(), std::uint32_t(index), float(station)};
    });
}

Demand sampleDemand(const HeightfieldTracer& tracer, const DemandGround& ground,
                    const Onlookers& onlookers, std::size_t count, std::uint64_t seed) {
    if (ground.places.empty())
        return {};
    return sample(tracer, onlookers, count, seed, [&](double which, double turn) {
        const auto index =
            std::min(std::size_t(which * double(ground.places.size())), ground.places.size() - 1);
        const double angle = 2.0 * std::numbers::pi * turn;
        return Standing{ground.places[index],
                        {std::cos(angle), std::sin(angle)},
                        ground.reflections.get(),
                        0,
                        0.0F};
    });
}

Estimate estimateOf(const std::vector<float>& values) {
    if (values.empty())
        return {};
    std::array<double, Demand::kRuns> sums{};
    std::array<std::size_t, Demand::kRuns> counts{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        sums[i % Demand::kRuns] += double(values[i]);
        ++counts[i % Demand::kRuns];
    }
    double mean = 0.0, squares = 0.0;
    for (std::size_t r = 0; r < sums.size(); ++r) {
        const double one = counts[r] > 0 ? sums[r] / double(counts[r]) : 0.0;
        mean += one / double(Demand::kRuns);
        squares += one * one;
    }
    constexpr double n = double(Demand::kRuns);
    const double variance = std::max(0.0, (squares - n * mean * mean) / (n - 1.0));
    return {mean, kStudent * std::sqrt(variance / n)};
}

}  // namespace reflet
