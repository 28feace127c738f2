// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// A face of a local map as a picture that vehicles are drawn into: its radiance, and its distances
// as reversed depth (core/gpu/city/CityView.h). A texel becomes samplesPerEdge² pixels.

#include "localmap_face.glsl"  // resolution: pixels along the edge

layout(binding = 0) uniform samplerCube city;  // unfiltered
uniform int samplesPerEdge;
uniform float near;  // metres

layout(location = 0) out vec4 radiance;

void main() {
    vec2 pixel = floor(gl_FragCoord.xy / float(samplesPerEdge)) * float(samplesPerEdge) +
                 0.5 * float(samplesPerEdge);
    vec4 held = textureLod(city, faceDirection(2.0 * pixel / float(resolution) - 1.0), 0.0);
    radiance = vec4(held.rgb, 1.0);
    gl_FragDepth = clamp(near * length(faceDirection(texelPlace())) / abs(held.a), 0.0, 1.0);
}
