// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reflet {

/// BC6H, unsigned: HDR colours in blocks of 4 × 4 texels, a byte a texel, that a graphics card
/// reads by itself (GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT; Khronos Data Format Specification 1.3,
/// section 20). Written are the four forms of one region: all texels of a block lie on a line of 16
/// steps between two colours, which have 10 bits a channel, or 11, 12, 16 when they are alike.
///
/// The line runs through the bit patterns of half floats, nearly logarithms; the encoder makes the
/// error least as it shows on a display. Blocks of one colour come out to half an ulp of a half.
/// Negative radiance and NaN become 0, what is above 65504 that.
using Bc6hBlock = std::array<std::uint8_t, 16>;
using Bc6hTexels = std::array<glm::vec3, 16>;  ///< row by row

[[nodiscard]] Bc6hBlock encodeBc6h(const Bc6hTexels& texels);
/// For blocks of one region; others are black, as reserved ones are.
[[nodiscard]] Bc6hTexels decodeBc6h(const Bc6hBlock& block);

/// Radiance of a cube map, face by face, blocks row by row. Where the edge is no multiple of four
/// the last blocks repeat its last texels.
struct Bc6hMap {
    int resolution = 0;
    std::vector<Bc6hBlock> blocks;

    [[nodiscard]] static int blocksAlong(int resolution) { return (resolution + 3) / 4; }
    [[nodiscard]] std::size_t bytes() const { return blocks.size() * sizeof(Bc6hBlock); }
};

/// Deterministic, with any number of threads.
[[nodiscard]] Bc6hMap encodeBc6h(const CubeMap<glm::vec3>& radiance);
[[nodiscard]] CubeMap<glm::vec3> decodeBc6h(const Bc6hMap& map);

}  // namespace reflet
