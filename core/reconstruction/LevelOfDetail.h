// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/MemSettings.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// How finely the local map of a body is made while it passes, and how long it serves (DESIGN 5.4).
// Pure functions: who measures time and draws is elsewhere (FrameBudget, core/gpu).

namespace reflet {

/// A body as it is seen.
struct BodyView {
    double pixels = 0.0;    ///< of the picture, along the longest edge of its bounds
    double squeeze = 1.0;   ///< of its surface, see squeezeOf()
    double interest = 1.0;  ///< a planner's: 2 counts as if it looked twice as large
    double nearest = 10.0;  ///< metres from the map's centre to the nearest surroundings
};

/// Texels of a local map that a pixel of the body covers at the median of its surface, along an
/// edge: resolution / pixels · squeeze.
[[nodiscard]] double texelsPerPixel(int resolution, const BodyView& view);

/// The quality of a body's map. Levels are powers of two, so that they change seldom.
struct Detail {
    bool blend = false;    ///< the blend of two REMs serves: no rays
    int resolution = 128;  ///< texels along the edge of a face
    int quadStep = 0;      ///< the smallest quad is at least 2^quadStep texels
    bool others = true;    ///< other vehicles are drawn into it
    double angle = 0.0;    ///< radians by which what it shows may be off: a texel or a pixel
    double reuse = 0.02;   ///< metres that the body may move before its map must be drawn again

    [[nodiscard]] bool sameQuality(const Detail& other) const {
        return blend == other.blend && resolution == other.resolution && quadStep == other.quadStep;
    }
    /// Whether a map of this detail may stand for one of the other.
    [[nodiscard]] bool atLeast(const Detail& other) const;
};

/// The coarsest of the steps by which all bodies give way: each shows a body as if it looked
/// smaller by some.
inline constexpr int kMostCoarse = 10;
/// Texels along the edge of the smallest map.
inline constexpr int kSmallestMap = 32;

/// The detail that a body deserves: map resolution and smallest quad such that neither is finer
/// than a pixel of the picture, never finer than tuned, and never a quad below a texel; the blend
/// of two REMs for what is small. `coarse`, 0..kMostCoarse, is the same for all bodies: small ones
/// lose by it first. `held` is what the body was shown with so far: it is kept while it is about
/// right, so that a body on the border between two levels does not flicker. Never finer for a
/// smaller or less interesting body, or a larger `coarse`, where nothing is held.
///
/// Detail::reuse: what stands `nearest` away seems to move by (way / nearest) radians; it may by a
/// texel of the map or a pixel of the picture, whichever is more.
[[nodiscard]] Detail chooseDetail(const BodyView& view, const MemSettings& tuned, int coarse,
                                  const std::optional<Detail>& held = std::nullopt);

/// The settings that draw it.
[[nodiscard]] MemSettings settingsOf(const Detail& detail, const MemSettings& tuned);

/// What drawing a map costs, in units that FrameBudget knows the worth of: about one for a texel
/// that is traced.
[[nodiscard]] double unitsOf(const Detail& detail);

/// What drawing so many other bodies into a map costs, in units of their own.
[[nodiscard]] double unitsOfOthers(const Detail& detail, std::size_t bodies);

/// A map that may be drawn in the next picture.
struct MapUpdate {
    double error = 0.0;    ///< way since it was drawn / Detail::reuse; below 1 it is not due
    double weight = 1.0;   ///< pixels · interest
    double units = 0.0;    ///< unitsOf()
    bool missing = false;  ///< there is none yet
};
/// Which of them are drawn, as indices in order of urgency: missing ones, then the largest visible
/// error (error · weight), as many as fit into `units`. The first always, or a map that is dearer
/// than the allowance would never be drawn.
[[nodiscard]] std::vector<std::size_t> chooseUpdates(std::span<const MapUpdate> updates,
                                                     double units);

}  // namespace reflet
