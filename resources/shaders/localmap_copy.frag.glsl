// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// A drawn view of the city becomes a face of a local map: radiance and distance in one texel.

layout(binding = 0) uniform sampler2D radiance;
layout(binding = 1) uniform sampler2D distances;

layout(location = 0) out vec4 texel;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    texel = vec4(texelFetch(radiance, place, 0).rgb, texelFetch(distances, place, 0).r);
}
