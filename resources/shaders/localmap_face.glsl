// SPDX-License-Identifier: GPL-3.0-or-later
// The face of a local map that is being drawn.

#include "cube_face.glsl"

uniform int face;        // +X -X +Y -Y +Z -Z
uniform int resolution;  // texels along the face's edge

// (s, t) of the texel that is being written, in (-1, 1)^2. Framebuffer rows are the map's rows.
vec2 texelPlace() {
    return 2.0 * gl_FragCoord.xy / float(resolution) - 1.0;
}

// The direction at (s, t), scaled to 1 along the face's axis.
vec3 faceDirection(vec2 st) {
    return directionOnFace(face, st);
}
