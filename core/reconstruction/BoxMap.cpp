// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/BoxMap.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeSampler.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

constexpr int kTurns = 18;
constexpr int kRounds = 3;
constexpr int kFitResolution = 32;     ///< directions along a face's edge are enough for medians
constexpr double kNearestSide = 0.05;  ///< metres; a REM in a corner still has a box

/// A direction of the REM with what it met.
struct Sample {
    glm::dvec3 direction{0.0};  ///< unit
    double distance = 0.0;      ///< metres, +infinity for sky
    double weight = 0.0;        ///< solid angle
};

std::vector<Sample> samplesOf(const CubeMap<float>& distance) {
    const int n = distance.resolution();
    const int step = std::max(1, n / kFitResolution);
    std::vector<Sample> samples;
    for (int face = 0; face < 6; ++face) {
        for (int row = step / 2; row < n; row += step) {
            for (int column = step / 2; column < n; column += step) {
                samples.push_back({glm::normalize(texelDirection(n, face, column, row)),
                                   double(distance.at(face, column, row)),
                                   texelSolidAngle(n, column, row)});
            }
        }
    }
    return samples;
}

/// Turned about z, counterclockwise seen from above; by −yaw into the box's axes.
glm::dvec3 turned(double angle, const glm::dvec3& v) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/// The side that a ray from a point inside leaves by, and its parameter there.
struct Exit {
    std::size_t side = 0;
    double t = kInfinity;
};

/// All in the box's axes.
Exit exitOf(const FittedBox& box, const glm::dvec3& point, const glm::dvec3& direction) {
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0)
            continue;
        const auto side = std::size_t(2 * axis + (direction[axis] > 0.0 ? 0 : 1));
        const double plane = direction[axis] > 0.0 ? box.distance[side] : -box.distance[side];
        const double t = (plane - point[axis]) / direction[axis];
        if (t < exit.t)
            exit = {side, t};
    }
    return exit;
}

std::size_t dominantSide(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return std::size_t(2 * axis + (v[axis] > 0.0 ? 0 : 1));
}

/// Weighted points of a side along its axis.
struct SideSamples {
    std::vector<std::pair<double, double>> offsets;  ///< metres, weight
    double seen = 0.0, sky = 0.0;                    ///< weights

    [[nodiscard]] double median() {
        if (!(seen > sky))
            return kInfinity;
        std::sort(offsets.begin(), offsets.end());
        double passed = 0.0;
        for (const auto& [offset, weight] : offsets) {
            passed += weight;
            if (passed >= 0.5 * seen)
                return std::max(offset, kNearestSide);
        }
        return kInfinity;
    }
};

/// Planes for axes turned by `yaw`; sides: which side each sample belongs to.
FittedBox boxOf(double yaw, const std::vector<Sample>& samples,
                const std::vector<std::size_t>& sides) {
    std::array<SideSamples, 6> gathered;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        SideSamples& side = gathered[sides[i]];
        if (std::isinf(samples[i].distance)) {
            side.sky += samples[i].weight;
            continue;
        }
        side.seen += samples[i].weight;
        const glm::dvec3 hit = samples[i].distance * turned(-yaw, samples[i].direction);
        side.offsets.emplace_back(std::abs(hit[int(sides[i] / 2)]), samples[i].weight);
    }
    FittedBox box;
    box.yaw = yaw;
    for (std::size_t side = 0; side < 6; ++side)
        box.distance[side] = gathered[side].median();
    return box;
}

/// Mean |log(box distance / REM distance)| over the directions that meet a surface; an open side
/// counts as tenfold.
double misfit(const FittedBox& box, const std::vector<Sample>& samples) {
    double sum = 0.0;
    double weight = 0.0;
    for (const Sample& sample : samples) {
        if (std::isinf(sample.distance))
            continue;
        const double t = exitOf(box, glm::dvec3(0.0), turned(-box.yaw, sample.direction)).t;
        const double ratio = std::log(t / std::max(sample.distance, 1e-6));
        sum += sample.weight * std::min(std::abs(ratio), std::log(10.0));
        weight += sample.weight;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

FittedBox fitTurned(double yaw, const std::vector<Sample>& samples) {
    std::vector<std::size_t> sides;
    sides.reserve(samples.size());
    for (const Sample& sample : samples)
        sides.push_back(dominantSide(turned(-yaw, sample.direction)));
    FittedBox box = boxOf(yaw, samples, sides);
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const glm::dvec3 direction = turned(-yaw, samples[i].direction);
            const Exit exit = exitOf(box, glm::dvec3(0.0), direction);
            sides[i] = std::isinf(exit.t) ? dominantSide(direction) : exit.side;
        }
        box = boxOf(yaw, samples, sides);
    }
    return box;
}

/// Lookups of one REM through its box.
class BoxLookup {
public:
    BoxLookup(const ReferenceEnvironmentMap& rem, const FittedBox& box, const glm::dvec3& position)
        : m_rem(rem), m_box(box), m_offset(position - rem.center) {}

    /// The vector from the REM's centre for a direction from P, and the distance from P.
    struct Found {
        glm::dvec3 lookup{0.0};
        double distance = kInfinity;
    };
    [[nodiscard]] Found find(const glm::dvec3& unit) const {
        const auto point = leaveBox(m_box, m_offset, unit);
        if (!point)
            return {unit, kInfinity};
        if (!showsSky(*point))
            return {*point, glm::distance(*point, m_offset)};
        return {showsSky(unit) ? unit : *point, kInfinity};
    }

private:
    [[nodiscard]] bool showsSky(const glm::dvec3& direction) const {
        const Texel texel = texelAt(m_rem.distance.resolution(), direction);
        return std::isinf(m_rem.distance.at(texel.face, texel.column, texel.row));
    }

    const ReferenceEnvironmentMap& m_rem;
    const FittedBox& m_box;
    glm::dvec3 m_offset;
};

}  // namespace

FittedBox fitBox(const ReferenceEnvironmentMap& rem) {
    const std::vector<Sample> samples = samplesOf(rem.distance);
    FittedBox best;
    double least = kInfinity;
    for (int turn = 0; turn < kTurns; ++turn) {
        const FittedBox box = fitTurned(0.5 * std::numbers::pi * turn / kTurns, samples);
        const double error = misfit(box, samples);
        if (error < least) {
            least = error;
            best = box;
        }
    }
    return best;
}

std::optional<glm::dvec3> leaveBox(const FittedBox& box, const glm::dvec3& pointFromCenter,
                                   const glm::dvec3& direction) {
    constexpr double kInside = 1.0 - 1e-3;
    glm::dvec3 point = turned(-box.yaw, pointFromCenter);
    for (int axis = 0; axis < 3; ++axis) {
        const auto side = std::size_t(2 * axis);
        point[axis] = std::clamp(point[axis], -kInside * box.distance[side + 1],
                                 kInside * box.distance[side]);
    }
    const glm::dvec3 along = turned(-box.yaw, direction);
    const double t = exitOf(box, point, along).t;
    if (std::isinf(t))
        return std::nullopt;
    return turned(box.yaw, point + t * along);
}

LocalEnvironmentMap reconstructBox(const ReconstructionInput& input, const glm::dvec3& position,
                                   int resolution, TexelSources* sources) {
    const RemChoice choice = chooseRems(input.rems, position);
    if (!choice.a)
        return reconstructNearest(input, position, resolution, sources);
    const ReferenceEnvironmentMap& rem = input.rems[*choice.a];
    const FittedBox box = fitBox(rem);
    const auto start = std::chrono::steady_clock::now();
    LocalEnvironmentMap map;
    map.center = position;
    map.radiance = CubeMap<glm::vec3>(resolution);
    map.distance = CubeMap<float>(resolution, kInfinity);
    map.uncovered = CubeMap<unsigned char>(resolution, 0);
    if (sources)
        *sources = TexelSources(resolution);
    const BoxLookup lookup(rem, box, position);
    const CubeSampler sampler(rem.radiance);
    const auto rows = std::size_t(resolution);
    parallelFor(0, 6 * rows, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line / rows);
            const int row = int(line % rows);
            for (int column = 0; column < resolution; ++column) {
                const glm::dvec3 direction =
                    glm::normalize(texelDirection(resolution, face, column, row));
                const BoxLookup::Found found = lookup.find(direction);
                map.radiance.at(face, column, row) =
                    toVec3(sampler.sample(glm::vec3(found.lookup)));
                map.distance.at(face, column, row) = float(found.distance);
                if (sources) {
                    sources->at(face, column, row)[0] = {std::int32_t(*choice.a), 1.0F,
                                                         glm::vec3(found.lookup)};
                }
            }
        }
    });
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    map.statistics.milliseconds = elapsed.count();
    return map;
}

}  // namespace reflet
