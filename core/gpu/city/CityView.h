// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"
#include "core/rendering/ViewRenderer.h"

#include <glm/mat4x4.hpp>

namespace reflet {

/// A perspective view of the project frame, as cameras and the faces of cube maps have it.
///
/// Depth is reversed and endless: near / (distance along `forward`), 1 at the near plane, 0 at
/// infinity, so that floats resolve a city at any distance. All that is drawn together with the
/// city uses clip_from_eye(), glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE), glDepthFunc(GL_GREATER
/// or GL_GEQUAL) and depth cleared to 0. CityPass::draw() sets the clip control and leaves it so.
struct CityView {
    glm::dvec3 eye{0.0};                  ///< project frame
    glm::vec3 forward{1.0F, 0.0F, 0.0F};  ///< unit
    glm::vec3 right{0.0F, -1.0F, 0.0F};   ///< unit, of the picture; either handedness
    glm::vec3 up{0.0F, 0.0F, 1.0F};       ///< unit, of the picture
    glm::vec2 tanHalf{1.0F};              ///< tangents of half the angles of width and height
    float near = 0.1F;                    ///< metres
    int width = 1280;
    int height = 720;
    /// The angle in radians that textures and patterns are averaged over (RadianceScene::shade).
    float spread = kViewSpread;
    /// Parts of the city that look smaller than this many pixels are left out. 0: none.
    float smallestPart = 0.7F;
    /// Leaves that look smaller than this many pixels are drawn fewer, but larger. 0: none.
    float thinnedLeaf = 0.0F;

    friend bool operator==(const CityView&, const CityView&) = default;

    /// Clip coordinates from a vector (point - eye) of the project frame.
    [[nodiscard]] glm::mat4 clip_from_eye() const;
    /// The same for coordinates of the project frame; loses millimetres kilometres from the origin.
    [[nodiscard]] glm::mat4 clip_from_project() const;
    /// Pixels that a metre, one metre away, takes.
    [[nodiscard]] float pixelsPerRadian() const;
};

/// The view of a camera; width and height at least 1.
[[nodiscard]] CityView cityView(const Camera& camera, int width, int height);
/// The view through a cube map's face with `edge` texels: texel (column, row) of the CPU is the
/// pixel (column, row) counted from the target's first row.
[[nodiscard]] CityView cityFaceView(const glm::dvec3& center, int face, int edge);

}  // namespace reflet
