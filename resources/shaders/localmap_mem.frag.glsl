// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// What one reference map gives to a texel of a local map (Meyer & Loscos 2003, section 4), as
// core/reconstruction/MemResampler computes it: 1/z and the weights run bilinearly over the leaf.
// rgb: radiance, to be added up; a: distance in metres, +infinity for sky, negative where uncovered.

#include "localmap_face.glsl"

layout(binding = 0) uniform samplerCubeArray rem;
uniform int cube;             // element of the array; -1 = there is no such map
uniform vec3 offset;          // P - C
uniform bool asInPaper;       // the vectors C->I linearly, not q
uniform float sceneDiameter;  // metres, the distance that sky counts as in the paper's form

flat in vec4 leafPlace;
flat in vec4 inverseDepth;
flat in vec4 weights;
flat in int leafFlags;

layout(location = 0) out vec4 texel;

float bilinear(vec4 corner, vec2 uv) {
    vec2 along = mix(corner.xy, corner.zw, uv.y);
    return mix(along.x, along.y, uv.x);
}

// The vector C->I at a corner of the leaf.
vec3 towards(vec2 uv, float inverse) {
    vec3 direction = faceDirection(leafPlace.xy + uv / leafPlace.zw);
    return inverse > 0.0 ? offset + direction / inverse : sceneDiameter * normalize(direction);
}

vec3 look(vec2 uv, vec3 direction, float inverse) {
    if (!asInPaper || (leafFlags & 2) != 0) {
        return direction + inverse * offset;
    }
    vec3 q00 = towards(vec2(0, 0), inverseDepth.x);
    vec3 q10 = towards(vec2(1, 0), inverseDepth.y);
    vec3 q01 = towards(vec2(0, 1), inverseDepth.z);
    vec3 q11 = towards(vec2(1, 1), inverseDepth.w);
    return mix(mix(q00, q01, uv.y), mix(q10, q11, uv.y), uv.x);
}

void main() {
    vec2 st = texelPlace();
    vec2 uv = (st - leafPlace.xy) * leafPlace.zw;
    vec3 direction = faceDirection(st);
    float inverse = bilinear(inverseDepth, uv);

    vec3 radiance = vec3(0.0);
    if (cube >= 0) {
        vec3 q = look(uv, direction, inverse);
        // A vector of length zero is taken as +X, as on the CPU.
        q = dot(q, q) == 0.0 ? vec3(1.0, 0.0, 0.0) : q;
        radiance = bilinear(weights, uv) * textureLod(rem, vec4(q, float(cube)), 0.0).rgb;
    }
    float distance = inverse > 0.0 ? length(direction) / inverse : kInfinity;
    texel = vec4(radiance, (leafFlags & 1) != 0 ? -distance : distance);
}
