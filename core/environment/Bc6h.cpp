// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/Bc6h.h"

#include "core/base/ParallelFor.h"
#include "core/environment/Bc6hForms.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>

namespace reflet {

Bc6hTexels decodeBc6h(const Bc6hBlock& block) {
    Bc6hTexels texels;
    texels.fill(glm::vec3(0.0f));
    const bc6h::Form* form = bc6h::formOf(block);
    if (form == nullptr)
        return texels;
    const bc6h::Parts parts = bc6h::unpack(*form, block);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const int half =
                bc6h::halfBitsAt(bc6h::widened(parts.first[std::size_t(c)], form->bits),
                                 bc6h::widened(parts.second[std::size_t(c)], form->bits),
                                 bc6h::kSteps[parts.steps[i]]);
            texels[i][c] = glm::unpackHalf1x16(std::uint16_t(half));
        }
    }
    return texels;
}

namespace {

/// body(block, face, column, row): for all blocks of a cube map, columns and rows in blocks.
template <class Body>
void forEachBlock(int resolution, const Body& body) {
    const auto edge = std::size_t(Bc6hMap::blocksAlong(resolution));
    parallelFor(0, 6 * edge, 2, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            for (std::size_t column = 0; column < edge; ++column)
                body(line * edge + column, int(line / edge), int(column), int(line % edge));
        }
    });
}

}  // namespace

Bc6hMap encodeBc6h(const CubeMap<glm::vec3>& radiance) {
    const int n = radiance.resolution();
    const auto edge = std::size_t(Bc6hMap::blocksAlong(n));
    Bc6hMap map{n, std::vector<Bc6hBlock>(6 * edge * edge)};
    forEachBlock(n, [&](std::size_t block, int face, int column, int row) {
        Bc6hTexels texels;
        for (int i = 0; i < 16; ++i) {
            texels[std::size_t(i)] = radiance.at(face, std::min(4 * column + i % 4, n - 1),
                                                 std::min(4 * row + i / 4, n - 1));
        }
        map.blocks[block] = encodeBc6h(texels);
    });
    return map;
}

CubeMap<glm::vec3> decodeBc6h(const Bc6hMap& map) {
    const int n = map.resolution;
    CubeMap<glm::vec3> radiance(n);
    forEachBlock(n, [&](std::size_t block, int face, int column, int row) {
        const Bc6hTexels texels = decodeBc6h(map.blocks[block]);
        for (int y = 4 * row; y < std::min(4 * row + 4, n); ++y) {
            for (int x = 4 * column; x < std::min(4 * column + 4, n); ++x)
                radiance.at(face, x, y) = texels[std::size_t(4 * (y % 4) + x % 4)];
        }
    });
    return radiance;
}

}  // namespace reflet
