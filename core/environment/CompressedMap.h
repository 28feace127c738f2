// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/Bc6h.h"
#include "core/environment/DistanceBlocks.h"
#include "core/environment/EnvironmentMap.h"

namespace reflet {

/// A reference environment map in a byte and a half a texel, as graphics cards keep it: 54 maps of
/// 128 × 128 texels a face take 7.96 MB, a fifth of what half floats take.
struct CompressedMap {
    Bc6hMap radiance;
    DistanceBlocks distance;

    [[nodiscard]] int resolution() const { return radiance.resolution; }
    [[nodiscard]] std::size_t bytes() const { return radiance.bytes() + distance.bytes(); }
};

/// Radiance and distance of one resolution. Deterministic, on all threads.
[[nodiscard]] inline CompressedMap compressed(const ReferenceEnvironmentMap& map) {
    return {encodeBc6h(map.radiance), encodeDistances(map.distance)};
}
/// What is left of the map's texels.
[[nodiscard]] inline ReferenceEnvironmentMap decompressed(const CompressedMap& compressed,
                                                          std::string id,
                                                          const glm::dvec3& center) {
    return {std::move(id), center, decodeBc6h(compressed.radiance),
            decodeDistances(compressed.distance)};
}

}  // namespace reflet
