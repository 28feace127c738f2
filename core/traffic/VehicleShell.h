// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/MeshCutting.h"
#include "core/traffic/PartMesh.h"
#include "core/traffic/PlaneShapes.h"

#include <vector>

namespace reflet {

/// How the shell of a tram or bus ends. In the plan it is a superellipse of exponent `roundness`
/// (2: an ellipse, larger: blunter) from the section's width at `base` to the middle line at
/// base ± reach(z), so that the end rakes with the height.
struct ShellEnd {
    float base = 0.0F;  ///< x where the constant section ends
    Curve reach{{0.0F, 0.05F}};
    float roundness = 2.5F;
    int rows = 6;
};

struct ShellSpec {
    std::vector<glm::vec2>
        halfSection;  ///< (y >= 0, z) from the bottom's middle to the roof's middle
    ShellEnd rear;
    ShellEnd front;
    float step = 0.6F;             ///< metres between rows along the constant section
    float referenceHeight = 1.2F;  ///< where the lengths of the surface coordinates are taken
};

struct Shell {
    PartMesh mesh;          ///< closed; surface = (length along the side in the plan, z)
    float rearTip = 0.0F;   ///< surface.x on the middle line at the rear
    float frontTip = 0.0F;  ///< and at the front
};

[[nodiscard]] Shell vehicleShell(const ShellSpec& spec, std::uint16_t material);

/// The half section of a rail or road vehicle: flat bottom, sides curved inwards above the waist
/// (radius `sideRadius`), rounded cant, slightly arched roof.
struct SectionSpec {
    float bottom = 0.2F, waist = 1.1F, cant = 2.8F, roof = 3.2F;  ///< heights
    float halfWidth = 1.3F;                                       ///< at the waist
    float sideRadius = 12.0F;
    float cantRadius = 0.3F;
    // Metres between points: at a radius of 11 m a chord of 0.2 m strays by half a millimetre.
    float sideStep = 0.20F, roofStep = 0.25F;
};
[[nodiscard]] std::vector<glm::vec2> curvedSection(const SectionSpec& spec);

/// A region drawn on both sides in (length along the side, height).
template <class Distance>
[[nodiscard]] Region onSides(Distance distance) {
    return [distance](const SurfacePoint& p) {
        return distance(glm::vec2(p.surface.x, p.position.z));
    };
}
/// side = +1: left only; -1: right only.
[[nodiscard]] inline Region onOneSide(const Region& region, float side) {
    return [region, side](const SurfacePoint& p) {
        const float other = -side * p.position.y;
        const float f = region(p);
        return f > other ? f : other;
    };
}

}  // namespace reflet
