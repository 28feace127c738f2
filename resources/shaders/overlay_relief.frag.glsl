// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// Translucent columns, coloured by height.

#include "overlay_depth.glsl"

in vec3 fromEye;
flat in float height;
flat in float tone;

layout(location = 0) out vec4 drawn;

// Dark blue, green, yellow: lightness rises with height for all eyes.
vec3 scale(float share) {
    vec3 low = mix(vec3(0.18, 0.18, 0.45), vec3(0.12, 0.52, 0.55), smoothstep(0.0, 0.5, share));
    return mix(low, vec3(0.98, 0.9, 0.25), smoothstep(0.4, 1.0, share));
}

void main() {
    float seen = visibility(fromEye, 0.6);
    if (seen < 1.0) {
        discard;
    }
    float share = clamp(height / 30.0, 0.0, 1.0);
    drawn = vec4(scale(share) * tone, 0.5);
}
