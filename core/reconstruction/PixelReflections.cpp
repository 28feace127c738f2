// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/PixelReflections.h"

#include "core/reconstruction/MemVertexTracer.h"

#include <cassert>

namespace reflet {

PixelReflections::PixelReflections(const ReconstructionInput& input, const glm::dvec3& middle,
                                   const MemSettings& settings)
    : m_input(input),
      m_candidates(input.candidates(middle, settings)),
      m_refineHits(settings.refineHits) {
    assert(input.tracer && "a reconstruction needs a heightfield");
    m_input.prepared = nullptr;
    for (const RemCandidate& candidate : m_candidates.rems)
        m_samplers.emplace_back(m_input.rems[candidate.rem].radiance);
}

glm::vec3 PixelReflections::radiance(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const MemVertexTracer tracer(m_input, m_candidates, origin, m_refineHits);
    const MemVertex vertex = tracer.trace(direction);
    glm::vec3 radiance(0.0F);
    const auto add = [&](std::int8_t candidate, double weight) {
        if (candidate < 0 || !(weight > 0.0))
            return;
        const glm::vec3 lookup(direction + vertex.inverseDepth * tracer.offset(candidate));
        radiance += float(weight) * toVec3(m_samplers[std::size_t(candidate)].sample(lookup));
    };
    add(vertex.a, vertex.weightA);
    add(vertex.b, vertex.weightB);
    return radiance;
}

}  // namespace reflet
