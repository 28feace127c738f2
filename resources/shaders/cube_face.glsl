// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of cube maps: core/environment/CubeDirection.h in GLSL.

const float kInfinity = uintBitsToFloat(0x7f800000u);

// The direction at (s, t) of a face (+X -X +Y -Y +Z -Z), scaled to 1 along the face's axis.
vec3 directionOnFace(int face, vec2 st) {
    switch (face) {
        case 0: return vec3(1.0, -st.y, -st.x);
        case 1: return vec3(-1.0, -st.y, st.x);
        case 2: return vec3(st.x, 1.0, st.y);
        case 3: return vec3(st.x, -1.0, -st.y);
        case 4: return vec3(st.x, -st.y, 1.0);
        default: return vec3(-st.x, -st.y, -1.0);
    }
}

// The face that a direction (any length but zero) meets; st: where.
int faceOf(vec3 direction, out vec2 st) {
    vec3 a = abs(direction);
    if (a.x >= a.y && a.x >= a.z) {
        st = vec2(direction.x > 0.0 ? -direction.z : direction.z, -direction.y) / a.x;
        return direction.x > 0.0 ? 0 : 1;
    }
    if (a.y >= a.z) {
        st = vec2(direction.x, direction.y > 0.0 ? direction.z : -direction.z) / a.y;
        return direction.y > 0.0 ? 2 : 3;
    }
    st = vec2(direction.z > 0.0 ? direction.x : -direction.x, -direction.y) / a.z;
    return direction.z > 0.0 ? 4 : 5;
}
