// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace reflet {

/// The distances of a cube map in half a byte a texel, of which any texel can be read by itself.
/// resources/shaders/rem_distance.glsl reads the same.
///
/// On a plane the inverse of the depth z along a face's axis is affine in the face's (s, t), so
/// that three numbers tell all texels of a wall. With x, y in texels from the middle of a block of
/// 4 × 4 texels, a plane is 1/z = a (1 + k x + l y). Half of the words are a table, 32 bits a
/// block, face by face and row by row, the lower half of a word first; the other half are entries
/// of 64 bits that blocks share and that go where they are needed.
///
///   bits 0-1 of a block's form
///   0 plane    2-31 a reference
///   1 shared   12-31 the first of two entries: which of three references a texel takes (bits 0-31,
///              2 for each; 3 = the sky), the references (32-61; 0-29 and 32-61 of the second)
///   2 listed   12-31 the first of four entries, one for each row: 1/z, 16 bits a texel
///   3 rough    2-13 a, 14-22 k, 23-31 l; a = 0 is the sky
///
/// A reference (30 bits) names an entry that holds a plane (10-29; its a 0-21, k 22-41, l 42-61),
/// and how many columns (0-4) and rows (5-9) after this block the block stands from whose middle
/// the plane is told. a and 1/z are floats with 5 bits of exponent (2^-20 to 2^11 per metre) and as
/// much mantissa as there is room: 17 bits of planes, 11 of lists, 7 of rough ones; 0 is zero.
/// Slopes and offsets are signed; k and l count a 2^19th, rough ones a 384th.
///
/// While there are entries left, all texels are right to 2 cm and 2 · 10^-4 of the distance. What a
/// map has beyond that becomes rough where that does least harm.
struct DistanceBlocks {
    int resolution = 0;                ///< texels along an edge of a face
    std::vector<std::uint64_t> words;  ///< table, then entries; as many as there are blocks

    /// Blocks along an edge; where the edge is no multiple of four the last ones stand over.
    [[nodiscard]] static int blocksAlong(int resolution) { return (resolution + 3) / 4; }
    [[nodiscard]] std::size_t bytes() const { return words.size() * sizeof(std::uint64_t); }
};

/// Deterministic, with any number of threads. Distances: metres, +infinity for sky; NaN and what is
/// not positive is taken as sky.
[[nodiscard]] DistanceBlocks encodeDistances(const CubeMap<float>& distances);
[[nodiscard]] CubeMap<float> decodeDistances(const DistanceBlocks& blocks);

}  // namespace reflet
