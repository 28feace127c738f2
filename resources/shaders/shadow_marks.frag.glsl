// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// Keeps the pixels from which the way to the sun meets a box.

layout(binding = 0) uniform sampler2D depth;  // of the city, reversed

uniform vec3 forward;
uniform float near;
uniform mat3 axes;  // the last points towards the sun
uniform mat4 body_from_eye;
uniform vec3 boxLower;  // body frame
uniform vec3 boxUpper;

in vec3 fromEye;

void main() {
    float sceneDepth = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    vec3 place = fromEye * (near / (max(sceneDepth, 1e-9) * dot(fromEye, forward)));
    vec3 from = (body_from_eye * vec4(place, 1.0)).xyz;
    vec3 way = mat3(body_from_eye) * axes[2];
    // Distances along the way at which it enters and leaves the three slabs; ways that lie in a
    // slab's plane give infinities, which are right too.
    vec3 a = (boxLower - from) / way;
    vec3 b = (boxUpper - from) / way;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float enters = max(max(first.x, first.y), max(first.z, 0.0));
    float leaves = min(min(last.x, last.y), last.z);
    if (sceneDepth <= 0.0 || enters > leaves)
        discard;
}
