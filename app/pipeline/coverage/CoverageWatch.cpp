// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageWatch.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace reflet {

CoverageWatch::CoverageWatch(std::shared_ptr<const PreparedCity> city, CoveragePlan plan,
                             std::size_t samples, std::uint64_t seed)
    : m_city(std::move(city)),
      m_plan(std::move(plan)),
      m_demand(m_plan.sample(m_city->tracer(), samples, seed)),
      m_index(std::make_unique<SampleIndex>(m_demand)) {
    follow({});
}

CoverageWatch::Row CoverageWatch::rowAt(const glm::dvec3& position, int resolution) const {
    const ServiceRule rule(m_city->heightfield().grid);
    return {
        position, resolution,
        serviceRow(m_demand, *m_index, rule, sightFrom(m_city->tracer(), position, resolution))};
}

void CoverageWatch::follow(const std::vector<Probe>& probes) {
    std::vector<std::shared_ptr<const Row>> rows(probes.size());
    parallelFor(0, probes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const glm::dvec3 position = m_city->inFrame(probes[i].position);
            const int resolution = probes[i].resolution.value_or(m_city->project().bake.resolution);
            const auto same = [&](const std::shared_ptr<const Row>& row) {
                return row->position == position && row->resolution == resolution;
            };
            const auto kept = std::find_if(m_rows.begin(), m_rows.end(), same);
            rows[i] = kept != m_rows.end()
                          ? *kept
                          : std::make_shared<const Row>(rowAt(position, resolution));
        }
    });
    m_rows = std::move(rows);
    const std::size_t n = m_demand.samples.size();
    m_coverage.best.assign(n, 0.0F);
    m_coverage.rem.assign(n, SampleCoverage::kNoRem);
    m_coverage.seenBy.assign(n, 0);
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        for (const ServiceRow::Entry& entry : m_rows[i]->services.entries) {
            m_coverage.seenBy[entry.sample] += m_coverage.seenBy[entry.sample] < 255 ? 1 : 0;
            if (entry.service > m_coverage.best[entry.sample]) {
                m_coverage.best[entry.sample] = entry.service;
                m_coverage.rem[entry.sample] = std::uint32_t(i);
            }
        }
    }
}

double CoverageWatch::gainOf(const glm::dvec3& place, int resolution) const {
    double gain = 0.0;
    for (const ServiceRow::Entry& entry : rowAt(place, resolution).services.entries)
        gain += std::max(0.0, double(entry.service) - double(m_coverage.best[entry.sample]));
    return gain / double(std::max<std::size_t>(m_demand.samples.size(), 1));
}

}  // namespace reflet
