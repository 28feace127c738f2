// SPDX-License-Identifier: GPL-3.0-or-later
// Procedural looks of all but façades: the same formulas as core/baking/Pattern.h and
// SurfacePattern.cpp, so that a map baked on the CPU and a picture drawn here look alike.

const float kFinest = 2e-3;

/// The cone that a pixel looks through where it meets a surface.
struct Footprint {
    vec3 direction;  // unit
    float width;     // across the ray at the surface, metres
};

/// Extent along the unit axis of a plane with a unit normal.
float extentAlong(Footprint f, vec3 axis, vec3 normal) {
    float facing = max(abs(dot(f.direction, normal)), 0.02);
    float slant = dot(f.direction, axis) / facing;
    return max(f.width * sqrt(1.0 + slant * slant), kFinest);
}

uint patternHash(uint seed, int x, int y) {
    uint h = seed + 0x9e3779b9u * uint(x) + 0x85ebca6bu * (uint(y) ^ 0x27d4eb2fu);
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

float patternRandom(uint seed, int x, int y) {
    return float(patternHash(seed, x, y) >> 8) * (1.0 / 16777216.0);
}

float valueNoise(vec2 p, uint seed) {
    vec2 cell = floor(p);
    vec2 t = p - cell;
    vec2 w = t * t * (3.0 - 2.0 * t);
    ivec2 i = ivec2(cell);
    float south = mix(patternRandom(seed, i.x, i.y), patternRandom(seed, i.x + 1, i.y), w.x);
    float north =
        mix(patternRandom(seed, i.x, i.y + 1), patternRandom(seed, i.x + 1, i.y + 1), w.x);
    return 2.0 * mix(south, north, w.y) - 1.0;
}

/// 1 when a detail of this size is resolved, 0 when only its mean remains.
float resolved(float detail, float extent) {
    float t = clamp((extent / detail - 0.35) / 0.9, 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

float filteredNoise(float x, float y, float wavelength, float extent, uint seed) {
    return resolved(wavelength, extent) * valueNoise(vec2(x, y) / wavelength, seed);
}

/// The share of the interval of width w around x that lies in [from, to].
float intervalCoverage(float x, float from, float to, float w) {
    return clamp((min(x + 0.5 * w, to) - max(x - 0.5 * w, from)) / w, 0.0, 1.0);
}

/// The same for an interval repeated with a period, in cells first..last (last not included).
float periodicCoverage(float x, float period, float from, float to, float w, float first,
                       float last) {
    float base = floor(x / period);
    float within = x - base * period;
    vec2 at = within + vec2(0.5, -0.5) * w;
    vec2 cells = clamp(at / period, vec2(first - base), vec2(last - base));
    vec2 cell = floor(cells);
    vec2 integral =
        cell * (to - from) + clamp((cells - cell) * period - from, 0.0, to - from);
    return clamp((integral.x - integral.y) / w, 0.0, 1.0);
}
float periodicCoverage(float x, float period, float from, float to, float w) {
    return periodicCoverage(x, period, from, to, w, -1e6, 1e6);
}
