// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/city/CityView.h"

#include <glm/vec4.hpp>

#include <vector>

namespace reflet {

/// A corner of a triangle of the overlays.
struct OverlayVertex {
    glm::vec3 fromEye{0.0F};  ///< metres, axes of the project frame
    glm::vec4 color{1.0F};    ///< display values
    /// x: -1..1 across the shape or over a disc, y: metres along a ribbon or -1..1 over a disc;
    /// z: the pattern (OverlayPattern); w: metres by which it may lie behind the city and yet count
    /// as seen (what lies on the ground).
    glm::vec4 pattern{0.0F};
};

enum class OverlayPattern {
    Plain = 0,
    Ribbon = 1,
    Disc = 2,
    Ring = 3,
    Handle = 4,
    Band = 5,         ///< of a coverage; y: metres along it
    HatchedBand = 6,  ///< the same, of a poor one
    Spot = 7,         ///< what is hidden is not drawn at all
    HollowSpot = 8,
    Ghost = 9,
};

/// A ball of a probe, drawn as a square that faces the eye.
struct OverlayBall {
    glm::dvec3 center{0.0};  ///< exactly the probe's position
    float radius = 0.0F;     ///< metres
    ProbeState state = ProbeState::Missing;
    bool selected = false, hovered = false, preview = false;
    std::string id;
};

/// The shapes of a frame's overlays, sized so that they can be read from any distance.
struct OverlayShapes {
    std::vector<OverlayVertex> triangles;
    std::vector<OverlayBall> balls;  ///< the farthest first
};

/// view: as shown (one pixel a pixel), whatever size it is drawn at. ground: for the feet of the
/// stems; may be null.
[[nodiscard]] OverlayShapes overlayShapes(const Overlays& overlays, const CityView& view,
                                          const Heightfield* ground);

/// The colour that stands for a probe's state, display values; distinguishable by people who see
/// red and green alike (Okabe & Ito 2008). The shape of the mark says the same.
[[nodiscard]] glm::vec3 stateColor(ProbeState state);

/// Radius of a probe's ball in metres, for picking and drawing alike. depth: metres along the
/// view's direction.
[[nodiscard]] float ballRadius(const ProbeGlyph& probe, const CityView& view, float depth);

}  // namespace reflet
