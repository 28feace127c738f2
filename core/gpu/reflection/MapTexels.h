// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace reflet {

/// The half float (IEEE 754 binary16) nearest to a value, ties to even; infinity from 65520 on.
[[nodiscard]] std::uint16_t halfOf(float value);

/// A local map as OpenGL keeps it, RGBA in half floats, made without OpenGL: drivers that draw in
/// software take longer for it than the map itself takes. rgb: radiance, at most 65504; a:
/// distance, negative in level 0 where the map is uncovered.
struct MapTexels {
    int resolution = 0;                 ///< texels along an edge of level 0
    int levels = 0;                     ///< each texel the mean of four of the level before
    std::vector<std::uint16_t> halves;  ///< level by level, each as CubeMap has its texels

    [[nodiscard]] bool empty() const { return halves.empty(); }
    [[nodiscard]] std::size_t offset(int level) const;  ///< in `halves`
};

enum class MapLevels {
    First,
    All,  ///< down to a texel; the first alone where the resolution is no power of two
};
/// uncovered: non-zero where the map is; empty: nowhere. All of one resolution. In parallel; the
/// same bits for any number of threads.
[[nodiscard]] MapTexels mapTexels(const CubeMap<glm::vec3>& radiance,
                                  const CubeMap<float>& distance,
                                  const CubeMap<unsigned char>& uncovered = {},
                                  MapLevels levels = MapLevels::All);

}  // namespace reflet
