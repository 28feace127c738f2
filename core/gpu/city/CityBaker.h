// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/EnvironmentBaker.h"
#include "core/gpu/base/GlObjects.h"
#include "core/gpu/city/CityPass.h"

namespace reflet {

/// Version of what CityBaker draws; part of the cache keys of its maps. Raise it when they change.
inline constexpr int kDrawnBakeVersion = 1;

/// Bakes reference environment maps by drawing the city, as bakeEnvironmentMap() traces them: the
/// same texels, samples and footprints of textures, distances through the texels' centres. Nothing
/// is left out for being small; what is nearer than 10 cm is.
///
/// Distances agree with the traced ones to 1 cm and 0.1 % on 99.8 % of the texels at least:
/// elsewhere a silhouette passes within a rounding of the centre. Radiance is shaded as CityPass
/// does, with shadow maps and a lattice of soft light in place of rays: 32 dB at least on the
/// sample cities (tests/gpu holds both). Belongs to the thread and context in which it was made.
class CityBaker {
public:
    /// Six faces as `pass` shows its city in its light; no bodies throw shadows. Whether a probe
    /// may stand there is checkBaking()'s to say. ResourceLimit when a face with its samples is
    /// larger than the driver's textures.
    [[nodiscard]] Result<ReferenceEnvironmentMap> bake(CityPass& pass, const std::string& id,
                                                       const glm::dvec3& position,
                                                       const BakeSettings& settings);

private:
    /// What a face is drawn to.
    struct Targets {
        Texture radiance, depth, distance;
    };

    void draw(CityPass& pass, const glm::dvec3& position, int face, int edge, Targets& targets);

    Targets m_samples, m_centers;
};

}  // namespace reflet
