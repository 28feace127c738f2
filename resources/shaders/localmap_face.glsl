// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of a cube face: core/environment/CubeDirection.h in GLSL.

uniform int face;        // +X -X +Y -Y +Z -Z
uniform int resolution;  // texels along the face's edge

const float kInfinity = uintBitsToFloat(0x7f800000u);

// (s, t) of the texel that is being written, in (-1, 1)^2. Framebuffer rows are the map's rows.
vec2 texelPlace() {
    return 2.0 * gl_FragCoord.xy / float(resolution) - 1.0;
}

// The direction at (s, t), scaled to 1 along the face's axis.
vec3 faceDirection(vec2 st) {
    switch (face) {
        case 0: return vec3(1.0, -st.y, -st.x);
        case 1: return vec3(-1.0, -st.y, st.x);
        case 2: return vec3(st.x, 1.0, st.y);
        case 3: return vec3(st.x, -1.0, -st.y);
        case 4: return vec3(st.x, -st.y, 1.0);
        default: return vec3(-st.x, -st.y, -1.0);
    }
}
