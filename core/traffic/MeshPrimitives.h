// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"

#include <string_view>
#include <vector>

namespace reflet {

// Closed solids of vehicles, facing outwards, with smooth normals. Metres.

/// A box with rounded edges; radius 0 gives sharp ones.
[[nodiscard]] PartMesh roundedBox(const glm::vec3& center, const glm::vec3& size, float radius,
                                  std::uint16_t material);

/// A profile of (radius, height) turned about `axis` through `center`. The ends should lie on the
/// axis (radius 0), or the profile should end where it began (a tyre).
[[nodiscard]] PartMesh lathe(const std::vector<glm::vec2>& profile, const glm::vec3& center,
                             const glm::vec3& axis, int segments, float crease,
                             std::uint16_t material);

[[nodiscard]] PartMesh cylinder(const glm::vec3& from, const glm::vec3& to, float radius,
                                int segments, std::uint16_t material);
[[nodiscard]] PartMesh ellipsoid(const glm::vec3& center, const glm::vec3& halfAxes, int segments,
                                 std::uint16_t material);
/// A round bar along a polyline, its ends closed; corners are mitred.
[[nodiscard]] PartMesh tube(const std::vector<glm::vec3>& path, float radius, int segments,
                            std::uint16_t material);
/// A polygon in the plane (x, z), counter-clockwise seen from -y, star-shaped about its mean,
/// extended from y0 to y1 (y0 < y1).
[[nodiscard]] PartMesh extrudedAcross(const std::vector<glm::vec2>& polygon, float y0, float y1,
                                      std::uint16_t material);

/// Text of 5 × 7 dots (capital letters, digits, blank, dash), each dot a small square facing
/// `right` × `up`, beginning at `origin` (lower left). `pitch`: metres from dot to dot.
[[nodiscard]] PartMesh dotText(std::string_view text, const glm::vec3& origin,
                               const glm::vec3& right, const glm::vec3& up, float pitch,
                               std::uint16_t material);
/// Width in dots of such a text.
[[nodiscard]] int dotTextWidth(std::string_view text);

}  // namespace reflet
