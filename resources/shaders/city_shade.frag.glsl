// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// Shades the pixels of one kind of look (ShadeKind of CityMesh.h): the stencil test keeps the
// others out. KIND is 0 for the sky.
#ifndef KIND
#define KIND 0
#endif
#include "city_light.glsl"
#include "city_pattern.glsl"

in vec2 uv;

layout(location = 0) out vec4 radiance;
layout(location = 1) out float eyeDistance;

uniform vec3 eye;
uniform vec3 forward;
uniform vec3 right;  // times the tangent of half the angle
uniform vec3 up;

#if KIND == 0

void main() {
    vec3 direction = forward + (2.0 * uv.x - 1.0) * right + (2.0 * uv.y - 1.0) * up;
    radiance = vec4(skyRadiance(direction), 1.0);
    eyeDistance = uintBitsToFloat(0x7f800000u);  // +infinity
}

#else

layout(binding = 0) uniform usampler2D numbers;
layout(binding = 1) uniform usamplerBuffer triangles;
layout(binding = 3) uniform usamplerBuffer surfaces;

uniform float spread;

const int kSurfaceTexels = 5;

#if KIND == 2 || KIND == 3
#include "city_ground.glsl"
#elif KIND == 4
#include "city_facade.glsl"
#elif KIND == 5
#include "city_textured.glsl"
layout(binding = 5) uniform usamplerBuffer mapping;
uniform int firstTextured;
#endif

void main() {
    int number = int(texelFetch(numbers, ivec2(gl_FragCoord.xy), 0).r);
    uvec4 plane = texelFetch(triangles, 2 * number);
    vec3 normal = uintBitsToFloat(plane.xyz);
    vec3 corner = uintBitsToFloat(texelFetch(triangles, 2 * number + 1).xyz);
    int surface = int(plane.w) * kSurfaceTexels;

    // Where the pixel's ray meets the triangle's plane.
    vec3 direction = forward + (2.0 * uv.x - 1.0) * right + (2.0 * uv.y - 1.0) * up;
    float along = dot(normal, corner - eye) / dot(normal, direction);
    vec3 way = along * direction;
    vec3 position = eye + way;
    eyeDistance = length(way);
    normal = dot(normal, direction) > 0.0 ? -normal : normal;

    uvec4 first = texelFetch(surfaces, surface);
    uvec4 second = texelFetch(surfaces, surface + 1);
    vec3 albedo = uintBitsToFloat(first.xyz);
    vec3 emission = uintBitsToFloat(second.xyz);
#if KIND == 2 || KIND == 3
    vec4 extent = uintBitsToFloat(texelFetch(surfaces, surface + 2));
    Pattern pattern = Pattern(first.w, second.w, extent.x, extent.y, extent.zw);
    Footprint footprint = Footprint(way / eyeDistance, eyeDistance * spread);
#if KIND == 2
    albedo = groundColour(albedo, pattern, position, normal, footprint);
#else
    albedo = jointedColour(albedo, pattern, position, normal, footprint);
#endif
    albedo = clamp(albedo, 0.0, 1.0);
#elif KIND == 4
    Facade facade = facadeAt(texelFetch(surfaces, surface + 3).x);
    Footprint footprint = Footprint(way / eyeDistance, eyeDistance * spread);
    albedo = facadeColour(facade, position, normal, footprint, sunDirection.w, emission);
#elif KIND == 5
    uvec4 place = texelFetch(surfaces, surface + 4);
    vec4 u = uintBitsToFloat(texelFetch(mapping, 2 * (number - firstTextured)));
    vec4 v = uintBitsToFloat(texelFetch(mapping, 2 * (number - firstTextured) + 1));
    vec3 offset = position - corner;
    vec2 at = vec2(dot(u.xyz, offset) + u.w, dot(v.xyz, offset) + v.w);
    // The ellipse of the pixel's cone on the plane: its longer axis lies along the ray.
    vec3 toward = way / eyeDistance;
    float facing = max(abs(dot(toward, normal)), 0.02);
    vec3 slanted = toward - normal * dot(toward, normal);
    float slant = length(slanted);
    vec3 longer = slant > 1e-4 ? slanted / slant
                               : normalize(cross(normal, abs(normal.x) < 0.9 ? vec3(1.0, 0.0, 0.0)
                                                                             : vec3(0.0, 1.0, 0.0)));
    vec3 shorter = cross(normal, longer) * (eyeDistance * spread);
    longer *= eyeDistance * spread / facing;
    vec4 image = sampleImage(place, at, vec2(dot(u.xyz, longer), dot(v.xyz, longer)),
                             vec2(dot(u.xyz, shorter), dot(v.xyz, shorter)));
    vec3 tint = uintBitsToFloat(texelFetch(surfaces, surface + 3).yzw);
    albedo = mix(albedo, tint * image.rgb, image.a);
#endif
    vec3 light = sunLight(position, normal) + ambientLight(position, normal);
    radiance = vec4(albedo * light + emission, 1.0);
}

#endif
