// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// A face with vehicles drawn into it becomes part of a local map again. rgb: the mean of a texel's
// samples; a: where at least half of them show a vehicle, its distance, else what the map held. On a
// plane 1/z is linear, so that its mean over the samples is that of the central ray.

#include "localmap_face.glsl"

layout(binding = 0) uniform samplerCube city;  // unfiltered
layout(binding = 1) uniform sampler2D radiance;
layout(binding = 2) uniform sampler2D depth;
uniform int samplesPerEdge;
uniform float near;  // metres

layout(location = 0) out vec4 texel;

void main() {
    vec4 held = textureLod(city, faceDirection(texelPlace()), 0.0);
    vec3 sum = vec3(0.0);
    float inverseDepth = 0.0;
    int met = 0;
    for (int k = 0; k < samplesPerEdge * samplesPerEdge; ++k) {
        ivec2 pixel = ivec2(gl_FragCoord.xy) * samplesPerEdge +
                      ivec2(k % samplesPerEdge, k / samplesPerEdge);
        sum += texelFetch(radiance, pixel, 0).rgb;
        vec2 st = 2.0 * (vec2(pixel) + 0.5) / float(resolution * samplesPerEdge) - 1.0;
        float scale = near * length(faceDirection(st));
        float shown = texelFetch(depth, pixel, 0).r;
        if (shown > scale / abs(held.a) * 1.00001) {
            ++met;
            inverseDepth += shown / near;
        }
    }
    float samples = float(samplesPerEdge * samplesPerEdge);
    float distance = length(faceDirection(texelPlace())) * float(met) / max(inverseDepth, 1e-9);
    texel = vec4(sum / samples, 2.0 * float(met) >= samples ? distance : held.a);
}
