// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/heightfield/RayTracks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace reflet {

namespace {

constexpr std::size_t kSingleRays = 1024;   ///< traced at a time: what fits into the first caches
constexpr std::size_t kGroupedRays = 2048;  ///< worth a task: the more, the more they share
constexpr std::size_t kRows = 16;           ///< of a grid of directions, worth a task

RayHits part(const RayHits& hits, std::size_t first, std::size_t count) {
    return {hits.t.subspan(first, count),
            hits.cell.empty() ? hits.cell : hits.cell.subspan(first, count)};
}

/// Tracks of this thread, without any so far.
RayTracks& emptyTracks() {
    thread_local RayTracks tracks;
    tracks.clear();
    return tracks;
}

void setMisses(const RayHits& hits) {
    std::fill(hits.t.begin(), hits.t.end(), std::numeric_limits<double>::infinity());
    std::fill(hits.cell.begin(), hits.cell.end(), kNoCell);
}

/// hits: by the numbers that the rays have in the tracks.
void walk(const TiledHeights& heights, const CellSpans& spans, RayTracks& tracks,
          const RayHits& hits) {
    walkTracks(heights, spans,
               tracks.batch(hits.t.data(), hits.cell.empty() ? nullptr : hits.cell.data()));
}

}  // namespace

void HeightfieldTracer::traceOne(const Ray& ray, const RayHits& hits, std::size_t k) const {
    const HeightfieldHit hit = trace(ray);
    hits.t[k] = hit.hit ? hit.t : std::numeric_limits<double>::infinity();
    if (!hits.cell.empty())
        hits.cell[k] = hit.hit ? std::uint32_t(grid().index(hit.i, hit.j)) : kNoCell;
}

void HeightfieldTracer::traceSome(std::span<const Ray> rays, const RayHits& hits) const {
    // Rays that have nothing in common are slower in short vectors than one by one.
    if (!canWalk(m_tiled) || walkLanes() < 8) {
        for (std::size_t k = 0; k < rays.size(); ++k)
            traceOne(rays[k], hits, k);
        return;
    }
    RayTracks& tracks = emptyTracks();
    tracks.addSingle(rays);
    setMisses(hits);
    walk(m_tiled, m_spans, tracks, hits);
}

void HeightfieldTracer::trace(std::span<const Ray> rays, const RayHits& hits) const {
    assert(hits.t.size() == rays.size());
    parallelFor(0, rays.size(), kSingleRays, [&](std::size_t first, std::size_t last) {
        for (; first < last; first += std::min(kSingleRays, last - first)) {
            const std::size_t count = std::min(kSingleRays, last - first);
            traceSome(rays.subspan(first, count), part(hits, first, count));
        }
    });
}

void HeightfieldTracer::trace(std::span<const Ray> rays, std::span<HeightfieldHit> hits) const {
    assert(hits.size() == rays.size());
    const auto columns = std::uint32_t(grid().columns);
    parallelFor(0, rays.size(), kSingleRays, [&](std::size_t first, std::size_t last) {
        std::array<double, kSingleRays> t{};
        std::array<std::uint32_t, kSingleRays> cell{};
        while (first < last) {
            const std::size_t count = std::min(kSingleRays, last - first);
            traceSome(rays.subspan(first, count),
                      {std::span(t).first(count), std::span(cell).first(count)});
            for (std::size_t k = 0; k < count; ++k) {
                hits[first + k] = cell[k] == kNoCell
                                      ? HeightfieldHit{}
                                      : HeightfieldHit{true, t[k], int(cell[k] % columns),
                                                       int(cell[k] / columns)};
            }
            first += count;
        }
    });
}

void HeightfieldTracer::traceFrom(const glm::dvec3& origin, std::span<const glm::dvec3> directions,
                                  const RayHits& hits) const {
    assert(hits.t.size() == directions.size());
    parallelFor(0, directions.size(), kGroupedRays, [&](std::size_t first, std::size_t last) {
        const auto some = directions.subspan(first, last - first);
        const RayHits answers = part(hits, first, some.size());
        if (!canWalk(m_tiled)) {
            for (std::size_t k = 0; k < some.size(); ++k)
                traceOne({origin, some[k]}, answers, k);
            return;
        }
        RayTracks& tracks = emptyTracks();
        tracks.addGrouped(origin, some);
        setMisses(answers);
        walk(m_tiled, m_spans, tracks, answers);
    });
}

void HeightfieldTracer::traceGrid(const glm::dvec3& origin, const DirectionGrid& directions,
                                  const RayHits& hits) const {
    assert(hits.t.size() == directions.size());
    setMisses(hits);
    // Tracks run along rows or along columns, whichever the vertical component changes in.
    const bool alongRows = directions.alongRows();
    const std::size_t lines = alongRows ? directions.row.size() : directions.column.size();
    parallelFor(0, lines, kRows, [&](std::size_t first, std::size_t last) {
        if (!canWalk(m_tiled)) {
            const std::size_t columns = directions.column.size();
            const std::size_t others = directions.size() / lines;
            for (std::size_t line = first; line < last; ++line) {
                for (std::size_t other = 0; other < others; ++other) {
                    const std::size_t c = alongRows ? other : line;
                    const std::size_t r = alongRows ? line : other;
                    traceOne({origin, directions.at(c, r)}, hits, r * columns + c);
                }
            }
            return;
        }
        RayTracks& tracks = emptyTracks();
        tracks.addGrid(origin, directions, first, last);
        walk(m_tiled, m_spans, tracks, hits);
    });
}

}  // namespace reflet
