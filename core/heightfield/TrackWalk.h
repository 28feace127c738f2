// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/CellSpans.h"
#include "core/heightfield/TiledHeights.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reflet {

/// Rays that share their way over the ground: the same origin and the same horizontal direction,
/// hence the same cells at the same times. A single ray is a track too.
struct Track {
    double originX = 0.0, originY = 0.0, originZ = 0.0;
    double directionX = 0.0, directionY = 0.0;
    std::uint32_t first = 0, last = 0;  ///< its rays, ascending by their vertical component
};

/// Tracks, their rays, and where the answers go. Every component is finite, no direction zero.
struct TrackBatch {
    std::span<const Track> tracks;
    /// Vertical components of the rays (eight more may be read), and their numbers; both are
    /// worked on in place.
    double* directionZ = nullptr;
    std::uint32_t* ray = nullptr;
    /// By the rays' numbers, set to misses before.
    double* t = nullptr;
    std::uint32_t* cell = nullptr;  ///< null: not wanted
    /// Tracks of one ray each, of which neighbours are alike.
    bool abreast = false;

    void answer(std::uint32_t number, double time, std::uint32_t where) const {
        t[number] = time;
        if (cell != nullptr)
            cell[number] = where;
    }
};

/// Whether fields of this size can be walked: positions in them are 31 bits.
[[nodiscard]] bool canWalk(const TiledHeights& heights);

/// The first hits, as traceReference finds them, bit for bit. Several tracks at a time, one in each
/// lane of the widest vectors that the processor has. A track is walked once for all of its rays:
///
/// The lower of two rays of a track is lower at any time, after rounding too. So while the lowest
/// ray that has not met anything passes over a block, they all do, and in a column that is solid
/// from below those that it stops are the lowest ones.
void walkTracks(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch);

/// How many tracks are walked side by side in a vector.
[[nodiscard]] std::size_t walkLanes();

/// For tests: the instruction sets that walkTracks() can use here, and the one to use from now on
/// (empty: the best). Not while anything is traced.
[[nodiscard]] std::vector<std::string> walkTargets();
void useWalkTarget(const std::string& name);

}  // namespace reflet
