// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"
#include "core/heightfield/TiledHeights.h"

#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

/// What a ray can hit, exactly.
///
/// The surface: over each cell that is not missing stands a column that reaches down to -infinity
/// and has a closed flat top (z == height is hit); its walls are the cell's borders. A cell that
/// has spans holds just these instead: closed stretches with flat tops and undersides, and a ray
/// passes between them.
///
/// Which cell a ray is in: border k of an axis lies at b(k) = x0 + k·s and is passed at
/// t(k) = (b(k) - origin)·(1 / direction), in double, just so. The ray is in column k of the grid
/// during [t(k), t(k+1)), or [t(k+1), t(k)) when the component is negative: on a border it belongs
/// to the cell that it moves into, through a corner it goes diagonally without touching the two
/// cells beside, and a ray that starts on a wall and moves away from it does not hit it. A ray
/// whose component is zero (or so small that its reciprocal overflows) belongs to the column with
/// b(k) <= origin < b(k+1). The spans cut the time line without gap or overlap, also when rounded.
///
/// The hit: in the time [enter, leave) of a cell, enter >= 0, the ray hits at `enter` if it is
/// inside of a solid then (a wall, or it started there), else where it comes down to the top of the
/// solid below it, or up to the underside of the one above it, before `leave`. A ray that leaves
/// the grid or never enters it misses, as does one with a component that is not finite. Any
/// direction but zero is allowed.
struct HeightfieldHit {
    bool hit = false;
    double t = 0.0;      ///< ray parameter: point = origin + t·direction
    int i = -1, j = -1;  ///< the cell that was hit

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

/// The oracle: a plain grid walk (Amanatides & Woo 1987), cell by cell, that computes each border's
/// t afresh instead of adding up.
[[nodiscard]] HeightfieldHit traceReference(const GridSpec& grid, const std::vector<float>& layer,
                                            const Ray& ray);
[[nodiscard]] HeightfieldHit traceReference(const GridSpec& grid, const std::vector<float>& layer,
                                            const CellSpans& spans, const Ray& ray);

/// No cell: the ray hit nothing.
inline constexpr std::uint32_t kNoCell = 0xffffffffU;

/// Where the answers for many rays go, by the rays' numbers.
struct RayHits {
    std::span<double> t;                 ///< ray parameter of the hit, +infinity for a miss
    std::span<std::uint32_t> cell = {};  ///< GridSpec::index of it, or kNoCell; empty: not wanted
};

/// Directions base + column[c]·columnAxis + row[r]·rowAxis, row by row, as on a face of a cube. Of
/// the three vectors each component is zero in all but one, so that the sums are exact.
struct DirectionGrid {
    glm::dvec3 base{0.0};
    glm::dvec3 columnAxis{0.0};
    glm::dvec3 rowAxis{0.0};
    std::span<const double> column;
    std::span<const double> row;

    [[nodiscard]] std::size_t size() const { return column.size() * row.size(); }
    /// What the vertical component changes along: rows, columns, or neither or both.
    [[nodiscard]] bool alongRows() const { return columnAxis.z != 0.0 && rowAxis.z == 0.0; }
    [[nodiscard]] bool alongColumns() const { return columnAxis.z == 0.0 && rowAxis.z != 0.0; }
    [[nodiscard]] glm::dvec3 at(std::size_t c, std::size_t r) const {
        return base + column[c] * columnAxis + row[r] * rowAxis;
    }
};

/// The same answers as traceReference, bit for bit, with empty space skipped by the max pyramid. A
/// field without spans costs nothing for what others can do.
///
/// Many rays at a time are traced with the widest vectors that the processor has, in parallel; the
/// same bits for any number of threads and any processor. What they have in common is used:
///
/// - trace(rays, hits): any rays.
/// - traceFrom(): rays of one origin, the vertices of a local map's mesh. Those with equal x and y
///   (bit for bit; on the side faces of a cube: each column of vertices) are traced as one, so give
///   as many at once as there are, of all faces: order does not matter.
/// - traceGrid(): a whole face of a cube, or any part of it.
class HeightfieldTracer {
public:
    explicit HeightfieldTracer(const Heightfield& field, TopLayer layer = TopLayer::Center);
    [[nodiscard]] HeightfieldHit trace(const Ray& ray) const;
    /// As many hits as rays.
    void trace(std::span<const Ray> rays, std::span<HeightfieldHit> hits) const;
    void trace(std::span<const Ray> rays, const RayHits& hits) const;
    void traceFrom(const glm::dvec3& origin, std::span<const glm::dvec3> directions,
                   const RayHits& hits) const;
    void traceGrid(const glm::dvec3& origin, const DirectionGrid& directions,
                   const RayHits& hits) const;
    [[nodiscard]] const GridSpec& grid() const { return m_pyramid.grid; }
    /// Where the columns end (level 0 of the pyramid).
    [[nodiscard]] const std::vector<float>& layer() const {
        return m_pyramid.levels.front().maximum;
    }

    /// The columns that are hollow somewhere.
    [[nodiscard]] const CellSpans& spans() const { return m_spans; }

private:
    void traceOne(const Ray& ray, const RayHits& hits, std::size_t k) const;
    void traceSome(std::span<const Ray> rays, const RayHits& hits) const;

    MaxPyramid m_pyramid;
    TiledHeights m_tiled;
    CellSpans m_spans;
    double m_highest = 0.0;    ///< of the layer; -infinity when every cell is missing
    double m_magnitude = 0.0;  ///< largest |height|: scale of the rounding margin
};

}  // namespace reflet
