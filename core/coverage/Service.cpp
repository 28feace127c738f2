// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/Service.h"

#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/RemSelection.h"
#include "core/reconstruction/TexelRays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace reflet {

namespace {

constexpr double kIndexCell = 20.0;      // metres
constexpr double kLeastDistance = 1e-3;  // metres; keeps quotients finite
constexpr double kLeastCosine = 1e-3;

}  // namespace

ServiceRule::ServiceRule(const GridSpec& grid, int resolutionOfRems)
    : resolution(resolutionOfRems),
      tolerance(validityTolerance(grid)),
      depthError(0.5 * grid.cellSize) {}

double ServiceRule::likeness(const DemandSample& sample, const ReferenceEnvironmentMap& rem) const {
    const glm::dvec3& center = rem.center;
    const glm::dvec3 apart = sample.vehicle - center;
    if (glm::dot(apart, apart) > kReach * kReach)
        return 0.0;
    if (sample.sky())
        return 1.0;
    const glm::dvec3 point = sample.point();
    const glm::dvec3 toCenter = center - point;
    const double near = std::max(double(sample.distance), kLeastDistance);
    const double far = std::max(glm::length(toCenter), kLeastDistance);
    const glm::dvec3 normal(sample.normal);
    const double cosineNear =
        std::max(-glm::dot(normal, glm::dvec3(sample.direction)), kLeastCosine);
    const double cosineFar = std::max(glm::dot(normal, toCenter) / far, 0.0);
    if (!(cosineFar > 0.0))
        return 0.0;  // C sees its other side, if at all
    const double blur = far / near * std::sqrt(cosineNear / cosineFar);
    const double sine = glm::length(glm::cross(toCenter, glm::dvec3(sample.direction))) / far;
    const int texels = resolution > 0 ? resolution : rem.distance.resolution();
    const double texel = 0.5 * std::numbers::pi / double(texels);
    const double shift = depthError * sine / (far * texel);
    const double left = std::min(1.0, kFree / blur) * std::min(1.0, kFree / shift);
    return left >= kLeast ? left : 0.0;
}

double ServiceRule::service(const DemandSample& sample, const ReferenceEnvironmentMap& rem) const {
    const double left = likeness(sample, rem);
    if (!(left > 0.0))
        return 0.0;
    const bool visible = sample.sky() ? isValidSky(rem, glm::dvec3(sample.direction))
                                      : isValid(rem, sample.point(), tolerance);
    return visible ? left : 0.0;
}

ReferenceEnvironmentMap sightFrom(const HeightfieldTracer& tracer, const glm::dvec3& center,
                                  int resolution, std::string id) {
    ReferenceEnvironmentMap rem;
    rem.id = std::move(id);
    rem.center = center;
    rem.distance = CubeMap<float>(resolution);
    const CubeMap<double> t = traceTexels(tracer, center, resolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                const double length = glm::length(texelDirection(resolution, face, column, row));
                rem.distance.at(face, column, row) = float(t.at(face, column, row) * length);
            }
        }
    }
    return rem;
}

SampleIndex::SampleIndex(const Demand& demand) : m_demand(demand) {
    if (demand.samples.empty())
        return;
    glm::dvec2 low(demand.samples.front().vehicle), high = low;
    for (const DemandSample& s : demand.samples) {
        low = glm::min(low, glm::dvec2(s.vehicle));
        high = glm::max(high, glm::dvec2(s.vehicle));
    }
    m_x0 = low.x;
    m_y0 = low.y;
    m_columns = int((high.x - low.x) / kIndexCell) + 1;
    m_rows = int((high.y - low.y) / kIndexCell) + 1;
    m_cells.resize(std::size_t(m_columns) * std::size_t(m_rows));
    for (std::size_t k = 0; k < demand.samples.size(); ++k) {
        const glm::dvec3& p = demand.samples[k].vehicle;
        const int i = int((p.x - m_x0) / kIndexCell), j = int((p.y - m_y0) / kIndexCell);
        m_cells[std::size_t(j) * std::size_t(m_columns) + std::size_t(i)].push_back(
            std::uint32_t(k));
    }
}

std::vector<std::uint32_t> SampleIndex::within(const glm::dvec3& center) const {
    std::vector<std::uint32_t> found;
    const double reach = ServiceRule::kReach;
    const auto cell = [](double v) { return int(std::floor(std::clamp(v, -1e9, 1e9))); };
    const int i0 = std::max(0, cell((center.x - reach - m_x0) / kIndexCell));
    const int j0 = std::max(0, cell((center.y - reach - m_y0) / kIndexCell));
    const int i1 = std::min(m_columns - 1, cell((center.x + reach - m_x0) / kIndexCell));
    const int j1 = std::min(m_rows - 1, cell((center.y + reach - m_y0) / kIndexCell));
    for (int j = j0; j <= j1; ++j) {
        for (int i = i0; i <= i1; ++i) {
            for (const std::uint32_t k :
                 m_cells[std::size_t(j) * std::size_t(m_columns) + std::size_t(i)]) {
                const glm::dvec3 apart = m_demand.samples[k].vehicle - center;
                if (glm::dot(apart, apart) <= reach * reach)
                    found.push_back(k);
            }
        }
    }
    return found;
}

ServiceRow serviceRow(const Demand& demand, const SampleIndex& index, const ServiceRule& rule,
                      const ReferenceEnvironmentMap& rem) {
    ServiceRow row;
    for (const std::uint32_t k : index.within(rem.center)) {
        const double service = rule.service(demand.samples[k], rem);
        if (service > 0.0)
            row.entries.push_back({k, float(service)});
    }
    return row;
}

}  // namespace reflet
