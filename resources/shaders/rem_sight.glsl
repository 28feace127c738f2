// SPDX-License-Identifier: GPL-3.0-or-later
// Which reference maps see a point, which of them serve it and with what weights, and what they
// show: core/reconstruction/MemVertexTracer in GLSL. Positions are relative to P, as in
// heightfield_ray.glsl. The table: core/gpu/reflection/SightTable.h.

#include "cube_face.glsl"
#include "heightfield_ray.glsl"
#include "rem_distance.glsl"

const int kMostCandidates = 16;
const int kNobody = -1;

layout(std140, binding = 3) uniform Candidates {
    vec4 candidateCenter[kMostCandidates];  // C - P; presence
    // Which of `rems`, element of the array, resolution, whether its distances are in blocks.
    ivec4 candidatePlace[kMostCandidates];
};
layout(binding = 14) uniform samplerCubeArray rems[3];            // radiance; distance
layout(binding = 17) uniform usampler2DArray distanceBlocks[3];  // of the same arrays

uniform int candidates;
uniform bool weighAsInPaper;
uniform float tolerance;  // metres by which a REM may see less far and still be valid
uniform float reach;      // metres by which hits may move onto the REMs' surfaces

uvec2 distanceTexel(int array, ivec3 at) {
    switch (array) {
        case 0: return texelFetch(distanceBlocks[0], at, 0).rg;
        case 1: return texelFetch(distanceBlocks[1], at, 0).rg;
        default: return texelFetch(distanceBlocks[2], at, 0).rg;
    }
}

vec4 distancesAround(int i, vec3 direction) {
    if (candidatePlace[i].w != 0) {
        return distancesInBlocks(
            Blocks(candidatePlace[i].x, candidatePlace[i].y, candidatePlace[i].z), direction);
    }
    vec4 at = vec4(direction, float(candidatePlace[i].y));
    switch (candidatePlace[i].x) {
        case 0: return textureGather(rems[0], at, 3);
        case 1: return textureGather(rems[1], at, 3);
        default: return textureGather(rems[2], at, 3);
    }
}

vec3 radianceOf(int i, vec3 direction) {
    vec4 at = vec4(direction, float(candidatePlace[i].y));
    switch (candidatePlace[i].x) {
        case 0: return textureLod(rems[0], at, 0.0).rgb;
        case 1: return textureLod(rems[1], at, 0.0).rgb;
        default: return textureLod(rems[2], at, 0.0).rgb;
    }
}

float seenDistance(int i, vec3 direction) {
    vec4 d = distancesAround(i, direction);
    return max(max(d.x, d.y), max(d.z, d.w));
}

// A ray and what it met. t: its parameter, +infinity for sky.
struct Sighted {
    vec3 origin;
    vec3 direction;
    float t;
};

bool sees(int i, Sighted s) {
    bool sky = isinf(s.t);
    vec3 towards =
        sky ? s.direction : s.origin + s.t * s.direction - candidateCenter[i].xyz;
    float seen = seenDistance(i, towards);
    float distance = length(towards);
    return sky ? isinf(seen) : distance <= tolerance || seen >= distance - tolerance;
}

float penaltyOf(int i, Sighted s) {
    const float kLeast = 1e-6;
    vec3 center = candidateCenter[i].xyz;
    float presence = candidateCenter[i].w;
    if (isinf(s.t)) {
        return (distance(center, s.origin) + kLeast) / presence;
    }
    vec3 fromOrigin = s.t * s.direction;
    vec3 fromCenter = s.origin + fromOrigin - center;
    float near = length(fromOrigin);
    float far = length(fromCenter);
    if (!(near > 0.0) || !(far > 0.0)) {
        return (near > far ? kLeast : 2.0) / presence;
    }
    // The chord between the unit vectors, not by their cosine: that loses small angles in floats.
    float chord = length(fromOrigin / near - fromCenter / far);
    return (chord + max(0.0, far / near - 1.0) + kLeast) / presence;
}

// The REMs that serve a point, and their weights.
struct Served {
    int a, b;  // kNobody: none
    float weightA, weightB;
    bool uncovered;
};

Served fallBack(Sighted s) {
    Served served = Served(kNobody, kNobody, 1.0, 0.0, true);
    float best = -1.0;
    for (int i = 0; i < candidates; ++i) {
        vec3 towards = isinf(s.t) ? s.direction
                                  : s.origin + s.t * s.direction - candidateCenter[i].xyz;
        float seen = seenDistance(i, towards);
        float share = isinf(s.t) ? seen : seen / length(towards);
        if (share > best) {
            best = share;
            served.a = i;
        }
    }
    return served;
}

Served servedBySight(Sighted s) {
    float penalty[kMostCandidates];
    for (int i = 0; i < candidates; ++i) {
        penalty[i] = penaltyOf(i, s);
    }
    int found = 0;
    int which[3] = int[](kNobody, kNobody, kNobody);
    float best[3];
    for (int round = 0; round < candidates && found < 3; ++round) {
        int least = kNobody;
        for (int i = 0; i < candidates; ++i) {
            if (penalty[i] >= 0.0 && (least == kNobody || penalty[i] < penalty[least])) {
                least = i;
            }
        }
        if (sees(least, s)) {
            which[found] = least;
            best[found++] = penalty[least];
        }
        penalty[least] = -1.0;  // tried
    }
    if (found == 0) {
        return fallBack(s);
    }
    float none = found == 3 ? 1.0 / best[2] : 0.0;
    float first = 1.0 / best[0] - none;
    float second = found > 1 ? 1.0 / best[1] - none : 0.0;
    float weightB = first + second > 0.0 ? second / (first + second) : 0.0;
    return Served(which[0], weightB > 0.0 ? which[1] : kNobody, 1.0 - weightB, weightB, false);
}

Served servedAsInPaper(Sighted s) {
    bool seenByA = sees(0, s);
    bool seenByB = candidates > 1 && sees(1, s);
    float share = 0.0;
    if (candidates > 1) {
        vec3 axis = candidateCenter[1].xyz - candidateCenter[0].xyz;
        vec3 point = isinf(s.t) ? s.origin : s.origin + s.t * s.direction;
        float squared = dot(axis, axis);
        share = squared > 0.0
                    ? clamp(dot(point - candidateCenter[0].xyz, axis) / squared, 0.0, 1.0)
                    : 0.0;
    }
    bool uncovered = !seenByA && !seenByB;
    if (uncovered) {
        share = share > 0.5 ? 1.0 : 0.0;
    } else if (!seenByB) {
        share = 0.0;
    } else if (!seenByA) {
        share = 1.0;
    }
    return Served(0, candidates > 1 ? 1 : kNobody, 1.0 - share, share, uncovered);
}

// n of the plane {C + x : n.x = 1} through the surface that a REM shows around a direction; false
// where there is none (core/reconstruction/SurfaceRefinement).
bool planeAround(int i, vec3 direction, out vec3 plane) {
    const float kFlatness = 0.01;
    int n = candidatePlace[i].z;
    if (n < 2) {
        return false;
    }
    vec2 st;
    int face = faceOf(direction, st);
    ivec2 first = clamp(ivec2(floor((st + 1.0) * 0.5 * float(n) - 0.5)), ivec2(0), ivec2(n - 2));
    vec2 middle = 2.0 * vec2(first + 1) / float(n) - 1.0;
    // (0,1) (1,1) (1,0) (0,0), by column and row.
    vec4 distances = distancesAround(i, directionOnFace(face, middle));
    float half_ = 1.0 / float(n);
    vec4 lengths = vec4(length(vec3(1.0, middle + vec2(-half_, half_))),
                        length(vec3(1.0, middle + half_)),
                        length(vec3(1.0, middle + vec2(half_, -half_))),
                        length(vec3(1.0, middle - half_)));
    vec4 inverse = lengths / distances;
    float sum = inverse.x + inverse.y + inverse.z + inverse.w;
    float twist = inverse.w - inverse.z - inverse.x + inverse.y;
    if (!(sum > 0.0) || !(abs(twist) <= kFlatness * 0.25 * sum)) {
        return false;
    }
    float perTexel = 0.25 * float(n);
    float a = perTexel * (inverse.z + inverse.y - inverse.w - inverse.x);
    float b = perTexel * (inverse.x + inverse.y - inverse.w - inverse.z);
    float c = 0.25 * sum - a * middle.x - b * middle.y;
    vec3 axis = directionOnFace(face, vec2(0.0));
    vec3 sAxis = directionOnFace(face, vec2(1.0, 0.0)) - axis;
    vec3 tAxis = directionOnFace(face, vec2(0.0, 1.0)) - axis;
    plane = c * axis + a * sAxis + b * tAxis;
    return true;
}

// The hit moved onto the surface that a REM shows; as it was where that says nothing.
float refined(int i, Sighted s) {
    float limit = reach / length(s.direction);
    float t = s.t;
    for (int step = 0; step < 2; ++step) {
        vec3 fromCenter = s.origin + t * s.direction - candidateCenter[i].xyz;
        vec3 plane;
        if (fromCenter == vec3(0.0) || !planeAround(i, fromCenter, plane)) {
            return s.t;
        }
        t = (1.0 - dot(plane, s.origin - candidateCenter[i].xyz)) / dot(plane, s.direction);
        if (!(t > 0.0 && abs(t - s.t) <= limit)) {
            return s.t;
        }
    }
    return t;
}

struct Shown {
    vec3 radiance;
    float t;  // +infinity for sky
    bool uncovered;
};

// What the candidates show along a ray.
Shown shownAlong(vec3 origin, vec3 direction) {
    const float kSmallestDepth = 1e-6;
    Sighted s = Sighted(origin, direction, traceHeightfield(origin, direction));
    if (candidates == 0) {
        return Shown(vec3(0.0), s.t, true);
    }
    Served served = weighAsInPaper ? servedAsInPaper(s) : servedBySight(s);
    if (reach > 0.0 && !isinf(s.t) && !served.uncovered) {
        s.t = refined(served.weightA >= served.weightB ? served.a : served.b, s);
    }
    float inverse = isinf(s.t) ? 0.0 : 1.0 / max(s.t, kSmallestDepth);
    vec3 radiance = vec3(0.0);
    if (served.a != kNobody && served.weightA > 0.0) {
        vec3 look = direction + inverse * (origin - candidateCenter[served.a].xyz);
        radiance += served.weightA * radianceOf(served.a, look);
    }
    if (served.b != kNobody && served.weightB > 0.0) {
        vec3 look = direction + inverse * (origin - candidateCenter[served.b].xyz);
        radiance += served.weightB * radianceOf(served.b, look);
    }
    return Shown(radiance, s.t, served.uncovered);
}
