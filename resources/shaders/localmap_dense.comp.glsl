// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A local map with a ray for each texel (core/reconstruction/Reconstruction.h, reconstructDense).
// rgb: radiance; a: distance in metres, +infinity for sky, negative where uncovered.

#include "rem_sight.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) writeonly uniform imageCube map;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);  // column, row, face
    int resolution = imageSize(map).x;
    if (any(greaterThanEqual(texel.xy, ivec2(resolution)))) {
        return;
    }
    vec3 direction =
        directionOnFace(texel.z, vec2(2 * texel.xy + 1) / float(resolution) - 1.0);
    Shown shown = shownAlong(vec3(0.0), direction);
    float distance = isinf(shown.t) ? kInfinity : shown.t * length(direction);
    imageStore(map, texel, vec4(shown.radiance, shown.uncovered ? -distance : distance));
}
