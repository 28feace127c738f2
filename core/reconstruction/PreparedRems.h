// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldTracer.h"
#include "core/reconstruction/RemSelection.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace reflet {

/// Which REMs may serve a place, chosen by what they see of what is seen from there, not by
/// distance alone: round a corner the nearest ones may be blind.
///
/// Choices are made at the nodes of a lattice, by a greedy search over the nearest REMs, for rays
/// in all directions: the sum over rays of the best service, a REM that is valid for what a ray
/// meets serving it the more, the smaller its sightPenalty. Between the nodes the presence of a
/// REM runs linearly, so that it is continuous wherever a vehicle drives. Nodes are made when they
/// are first asked for, and kept; some 0.3 ms each. Safe to use from several threads.
class PreparedRems {
public:
    /// Metres between the nodes, in x, y and z.
    static constexpr double kSpacing = 4.0;
    /// REMs that are looked at for a node.
    static constexpr std::size_t kPool = 24;

    PreparedRems(std::shared_ptr<const HeightfieldTracer> tracer, RemSet rems);

    /// What candidateRems() gives, chosen by sight; of the settings, those of the REMs count. For
    /// Weighting::AsInPaper the paper's pair.
    [[nodiscard]] RemCandidates at(const glm::dvec3& position, const MemSettings& settings) const;

    /// Makes the nodes around positions ahead, in parallel.
    void prepare(std::span<const glm::dvec3> positions, const MemSettings& settings) const;

    [[nodiscard]] const RemSet& rems() const { return m_rems; }

private:
    /// Place of a node in the lattice, and the most REMs it may hold.
    using Key = std::array<std::int64_t, 4>;
    using Choice = std::vector<std::size_t>;  ///< best first

    [[nodiscard]] std::shared_ptr<const Choice> node(const Key& key) const;
    [[nodiscard]] Choice choose(const glm::dvec3& position, std::size_t most) const;

    std::shared_ptr<const HeightfieldTracer> m_tracer;
    RemSet m_rems;
    mutable std::mutex m_mutex;
    mutable std::map<Key, std::shared_ptr<const Choice>> m_nodes;
};

}  // namespace reflet
