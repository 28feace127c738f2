// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/GridWalk.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <cassert>

namespace reflet {

HeightfieldHit traceReference(const GridSpec& grid, const std::vector<float>& layer,
                              const Ray& ray) {
    return traceReference(grid, layer, CellSpans(), ray);
}

HeightfieldHit traceReference(const GridSpec& grid, const std::vector<float>& layer,
                              const CellSpans& spans, const Ray& ray) {
    assert(layer.size() == grid.cellCount());
    const GridWalk walk(grid, ray);
    if (!(walk.enter < walk.leave)) {
        return {};
    }
    double t = walk.enter;
    int i = walk.x.cellAt(t);
    int j = walk.y.cellAt(t);
    while (grid.contains(i, j)) {
        const double leaveX = walk.x.leaveCell(i);
        const double leaveY = walk.y.leaveCell(j);
        const double leave = std::min(leaveX, leaveY);
        const float height = layer[grid.index(i, j)];
        if (t < leave && !isMissing(height)) {
            const auto column = spans.at(grid.index(i, j));
            const double tHit = column.empty() ? walk.z.meets(double(height), t, leave)
                                               : walk.z.meets(column, t, leave);
            if (std::isfinite(tHit)) {
                return {true, tHit, i, j};
            }
        }
        if (walk.x.parallel() && walk.y.parallel()) {
            break;
        }
        t = leave;
        // Through a corner both steps are due at once.
        i += leaveX <= leave ? walk.x.step() : 0;
        j += leaveY <= leave ? walk.y.step() : 0;
    }
    return {};
}

}  // namespace reflet
