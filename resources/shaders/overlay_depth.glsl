// SPDX-License-Identifier: GPL-3.0-or-later
// What overlays know of the city in front of them.

layout(binding = 0) uniform sampler2D sceneDepth;  // reversed: near / depth
uniform vec3 forward;
uniform float near;
uniform int samplesPerEdge;

const float kShinesThrough = 0.22;  // of an overlay that the city hides

// 1 where a point is seen, kShinesThrough where the city hides it by more than `slack` metres.
float visibility(vec3 fromEye, float slack) {
    ivec2 place = ivec2(gl_FragCoord.xy) * samplesPerEdge + samplesPerEdge / 2;
    float seen = near / max(texelFetch(sceneDepth, place, 0).r, 1e-9);
    float own = dot(fromEye, forward);
    return own <= seen * 1.004 + slack ? 1.0 : kShinesThrough;
}
