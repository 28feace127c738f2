// SPDX-License-Identifier: GPL-3.0-or-later
// Ground, roofs and trees: core/baking/SurfacePattern.cpp.
#include "city_pattern.glsl"

// LookKind of core/baking/SurfaceLook.h.
const uint kPlaster = 2u, kFlatRoof = 3u, kTiledRoof = 4u, kAsphalt = 5u, kSlabs = 6u,
           kPaving = 7u, kGrass = 8u, kEarth = 9u, kWater = 10u, kFoliage = 11u, kStone = 12u;

/// What a look needs beyond its colour.
struct Pattern {
    uint kind;
    uint seed;    // of the building
    float base;   // lowest and highest z of the object
    float top;
    vec2 center;
};

float groundExtent(vec3 normal, Footprint f) {
    return max(extentAlong(f, vec3(1.0, 0.0, 0.0), normal),
               extentAlong(f, vec3(0.0, 1.0, 0.0), normal));
}

/// Three octaves of noise on scaled coordinates: what all looks without joints are made of. Which,
/// is a table and not a branch, since the processors that draw in software take all branches.
struct Octaves {
    vec3 strength;
    vec3 wavelength;
    uvec3 seed;
};

Octaves octavesOf(Pattern p) {
    if (p.kind == kAsphalt)
        return Octaves(vec3(0.060, 0.045, 0.040), vec3(9.0, 1.3, 0.16), uvec3(11u, 12u, 13u));
    if (p.kind == kGrass)
        return Octaves(vec3(0.10, 0.09, 0.10), vec3(6.0, 1.1, 0.21), uvec3(41u, 42u, 43u));
    if (p.kind == kEarth)
        return Octaves(vec3(0.06, 0.06, 0.0), vec3(3.1, 0.4, 1.0), uvec3(52u, 53u, 0u));
    if (p.kind == kWater)
        return Octaves(vec3(0.05, 0.05, 0.0), vec3(2.4, 11.0, 1.0), uvec3(61u, 62u, 0u));
    if (p.kind == kFlatRoof)
        return Octaves(vec3(0.06, 0.05, 0.0), vec3(4.3, 0.35, 1.0), uvec3(p.seed, p.seed ^ 3u, 0u));
    if (p.kind == kFoliage)
        return Octaves(vec3(0.20, 0.20, 0.0), vec3(0.9, 0.22, 1.0), uvec3(p.seed, p.seed ^ 9u, 0u));
    return Octaves(vec3(0.045, 0.035, 0.0), vec3(2.6, 0.4, 1.0), uvec3(71u, 72u, 0u));  // stone
}

/// Where the first two octaves are taken.
vec4 octavePlaces(Pattern p, vec3 at) {
    if (p.kind == kWater)
        return vec4(at.x, 2.3 * at.y, at.x + at.y, at.y - at.x);
    if (p.kind == kFoliage)
        return vec4(at.x + 0.6 * at.z, at.y + 0.8 * at.z, at.x - 0.7 * at.z, at.y + 0.5 * at.z);
    if (p.kind == kStone || p.kind == kPlaster)
        return vec4(at.x + 0.3 * at.z, at.y + at.z, at.x + at.z, at.y - 0.4 * at.z);
    return at.xyxy;
}

/// Asphalt, grass, earth, water, flat roofs, trees, stone and plaster.
vec3 groundColour(vec3 base, Pattern p, vec3 at, vec3 normal, Footprint f) {
    float extent = groundExtent(normal, f);
    Octaves o = octavesOf(p);
    vec4 place = octavePlaces(p, at);
    float first = p.kind == kWater ? 2.0 * extent : extent;
    float tone = o.strength.x * filteredNoise(place.x, place.y, o.wavelength.x, first, o.seed.x) +
                 o.strength.y * filteredNoise(place.z, place.w, o.wavelength.y, extent, o.seed.y) +
                 o.strength.z * filteredNoise(at.x, at.y, o.wavelength.z, extent, o.seed.z);
    bool grass = p.kind == kGrass;
    float patches = 0.5 + 0.5 * filteredNoise(at.x, at.y, grass ? 17.0 : 23.0, extent,
                                              grass ? 44u : 51u);
    vec3 colour = base;
    if (grass)
        colour = mix(base, base * vec3(1.25, 1.05, 0.85), 0.5 * patches);
    if (p.kind == kEarth)
        colour = mix(base, base * vec3(0.86, 0.98, 0.80), patches);
    if (p.kind == kFoliage) {
        float height = max(p.top - p.base, 0.1);
        float level = (at.z - p.base) / height;
        vec3 own = mix(base, base * vec3(1.28, 1.04, 0.75), patternRandom(p.seed, 1, 0)) *
                   (0.88 + 0.24 * patternRandom(p.seed, 2, 0));
        colour = own * (0.80 + 0.28 * clamp(level, 0.0, 1.0));
        if (level < 0.5 && distance(at.xy, p.center) < 0.1 + 0.05 * height) {
            colour = vec3(0.115, 0.085, 0.062);
            tone = 0.18 * filteredNoise(3.0 * (at.x + at.y), at.z, 0.5, 3.0 * extent, p.seed);
        }
    }
    return colour * (1.0 + tone);
}

float joints(vec3 p, vec2 extent, float size, float joint) {
    float x = periodicCoverage(p.x, size, 0.0, joint, extent.x);
    float y = periodicCoverage(p.y, size, 0.0, joint, extent.y);
    return x + y - x * y;
}

/// Courses of tiles along the slope, each tile with a tone of its own.
vec3 tiledRoof(vec3 base, vec3 at, vec3 normal, Footprint f, uint seed) {
    vec3 n = normal.z < 0.0 ? -normal : normal;
    vec3 course = cross(vec3(0.0, 0.0, 1.0), n);
    float len = length(course);
    course = len < 1e-4 ? vec3(1.0, 0.0, 0.0) : course / len;
    vec3 upslope = cross(n, course);
    float x = dot(at, course);
    float y = dot(at, upslope);
    float wx = extentAlong(f, course, n);
    float wy = extentAlong(f, upslope, n);
    const float kRow = 0.36;
    const float kTile = 0.24;
    int row = int(floor(y / kRow));
    int column = int(floor(x / kTile + 0.5 * float(row & 1)));
    float own = resolved(kTile, wx) * resolved(kRow, wy);
    float tone = 0.10 * own * (2.0 * patternRandom(seed, column, row) - 1.0) +
                 0.05 * filteredNoise(x, y, 3.3, wx + wy, seed ^ 5u);
    float shadow = periodicCoverage(y, kRow, 0.0, 0.06, wy);
    float rib = periodicCoverage(x, kTile, 0.0, 0.05, wx);
    vec3 tiled = base * (1.0 + tone) * (1.0 - 0.38 * shadow) * (1.0 - 0.15 * rib);
    return len < 1e-4 ? base : tiled;
}

/// Slabs, a square's paving and tiled roofs.
vec3 jointedColour(vec3 base, Pattern p, vec3 at, vec3 normal, Footprint f) {
    bool paving = p.kind == kPaving;
    vec2 extents = vec2(extentAlong(f, vec3(1.0, 0.0, 0.0), normal),
                        extentAlong(f, vec3(0.0, 1.0, 0.0), normal));
    float extent = max(extents.x, extents.y);
    float size = paving ? 0.6 : 0.5;
    ivec2 slab = ivec2(floor(at.xy / size));
    float own = resolved(size, extent) * (2.0 * patternRandom(paving ? 31u : 21u, slab.x, slab.y) - 1.0);
    float tone = (paving ? 0.070 : 0.055) * own +
                 (paving ? 0.035 : 0.04) * filteredNoise(at.x, at.y, paving ? 8.0 : 5.0, extent,
                                                         paving ? 32u : 22u);
    if (paving)
        tone += 0.025 * filteredNoise(at.x, at.y, 0.9, extent, 33u);
    float band = paving ? joints(at, extents, 6.0, 0.6) : 0.0;
    vec3 stone = mix(base, base * vec3(0.60, 0.58, 0.57), band) * (1.0 + tone) *
                 (1.0 - (paving ? 0.30 : 0.32) * joints(at, extents, size, paving ? 0.022 : 0.025));
    return p.kind == kTiledRoof ? tiledRoof(base, at, normal, f, p.seed) : stone;
}
