// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeSampler.h"
#include "core/reconstruction/Reconstruction.h"

#include <vector>

namespace reflet {

/// Method::PerPixel: what the REMs show along single rays that start on a vehicle's body, in the
/// place of a local map. Each ray is traced in the heightfield from where it starts, so that what
/// stands near is seen from the right place all along a tram's side; a local map sees everything
/// from one point. Else as reconstructDense(), which is the map of this method.
///
/// One for a whole vehicle: its bodies then share their REMs, and nothing jumps at a joint. Const,
/// so that threads may share one.
class PixelReflections {
public:
    /// Candidates are those for a map around `middle`, of the vehicle; of the settings refineHits
    /// and those of the REMs count. All of input must outlive this but `prepared`.
    PixelReflections(const ReconstructionInput& input, const glm::dvec3& middle,
                     const MemSettings& settings);

    /// direction: of any length but zero. Without REMs zero.
    [[nodiscard]] glm::vec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction) const;

private:
    ReconstructionInput m_input;
    RemCandidates m_candidates;
    bool m_refineHits;
    std::vector<CubeSampler> m_samplers;  ///< in the order of the candidates
};

}  // namespace reflet
