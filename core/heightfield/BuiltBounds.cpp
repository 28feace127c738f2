// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/BuiltBounds.h"

namespace reflet {
namespace {

constexpr float kStands = 2.5F;  // metres over the ground: a house, not a car or a hedge

}  // namespace

Box builtBounds(const Heightfield& field) {
    Box built, all;
    const GridSpec& grid = field.grid;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const std::size_t cell = grid.index(i, j);
            const float ground = field.ground[cell], top = field.topMax[cell];
            if (isMissing(ground) || isMissing(top)) {
                continue;
            }
            const glm::dvec3 low(grid.xMin(i), grid.yMin(j), double(ground));
            const glm::dvec3 high(low.x + grid.cellSize, low.y + grid.cellSize, double(top));
            all.add(low);
            all.add(high);
            if (top - ground >= kStands) {
                built.add(low);
                built.add(high);
            }
        }
    }
    return built.empty() ? all : built;
}

}  // namespace reflet
