// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// A local map from one or two reference maps, looked up as if all were infinitely far
// (core/reconstruction/BaselineMaps). Output as in localmap_mem.

#include "localmap_face.glsl"
#include "rem_distance.glsl"

layout(binding = 0) uniform samplerCubeArray remA;
layout(binding = 1) uniform samplerCubeArray remB;
layout(binding = 2) uniform samplerCubeArray unfilteredA;
layout(binding = 3) uniform usampler2DArray distancesA;
uniform int resolutionA;  // of A where its distances are in blocks, else 0
uniform int cubeA;      // element of the array; -1 = there is no map: black
uniform int cubeB;
uniform float weightB;  // 0 = A alone

layout(location = 0) out vec4 texel;

uvec2 distanceTexel(int array, ivec3 at) {
    return texelFetch(distancesA, at, 0).rg;
}

void main() {
    if (cubeA < 0) {
        texel = vec4(0.0, 0.0, 0.0, -kInfinity);
        return;
    }
    vec3 direction = faceDirection(texelPlace());
    vec3 radiance = textureLod(remA, vec4(direction, float(cubeA)), 0.0).rgb;
    if (weightB > 0.0 && cubeB >= 0) {
        vec3 other = textureLod(remB, vec4(direction, float(cubeB)), 0.0).rgb;
        radiance = mix(radiance, other, weightB);
    }
    float distance = resolutionA > 0
                         ? nearestDistanceInBlocks(Blocks(0, cubeA, resolutionA), direction)
                         : textureLod(unfilteredA, vec4(direction, float(cubeA)), 0.0).a;
    texel = vec4(radiance, distance);
}
