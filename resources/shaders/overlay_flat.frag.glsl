// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// Stems, ribbons with marks of direction, discs, rings and handles, with edges a pixel wide.

#include "overlay_depth.glsl"

in vec3 fromEye;
in vec4 color;
in vec2 place;
flat in int pattern;
flat in float slack;

layout(location = 0) out vec4 drawn;

const float kMarkEvery = 9.0;  // metres between the marks of direction
const float kMarkLength = 1.5;
const float kHatchEvery = 2.4;  // metres between the stripes of a hatching

// 1 inside (distance < 0), 0 outside, over about a pixel.
float inside(float distance) {
    return clamp(0.5 - distance / max(fwidth(distance), 1e-5), 0.0, 1.0);
}

vec4 ribbon() {
    float edge = abs(place.x);
    vec4 tone = color;
    float alpha = color.a * inside(edge - 1.0);
    float rim = inside(0.82 - edge);
    // A chevron whose tip points along the route.
    float along = mod(place.y + 1.2 * edge, kMarkEvery);
    float mark = inside(abs(along - kMarkLength) - 0.45) * inside(edge - 0.7);
    tone.rgb = mix(tone.rgb, vec3(1.0), max(0.55 * rim, 0.9 * mark));
    return vec4(tone.rgb, max(alpha, mark * alpha + 0.25 * mark));
}

// A stretch of a coverage, with light edges; a poor one is hatched across.
vec4 band(bool poor) {
    float edge = abs(place.x);
    vec4 tone = color;
    tone.a *= inside(edge - 1.0);
    tone.rgb = mix(tone.rgb, vec3(1.0), 0.85 * inside(0.9 - edge));
    if (poor) {
        float stripe = abs(mod(place.y + 1.3 * place.x, kHatchEvery) - 0.5 * kHatchEvery);
        tone.rgb = mix(tone.rgb, vec3(1.0), 0.8 * inside(stripe - 0.14 * kHatchEvery));
    }
    return tone;
}

// A piece of a facade: full, or hollow where it is poorly covered.
vec4 spot(bool poor) {
    float box = max(abs(place.x), abs(place.y));
    vec4 tone = color;
    tone.a *= inside(box - 1.0);
    float frame = inside(0.78 - box);
    tone.rgb = mix(tone.rgb, vec3(1.0), poor ? 0.9 * frame : 0.0);
    return tone;
}

// A probe that does not exist yet: a broken ring around a dot.
vec4 ghost(float radius) {
    float turn = fract(atan(place.y, place.x) / 6.2831853);
    float dash = step(0.35, fract(turn * 8.0));
    float mark = max(inside(abs(radius - 0.8) - 0.12) * dash, inside(radius - 0.34));
    float rim = max(inside(abs(radius - 0.8) - 0.19) * dash, inside(radius - 0.42));
    return vec4(mix(vec3(0.03), color.rgb, mark), color.a * rim);
}

void main() {
    float radius = length(place);
    vec4 tone = color;
    if (pattern == 1) {
        tone = ribbon();
    } else if (pattern == 2) {
        tone.a *= inside(radius - 1.0);
    } else if (pattern == 3) {
        float ring = inside(abs(radius - 0.84) - 0.14);
        float dot = inside(radius - 0.16);
        tone.a *= max(ring, dot);
        tone.rgb = mix(vec3(0.05), tone.rgb, max(inside(abs(radius - 0.84) - 0.08), dot));
    } else if (pattern == 4) {
        float box = max(abs(place.x), abs(place.y));
        tone.a *= inside(box - 0.95);
        tone.rgb = mix(vec3(0.0, 0.35, 0.6), tone.rgb, inside(box - 0.62));
    } else if (pattern == 5 || pattern == 6) {
        tone = band(pattern == 6);
    } else if (pattern == 7 || pattern == 8) {
        tone = spot(pattern == 8);
        tone.a *= step(1.0, visibility(fromEye, slack));
    } else if (pattern == 9) {
        tone = ghost(radius);
    } else {
        tone.a *= 1.0 - smoothstep(0.6, 1.0, abs(place.x));
    }
    tone.a *= visibility(fromEye, slack);
    drawn = tone;
}
