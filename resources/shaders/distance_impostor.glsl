// SPDX-License-Identifier: GPL-3.0-or-later
// Rays that start beside the centre of a local map: core/environment/DistanceImpostor in GLSL.

#include "cube_face.glsl"

// 1/distance that a map (a: metres, level 0) holds in a direction, interpolated; 0 for sky.
float nearness(samplerCube map, vec3 direction) {
    vec2 st;
    faceOf(direction, st);
    vec4 inverse = 1.0 / abs(textureGather(map, direction, 3));
    vec2 share = fract((st + 1.0) * 0.5 * float(textureSize(map, 0).x) - 0.5);
    vec2 along = mix(inverse.wx, inverse.zy, share.x);
    return mix(along.x, along.y, share.y);
}

// How far behind the map's surface a point lies, from the centre: below 0 in front of it.
float behindSurface(samplerCube map, vec3 point) {
    return length(point) * nearness(map, point) - 1.0;
}

// The direction in which the map shows what a ray meets; origin: from its centre.
vec3 directionOfHit(samplerCube map, vec3 origin, vec3 direction) {
    const int kPlaces = 8;
    const int kSecants = 3;
    float away = length(origin);
    if (!(away > 1e-4)) {
        return direction;
    }
    float from = 0.0;
    float before = behindSurface(map, origin);
    if (!(before < 0.0)) {
        return origin;
    }
    for (int k = 1; k <= kPlaces; ++k) {
        float to;
        if (k < kPlaces) {
            to = away * float(k) / float(kPlaces - k);
        } else {
            float far = nearness(map, direction);
            if (!(far > 0.0)) {
                return direction;
            }
            to = from + away + 1.0 / far;
        }
        float after = behindSurface(map, origin + to * direction);
        if (after < 0.0) {
            from = to;
            before = after;
            continue;
        }
        for (int step = 0; step < kSecants && after > before; ++step) {
            float middle = from - before * (to - from) / (after - before);
            float there = behindSurface(map, origin + middle * direction);
            if (there < 0.0) {
                from = middle;
                before = there;
            } else {
                to = middle;
                after = there;
            }
        }
        float hit = after > before ? from - before * (to - from) / (after - before) : to;
        return origin + hit * direction;
    }
    return origin + from * direction;
}
