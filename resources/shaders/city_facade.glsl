// SPDX-License-Identifier: GPL-3.0-or-later
// Procedural façades: the drawing part of core/baking/Facade.cpp; measures and colours come ready
// from there (facadeStyle, facadeGrid) in a table.
#include "city_pattern.glsl"

layout(binding = 2) uniform usamplerBuffer facades;  // kFacadeTexels of CityMesh.h each
layout(binding = 4) uniform usamplerBuffer walls;    // corners (u, z) of gables' triangles

const int kFacadeTexels = 12;
const uint kModern = 1u, kShops = 2u, kAwnings = 4u, kShutters = 8u, kRusticated = 16u,
           kRectangular = 32u;

const vec3 kGlass = vec3(0.030, 0.042, 0.055);
const vec3 kSkyInGlass = vec3(0.060, 0.085, 0.110);
const vec3 kCurtain = vec3(0.34, 0.33, 0.30);
const vec3 kLamp = vec3(0.62, 0.42, 0.20);
const vec3 kShopLamp = vec3(0.75, 0.58, 0.36);
const float kCornice = 0.42;
const float kLitShare = 0.34;

struct Facade {
    vec2 tangent;
    float uMin, bay;
    float base, bottom, top;
    uint flags;
    float firstBay, lastBay, window, height;
    float sill, surround, frame, groundStorey;
    float storey, firstStorey, lastStorey, courses;
    float firstGround, lastGround, doorBay, margin;
    vec3 wall;
    uint seed;
    vec3 trim, frameColour, shutter, plinth, door;
    uint firstTriangle, triangles;  // of a gable
};

Facade facadeAt(uint index) {
    int at = int(index) * kFacadeTexels;
    vec4 t[6];
    for (int i = 0; i < 6; ++i)
        t[i] = uintBitsToFloat(texelFetch(facades, at + i));
    uvec4 wall = texelFetch(facades, at + 6);
    uvec4 trim = texelFetch(facades, at + 7);
    uvec4 frame = texelFetch(facades, at + 8);
    Facade f;
    f.tangent = t[0].xy;
    f.uMin = t[0].z;
    f.bay = t[0].w;
    f.base = t[1].x;
    f.bottom = t[1].y;
    f.top = t[1].z;
    f.flags = floatBitsToUint(t[1].w);
    f.firstBay = t[2].x;
    f.lastBay = t[2].y;
    f.window = t[2].z;
    f.height = t[2].w;
    f.sill = t[3].x;
    f.surround = t[3].y;
    f.frame = t[3].z;
    f.groundStorey = t[3].w;
    f.storey = t[4].x;
    f.firstStorey = t[4].y;
    f.lastStorey = t[4].z;
    f.courses = t[4].w;
    f.firstGround = t[5].x;
    f.lastGround = t[5].y;
    f.doorBay = t[5].z;
    f.margin = t[5].w;
    f.wall = uintBitsToFloat(wall.xyz);
    f.seed = wall.w;
    f.trim = uintBitsToFloat(trim.xyz);
    f.firstTriangle = trim.w;
    f.frameColour = uintBitsToFloat(frame.xyz);
    f.triangles = frame.w;
    f.shutter = uintBitsToFloat(texelFetch(facades, at + 9).xyz);
    f.plinth = uintBitsToFloat(texelFetch(facades, at + 10).xyz);
    f.door = uintBitsToFloat(texelFetch(facades, at + 11).xyz);
    return f;
}

bool has(Facade f, uint flag) {
    return (f.flags & flag) != 0u;
}

/// Where a point lies on the wall, and the sample's extents there.
struct WallPoint {
    float u, y, wu, wy;
    int column;
};

/// One row of storeys, or many: heights are measured from the floor of each.
struct Storeys {
    float firstFloor, height, first, last;
};

float across(Facade f, WallPoint w, float from, float to) {
    return periodicCoverage(w.u, f.bay, 0.5 * f.bay + from, 0.5 * f.bay + to, w.wu, f.firstBay,
                            f.lastBay);
}

float upward(Storeys s, WallPoint w, float from, float to) {
    return periodicCoverage(w.y - s.firstFloor, s.height, from, to, w.wy, s.first, s.last);
}

vec3 masonry(Facade f, WallPoint w) {
    float along = w.u + 0.37 * float(f.seed & 1023u);
    float tone = 1.0 + 0.035 * filteredNoise(along, w.y, 3.7, w.wu + w.wy, f.seed) +
                 0.022 * filteredNoise(along, w.y, 0.55, w.wu + w.wy, f.seed ^ 7u);
    vec3 colour = f.wall * tone;
    if (has(f, kModern)) {
        float joint = periodicCoverage(w.y - f.groundStorey, f.storey, 0.0, 0.05, w.wy) +
                      periodicCoverage(w.u, f.bay, 0.0, 0.03, w.wu);
        return colour * (1.0 - 0.35 * min(joint, 1.0));
    }
    float ground = intervalCoverage(w.y, -1e3, f.groundStorey - 0.25, w.wy);
    if (has(f, kRusticated)) {
        float joint = periodicCoverage(w.y, 0.42, 0.0, 0.035, w.wy);
        colour *= 1.0 - ground * (0.06 + 0.30 * joint);
    }
    colour = mix(colour, f.plinth * tone, intervalCoverage(w.y, -1e3, 0.62, w.wy));
    Storeys courses = Storeys(f.groundStorey - 0.25, f.storey, 0.0, f.courses);
    colour += upward(courses, w, 0.0, 0.05) * (0.52 - 1.0) * f.wall;
    colour += upward(courses, w, 0.05, 0.23) * (f.trim - f.wall);
    if (has(f, kRectangular)) {  // a gable has no cornice
        float foot = f.top - kCornice;
        colour = mix(colour, f.trim, intervalCoverage(w.y, foot, 1e4, w.wy));
        colour += intervalCoverage(w.y, foot - 0.11, foot, w.wy) * (0.50 - 1.0) * f.wall;
        colour += intervalCoverage(w.y, f.top - 0.5 * kCornice - 0.05, f.top - 0.5 * kCornice,
                                   w.wy) * (0.72 - 1.0) * f.trim;
    }
    return colour;
}

/// Windows of a row of storeys over the masonry.
void drawWindows(Facade f, WallPoint w, Storeys row, float night, inout vec3 colour,
                 inout vec3 emission) {
    float window = 0.5 * f.window;
    float head = f.sill + f.height;
    bool modern = has(f, kModern);
    if (f.surround > 0.0) {
        float outer = window + f.surround;
        float ledge = across(f, w, -outer - 0.07, outer + 0.07);
        colour += ledge * upward(row, w, f.sill - 0.20, f.sill - 0.12) * (0.55 - 1.0) * f.wall;
        colour += ledge * upward(row, w, f.sill - 0.12, f.sill) * (f.trim - f.wall);
        colour += across(f, w, -outer, outer) * upward(row, w, f.sill, head + f.surround) *
                  (f.trim - f.wall);
    }
    float opening = across(f, w, -window, window);
    float whole = upward(row, w, f.sill, head);
    float leaf = min(0.5 * f.window, 0.5 * f.bay - window - f.surround - 0.06);
    if (has(f, kShutters) && leaf > 0.3) {
        float inner = window + f.surround;
        float leaves = across(f, w, inner, inner + leaf) + across(f, w, -inner - leaf, -inner);
        float louvres = 1.0 - 0.35 * periodicCoverage(w.y, 0.11, 0.0, 0.04, w.wy);
        colour += leaves * whole * (louvres * f.shutter - f.wall);
    }
    colour += opening * whole * (f.frameColour - (f.surround > 0.0 ? f.trim : f.wall));

    // Panes: dark, bluish towards the top, with curtains of the window's own.
    float storey = floor((w.y - row.firstFloor) / row.height);
    float height01 = (w.y - row.firstFloor - storey * row.height - f.sill) / f.height;
    float own = resolved(2.2, w.wu + w.wy);
    float drawn = patternRandom(f.seed ^ 0xA1u, w.column, int(storey));
    float curtain = mix(0.24, drawn < 0.45 ? 0.05 : (drawn < 0.8 ? 0.25 : 0.75), own);
    float sky = mix(0.5, clamp(height01, 0.0, 1.0), own);
    vec3 pane = mix(mix(kGlass, kSkyInGlass, sky), kCurtain, curtain);
    bool on = patternRandom(f.seed ^ 0xB2u, w.column, int(storey)) < kLitShare;
    float lit = mix(kLitShare, on ? 0.65 + 0.35 * drawn : 0.0, own);

    // Modern windows are one pane; others have two wings below a transom.
    float bar = modern ? 0.0 : 0.03;
    float columns = modern ? across(f, w, -window + f.frame, window - f.frame)
                           : across(f, w, -window + f.frame, -bar) +
                                 across(f, w, bar, window - f.frame);
    float transom = f.sill + 0.68 * f.height;
    float rows = modern ? upward(row, w, f.sill + f.frame, head - f.frame)
                        : upward(row, w, f.sill + f.frame, transom - bar) +
                              upward(row, w, transom + bar, head - f.frame);
    colour += columns * rows * (pane - f.frameColour);
    colour *= 1.0 - 0.45 * opening * upward(row, w, head - 0.11, head);
    emission += night * lit * columns * rows * kLamp;
}

/// Linear colours of the palettes of Facade.cpp.
vec3 linearOf(uint srgb) {
    vec3 c = vec3(srgb >> 16 & 255u, srgb >> 8 & 255u, srgb & 255u) / 255.0;
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

vec3 goodsColour(uint seed) {
    const uint palette[6] =
        uint[6](0xC9B48Cu, 0x8E3B33u, 0x4F6F86u, 0xD9D2C2u, 0x6E7B4Eu, 0xB98443u);
    return linearOf(palette[patternHash(seed, 0, 0) % 6u]);
}

vec3 shopColour(uint seed) {
    const uint palette[6] =
        uint[6](0x8A3F38u, 0x3C6655u, 0x3D5270u, 0xA9823Fu, 0x55555Au, 0x7D5A47u);
    return linearOf(palette[patternHash(seed, 0, 0) % 6u]);
}

/// What is seen through a shop's pane: a dim room, goods on display; a: how much it is lit.
vec4 shopWindow(WallPoint w, float within, uint shop) {
    const float kItem = 0.36;
    vec3 room = mix(mix(kGlass, kSkyInGlass, clamp(w.y / 2.6, 0.0, 1.0)), vec3(0.30, 0.25, 0.18),
                    0.16);
    int item = int(floor(within / kItem));
    float height = 0.55 + 0.9 * patternRandom(shop ^ 0x33u, item, w.column);
    float margin = 0.05 + 0.1 * patternRandom(shop ^ 0x44u, item, w.column);
    float there = intervalCoverage(w.y, 0.4, height, w.wy) *
                  periodicCoverage(within, kItem, margin, kItem - margin, w.wu);
    vec3 goods = 0.55 * goodsColour(patternHash(shop, item, w.column));
    float own = resolved(kItem, w.wu);
    vec3 mean = mix(room, vec3(0.16, 0.13, 0.10), 0.2);
    return vec4(mix(mean, mix(room, goods, there), own), 0.7 + 0.3 * own * there);
}

/// A shop front in each bay of the ground floor.
void drawShops(Facade f, WallPoint w, float night, inout vec3 colour, inout vec3 emission) {
    Storeys row = Storeys(0.0, f.groundStorey, 0.0, 1.0);
    float window = 0.5 * f.bay - 0.24;
    uint shop = patternHash(f.seed ^ 0xC3u, w.column >> 1, 0);
    float own = resolved(4.0, w.wu);
    vec3 paint = mix(vec3(0.140, 0.115, 0.095), shopColour(shop), own);
    float opening = across(f, w, -window, window);
    colour = mix(colour, paint, opening * upward(row, w, 0.0, 3.25));
    colour = mix(colour, f.trim,
                 across(f, w, -window - 0.12, window + 0.12) * upward(row, w, 3.25, 3.33));
    float pane = 2.0 * window / max(1.0, floor(2.0 * window / 1.15));
    float within = w.u - floor(w.u / f.bay) * f.bay - 0.5 * f.bay + window;
    float mullions = mix(0.93, periodicCoverage(within, pane, 0.04, pane - 0.04, w.wu),
                         resolved(1.0, w.wu));
    float glass = opening * mullions * upward(row, w, 0.45, 2.55);
    vec4 inside = shopWindow(w, within, shop);
    colour += glass * (inside.rgb - paint);
    emission += night * glass * kShopLamp * inside.a;
    if (has(f, kAwnings) && (shop & 3u) != 0u) {
        float stripes = periodicCoverage(w.u, 0.44, 0.0, 0.22, w.wu);
        vec3 cloth = mix(vec3(0.72, 0.68, 0.58), paint * 1.7, stripes);
        float hang = opening * upward(row, w, 2.05, 2.62) * own;
        colour *= 1.0 - 0.5 * opening * own * upward(row, w, 1.75, 2.05);
        colour = mix(colour, min(cloth, vec3(0.8)), hang);
    }
}

void drawDoor(Facade f, WallPoint w, inout vec3 colour) {
    Storeys row = Storeys(0.0, f.groundStorey, 0.0, 1.0);
    colour = mix(colour, f.trim, across(f, w, -0.82, 0.82) * upward(row, w, 0.0, 2.75));
    colour += across(f, w, -0.66, 0.66) * upward(row, w, 0.0, 2.58) * (f.door - f.trim);
    colour += across(f, w, -0.60, 0.60) * upward(row, w, 2.15, 2.50) * (kSkyInGlass - f.door);
    float panels = (across(f, w, -0.52, -0.10) + across(f, w, 0.10, 0.52)) *
                   (upward(row, w, 0.2, 0.85) + upward(row, w, 1.0, 1.95));
    colour *= 1.0 - 0.25 * panels;
}

bool inTriangle(vec2 p, vec2 a, vec2 b, vec2 c) {
    vec3 side = vec3((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x),
                     (c.x - b.x) * (p.y - b.y) - (c.y - b.y) * (p.x - b.x),
                     (a.x - c.x) * (p.y - c.y) - (a.y - c.y) * (p.x - c.x));
    return all(greaterThanEqual(side, vec3(0.0))) || all(lessThanEqual(side, vec3(0.0)));
}

/// Whether the window of the point's bay and storey lies wholly on a gable's triangles.
bool windowFits(Facade f, WallPoint w, Storeys row) {
    if (f.triangles == 0u || w.wu > f.bay)
        return true;
    float storey = floor((w.y - row.firstFloor) / row.height);
    float foot = f.base + row.firstFloor + storey * row.height;
    float middle = f.uMin + f.margin + (float(w.column) + 0.5) * f.bay;
    float window = 0.5 * f.window + f.surround;
    vec2 u = middle + vec2(-window, window);
    vec2 z = foot + f.sill + vec2(-0.15, f.height + f.surround);
    bvec4 on = bvec4(false);
    for (uint i = 0u; i < f.triangles; ++i) {
        int at = 2 * int(f.firstTriangle + i);
        vec4 ab = uintBitsToFloat(texelFetch(walls, at));
        vec2 c = uintBitsToFloat(texelFetch(walls, at + 1).xy);
        on.x = on.x || inTriangle(vec2(u.x, z.x), ab.xy, ab.zw, c);
        on.y = on.y || inTriangle(vec2(u.y, z.x), ab.xy, ab.zw, c);
        on.z = on.z || inTriangle(vec2(u.x, z.y), ab.xy, ab.zw, c);
        on.w = on.w || inTriangle(vec2(u.y, z.y), ab.xy, ab.zw, c);
    }
    return all(on);
}

/// Albedo of a façade at a point; adds the light of its windows at night.
vec3 facadeColour(Facade f, vec3 point, vec3 normal, Footprint footprint, float night,
                  inout vec3 emission) {
    WallPoint w;
    w.u = dot(point.xy, f.tangent) - f.uMin - f.margin;
    w.y = point.z - f.base;
    w.wu = extentAlong(footprint, vec3(f.tangent, 0.0), normal);
    w.wy = extentAlong(footprint, vec3(0.0, 0.0, 1.0), normal);
    w.column = int(floor(w.u / f.bay));
    vec3 colour = masonry(f, w);

    // The CPU draws the rows of both the ground storey and those above at every point; here it is
    // the row of the point's own storey, which differs within a footprint of the line between.
    bool inGround = w.y < f.groundStorey;
    Storeys row = inGround ? Storeys(0.0, f.groundStorey, f.firstGround, f.lastGround)
                           : Storeys(f.groundStorey, f.storey, f.firstStorey, f.lastStorey);
    bool bays = f.lastBay > f.firstBay;
    bool shops = has(f, kShops) && f.top > f.groundStorey && f.bottom < 0.8;
    bool door = !shops && !has(f, kModern) && inGround && float(w.column) == f.doorBay &&
                f.top > 3.0;
    if (bays && row.last > row.first && !door && !(shops && inGround) && windowFits(f, w, row))
        drawWindows(f, w, row, night, colour, emission);
    if (bays && shops && inGround)
        drawShops(f, w, night, colour, emission);
    if (door)
        drawDoor(f, w, colour);
    return clamp(colour, 0.0, 0.95);
}
