// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoveragePlan.h"
#include "core/coverage/CoverageFigures.h"

#include <memory>
#include <vector>

namespace reflet {

/// The coverage of probes that are being placed and moved: what a change does not touch is kept, so
/// that moving one probe of many takes a fraction of a second. One thread at a time.
class CoverageWatch {
public:
    /// `samples` of what is asked for of the city; more are surer and slower.
    CoverageWatch(std::shared_ptr<const PreparedCity> city, CoveragePlan plan, std::size_t samples,
                  std::uint64_t seed);

    /// Takes the probes as they are now. Those that stand where one stood before cost nothing.
    void follow(const std::vector<Probe>& probes);

    [[nodiscard]] const CoveragePlan& plan() const { return m_plan; }
    [[nodiscard]] const Demand& demand() const { return m_demand; }
    /// Which probe serves which sample, by indices into the probes of the last follow().
    [[nodiscard]] const SampleCoverage& samples() const { return m_coverage; }
    [[nodiscard]] Estimate coverage() const { return estimateOf(m_coverage.best); }
    [[nodiscard]] std::vector<CoveredStretch> stretches(double length) const {
        return coveredStretches(m_demand, m_coverage, m_plan.lines, length);
    }
    /// Coverage that one more probe at a place (project frame) would add.
    [[nodiscard]] double gainOf(const glm::dvec3& place, int resolution) const;

private:
    struct Row {
        glm::dvec3 position{0.0};
        int resolution = 0;
        ServiceRow services;
    };
    [[nodiscard]] Row rowAt(const glm::dvec3& position, int resolution) const;

    std::shared_ptr<const PreparedCity> m_city;
    CoveragePlan m_plan;
    Demand m_demand;
    std::unique_ptr<SampleIndex> m_index;
    std::vector<std::shared_ptr<const Row>> m_rows;  ///< of the probes
    SampleCoverage m_coverage;
};

}  // namespace reflet
