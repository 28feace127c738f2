// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/baking/SeenSpace.h"
#include "core/environment/EnvironmentMap.h"
#include "core/heightfield/Heightfield.h"

namespace reflet {

struct BakeSettings {
    int resolution = 128;    ///< texels along an edge, 32..2048
    int samplesPerEdge = 2;  ///< radiance is averaged over this squared, on a regular sub-grid

    friend bool operator==(const BakeSettings&, const BakeSettings&) = default;
};

/// Who bakes: rays on the CPU (Embree), or OpenGL, which draws (core/gpu/city/CityBaker).
enum class Baker { Rays, OpenGl };

/// Version of what the baker draws; part of every cache key. Raise it when pictures change.
inline constexpr int kBakeVersion = 1;

/// Whether a map can be baked so, and there: Usage when the resolution or the samples are out of
/// range; Refused when the position is inside a solid or, if `ground` is given, below the ground:
/// with a remedy that names the nearest free place.
[[nodiscard]] Result<void> checkBaking(const RadianceScene& scene, const Heightfield* ground,
                                       const std::string& id, const glm::dvec3& position,
                                       const BakeSettings& settings);

/// Six faces of radiance and centre-ray distance from one position (DESIGN 5.2), parallel.
/// Usage and Refused as of checkBaking(); Cancelled. sight: watches the rays; null for none.
[[nodiscard]] Result<ReferenceEnvironmentMap> bakeEnvironmentMap(
    const RadianceScene& scene, const Heightfield* ground, const std::string& id,
    const glm::dvec3& position, const BakeSettings& settings, const JobContext& job,
    SightRecorder* sight = nullptr);

/// Why no REM may stand at a place, as bakeEnvironmentMap() says it; nullopt where one may.
[[nodiscard]] std::optional<Error> placeError(const RadianceScene& scene, const Heightfield* ground,
                                              const std::string& id, const glm::dvec3& position);

/// The nearest position (tried upwards, then around in rings up to 10 m) that a REM may take.
[[nodiscard]] std::optional<glm::dvec3> nearestFreePosition(const RadianceScene& scene,
                                                            const Heightfield* ground,
                                                            const glm::dvec3& position);

}  // namespace reflet
