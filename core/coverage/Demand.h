// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/BodyReflections.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/traffic/Route.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// Something a vehicle reflects: a ray from its middle that meets the city, or the sky.
struct DemandSample {
    glm::dvec3 vehicle{0.0};       ///< P, project frame
    glm::vec3 direction{0.0F};     ///< unit, from P
    float distance = 0.0F;         ///< |I − P|; +infinity for sky
    glm::vec3 normal{0.0F};        ///< of the surface at I, unit, towards P; zero for sky
    std::uint32_t cell = kNoCell;  ///< of the heightfield, that was met; kNoCell for sky
    std::uint32_t line = 0;        ///< index into the lines that it was drawn from
    float station = 0.0F;          ///< metres along the line

    [[nodiscard]] bool sky() const { return cell == kNoCell; }
    /// I; of a sample that is no sky.
    [[nodiscard]] glm::dvec3 point() const {
        return vehicle + double(distance) * glm::dvec3(direction);
    }
};

/// A way that vehicles take, and what takes its reflections there.
struct DemandLine {
    std::string id;
    std::shared_ptr<const Route> route;                  ///< on the running surface
    std::shared_ptr<const BodyReflections> reflections;  ///< of the vehicle that drives it
    double weight = 1.0;                                 ///< how much a metre of it counts
};

/// Places that vehicles may be at any heading: the cells of drivable ground.
struct DemandGround {
    std::vector<glm::dvec3> places;                      ///< on the ground, project frame
    double cellSize = 1.0;                               ///< metres of ground that each stands for
    std::shared_ptr<const BodyReflections> reflections;  ///< of the vehicle
};

/// From where the vehicles are seen: from the pavement beside them anywhere, and from fixed places
/// (cameras of views), each of which counts where a vehicle is within its reach.
struct Onlookers {
    std::vector<glm::dvec3> eyes;  ///< project frame
    double reach = 150.0;          ///< metres
};

/// What is to be reflected, as samples of the same weight.
///
/// A sample is drawn by a point of a low-discrepancy sequence (QuasiRandom): the place along the
/// lines (or on the ground), who looks, and where to the body mirrors for that onlooker. On half of
/// the samples that eyes are within reach of, one of these looks; else somebody on the pavement, 3
/// to 9 m to one of the sides, up to 25 m ahead or behind, at a height of 1.6 m.
///
/// The samples fall into kRuns runs that are independent of each other: run of sample i is
/// i % kRuns. The first n samples of a longer demand are those of a shorter one.
struct Demand {
    static constexpr std::size_t kRuns = 16;
    std::vector<DemandSample> samples;
};

/// As many samples as wanted, a multiple of Demand::kRuns (rounded up); none where there is neither
/// a line nor a place. In parallel; the same for any number of threads.
[[nodiscard]] Demand sampleDemand(const HeightfieldTracer& tracer,
                                  const std::vector<DemandLine>& lines, const Onlookers& onlookers,
                                  std::size_t count, std::uint64_t seed);
[[nodiscard]] Demand sampleDemand(const HeightfieldTracer& tracer, const DemandGround& ground,
                                  const Onlookers& onlookers, std::size_t count,
                                  std::uint64_t seed);

/// A mean and what it may be off by: the half-width of the 95 % interval by Student's t over the
/// means of the runs.
struct Estimate {
    double mean = 0.0;
    double error = 0.0;
};
/// values: one for each sample of a demand.
[[nodiscard]] Estimate estimateOf(const std::vector<float>& values);

/// The normal of the heightfield's surface where a ray from `from` met a column: of a top by the
/// slope around it, of a wall by where the tall columns around lie, so that oblique walls are no
/// stairs. Towards the ray's origin.
[[nodiscard]] glm::vec3 surfaceNormal(const HeightfieldTracer& tracer, std::uint32_t cell,
                                      const glm::dvec3& point, const glm::dvec3& from);

}  // namespace reflet
