// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// The look of a vehicle: core/rendering/BodyShading in GLSL. Schlick 1994 for all reflectances.

#ifndef LAYER
#define LAYER 0  // 0: opaque, 1: panes that face away, 2: panes that face us
#endif

#include "city_light.glsl"
#include "distance_impostor.glsl"
#ifdef PER_PIXEL
#include "rem_sight.glsl"
#endif

layout(binding = 0) uniform samplerBuffer materials;
layout(binding = 1) uniform samplerCube localMap;
layout(binding = 2) uniform samplerCube neighbourMap[2];
layout(binding = 4) uniform sampler2D frontPane;
layout(binding = 5) uniform sampler2D backPane;

uniform vec3 eye;             // project frame
uniform int couplings;        // neighbours that the map fades into
uniform vec4 couplingAxis[2]; // towards its centre / squared distance; half width of the fade
uniform vec3 mapCenter;       // relative to the eye
uniform bool mapAtInfinity;   // looked up by direction alone
uniform vec3 neighbourCenter[2];
#ifdef PER_PIXEL
layout(binding = 9) uniform samplerCube cityMap;  // localMap without vehicles
uniform vec3 sightCenter;  // P of rem_sight, relative to the eye
#endif
uniform vec3 interiorLight;   // what fills a cabin
uniform vec3 smear;           // the way along which reflections are smeared; 0: sharp

in vec3 fromEye;
in vec3 facing;
flat in uint materialIndex;

layout(location = 0, index = 0) out vec4 added;   // radiance of the surface itself
layout(location = 0, index = 1) out vec4 passes;  // share of what is behind that comes through

const float kDielectricF0 = 0.04;
const float kGlazingF0 = 0.077;
const float kGlintExponent = 1800.0;
const float kLining = 0.36;
const int kSmearSamples = 8;

struct Material {
    vec3 baseColor;
    float clearCoat;
    vec3 emission;
    float metallic;
    float glass;
};

Material fetchMaterial() {
    int row = 3 * int(materialIndex);
    vec4 a = texelFetch(materials, row);
    vec4 b = texelFetch(materials, row + 1);
    return Material(a.rgb, a.a, b.rgb, b.a, texelFetch(materials, row + 2).r);
}

float raised(float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}
float schlick(float f0, float cosine) {
    return f0 + (1.0 - f0) * raised(cosine);
}

// Radiance of the sun in the polish, where nothing hides it.
vec3 sunGlint(vec3 reflected) {
    float cosine = max(dot(reflected, sunDirection.xyz), 0.0);
    float lobe = 0.5 * (kGlintExponent + 1.0) * pow(cosine, kGlintExponent);
    return cosine < 0.99 ? vec3(0.0) : sunRadiance.rgb * lobe;
}

// Where a map shows what a ray from the surface meets.
vec3 towardsHit(samplerCube map, vec3 center, vec3 direction) {
    return mapAtInfinity ? direction
                         : normalize(directionOfHit(map, fromEye - center, direction));
}

// What a map shows along a ray from the surface.
vec3 seenIn(samplerCube map, vec3 center, vec3 direction, vec3 dx, vec3 dy) {
    return textureGrad(map, towardsHit(map, center, direction), dx, dy).rgb;
}

// towards: where localMap shows what the ray meets.
vec3 mirroredByMaps(vec3 direction, vec3 towards, vec3 dx, vec3 dy) {
    vec3 radiance = textureGrad(localMap, towards, dx, dy).rgb;
    for (int i = 0; i < couplings; ++i) {
        float along = dot(fromEye - mapCenter, couplingAxis[i].xyz);
        float share = smoothstep(0.5 - couplingAxis[i].w, 0.5 + couplingAxis[i].w, along);
        if (share > 0.0) {
            vec3 other =
                i == 0 ? seenIn(neighbourMap[0], neighbourCenter[0], direction, dx, dy)
                       : seenIn(neighbourMap[1], neighbourCenter[1], direction, dx, dy);
            radiance = mix(radiance, other, share);
        }
    }
    return radiance;
}

vec3 mirroredSharp(vec3 direction) {
    // Of the mirrored rays: across an edge of what they meet there is nothing to filter over.
    vec3 dx = dFdx(direction);
    vec3 dy = dFdy(direction);
    vec3 towards = towardsHit(localMap, mapCenter, direction);
#ifdef PER_PIXEL
    vec4 with = textureGather(localMap, towards, 3);
    vec4 without = textureGather(cityMap, towards, 3);
    float vehicles = dot(vec4(notEqual(with, without)), vec4(0.25));
    vec3 radiance =
        vehicles < 1.0 ? shownAlong(fromEye - sightCenter, direction).radiance : vec3(0.0);
    if (vehicles > 0.0)
        radiance = mix(radiance, mirroredByMaps(direction, towards, dx, dy), vehicles);
    return radiance;
#else
    return mirroredByMaps(direction, towards, dx, dy);
#endif
}

// What is mirrored while the vehicle moves along `smear`: what is near smears, the sky does not.
// Seen from a place s further on, the point d·r lies in the direction d·r - s.
vec3 mirrored(vec3 direction) {
    if (smear == vec3(0.0))
        return mirroredSharp(direction);
    float away = abs(textureLod(localMap, direction, 0.0).a);
    vec3 turn = isinf(away) ? vec3(0.0) : smear / max(away, 0.5);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < kSmearSamples; ++k) {
        float share = (float(k) + 0.5) / float(kSmearSamples) - 0.5;
        sum += mirroredSharp(normalize(direction - share * turn));
    }
    return sum / float(kSmearSamples);
}

vec3 outside(Material m, vec3 normal, vec3 geometric, vec3 direction) {
    float cosine = max(-dot(normal, direction), 0.0);
    vec3 metal = m.metallic * (m.baseColor + (1.0 - m.baseColor) * raised(cosine));
    float coat = m.clearCoat * schlick(kDielectricF0, cosine);
    float pane = m.glass * schlick(kGlazingF0, cosine);
    vec3 gloss = vec3(coat + pane) + metal * ((1.0 - coat) * (1.0 - pane));
    vec3 point = eye + fromEye;
    vec3 radiance = m.emission;
    // Kept above the triangle itself, as an interpolated normal may send it below.
    vec3 r = reflect(direction, normal);
    float above = dot(r, geometric);
    r = normalize(above < 0.01 ? r + (0.01 - above) * geometric : r);
    // One look at the shadows serves both the paint and the glint.
    float sun = dot(normal, sunDirection.xyz);
    float lit = mix(1.0, sunVisibility(point, sun > 0.0 ? normal : -normal), sunRadiance.w);
    radiance += gloss * (mirrored(r) + lit * sunGlint(r));
    float matt = (1.0 - coat) * (1.0 - m.metallic) * (1.0 - m.glass);
    vec3 diffuse = sunRadiance.rgb * (lit * max(sun, 0.0)) + ambientLight(point, normal);
    return radiance + m.baseColor * matt * diffuse;
}

vec3 inside(Material m, vec3 normal) {
    vec3 color = gl_FrontFacing ? m.baseColor : vec3(kLining);
    return m.emission + color * interiorLight * (0.7 + 0.5 * normal.z);
}

void main() {
    Material m = fetchMaterial();
    vec3 direction = normalize(fromEye);
    vec3 geometric = normalize(cross(dFdx(fromEye), dFdy(fromEye)));
    geometric = dot(geometric, direction) > 0.0 ? -geometric : geometric;
    vec3 normal = normalize(facing);
    normal = gl_FrontFacing ? normal : -normal;

#if LAYER == 0
    // Between the pane that faces us and the one on the far side lies the cabin.
    ivec2 place = ivec2(gl_FragCoord.xy);
    bool behindGlass = gl_FragCoord.z < texelFetch(frontPane, place, 0).r &&
                       gl_FragCoord.z >= texelFetch(backPane, place, 0).r;
    vec3 shown = outside(m, normal, geometric, direction);
    shown = gl_FrontFacing ? shown : vec3(0.0);
    added = vec4(behindGlass ? inside(m, normal) : shown, 1.0);
    passes = vec4(0.0);
#else
    float through = (1.0 - schlick(kGlazingF0, abs(dot(normal, direction)))) *
                    (1.0 - m.metallic) * m.glass;
    passes = vec4(m.baseColor * through, 1.0);
#if LAYER == 1
    added = vec4((1.0 - m.glass) * inside(m, normal), 0.0);
#else
    added = vec4(outside(m, normal, geometric, direction), 0.0);
#endif
#endif
}
