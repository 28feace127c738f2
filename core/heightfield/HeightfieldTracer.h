// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/heightfield/Heightfield.h"

namespace reflet {

/// Where a ray meets the heightfield.
struct HeightfieldHit {
    bool hit = false;
    double t = 0.0;       ///< ray parameter: point = origin + t·direction
    int i = -1, j = -1;   ///< the cell that was hit

    friend bool operator==(const HeightfieldHit&, const HeightfieldHit&) = default;
};

/// Maxima of 2^k × 2^k blocks of one layer; level 0 is the layer itself. Built by pooling, never
/// by a second rasterisation. Missing cells count as -infinity.
struct MaxPyramid {
    struct Level {
        int columns = 0;
        int rows = 0;
        std::vector<float> maximum;
    };
    GridSpec grid;
    std::vector<Level> levels;
};

[[nodiscard]] MaxPyramid buildMaxPyramid(const GridSpec& grid, const std::vector<float>& layer);

/// The oracle: a plain grid walk (Amanatides & Woo 1987). The surface is made of columns with flat
/// tops and vertical walls reaching down to -infinity; the hit is where the ray first enters a
/// column (t >= 0; a ray that starts inside one hits at t = 0). On a cell border a ray belongs to
/// the cell that the half-open squares say, and to the one it moves into. A ray that leaves the
/// grid, or never enters it, misses. Any direction but zero is allowed, axis-parallel ones included.
[[nodiscard]] HeightfieldHit traceReference(const GridSpec& grid, const std::vector<float>& layer, const Ray& ray);

/// The same answers as traceReference, bit for bit, with empty space skipped by the max pyramid.
class HeightfieldTracer {
public:
    explicit HeightfieldTracer(const Heightfield& field, TopLayer layer = TopLayer::Center);
    [[nodiscard]] HeightfieldHit trace(const Ray& ray) const;
    [[nodiscard]] const GridSpec& grid() const { return m_pyramid.grid; }
    /// The layer that columns are taken from (level 0 of the pyramid).
    [[nodiscard]] const std::vector<float>& layer() const { return m_pyramid.levels.front().maximum; }

private:
    MaxPyramid m_pyramid;
};

}  // namespace reflet
