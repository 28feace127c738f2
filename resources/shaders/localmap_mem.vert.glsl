// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// The looks of an adaptive mesh as rectangles of whole texels: six vertices a look, without
// attributes. The table is that of core/gpu/reflection/QuadTable.h.

layout(binding = 2) uniform samplerBuffer leaves;
uniform int firstLook;
uniform int resolution;

flat out vec4 leafPlace;     // s0, t0, 1 / (s1 - s0), 1 / (t1 - t0)
flat out vec4 inverseDepth;  // at the corners
flat out vec4 weights;       // at the corners
flat out int leafFlags;

const int kFlag = 65536;

void main() {
    int row = 4 * (firstLook + gl_VertexID / 6);
    vec4 texels = texelFetch(leaves, row);
    leafFlags = int(texels.x) / kFlag;
    texels.x -= float(leafFlags * kFlag);
    leafPlace = texelFetch(leaves, row + 1);
    inverseDepth = texelFetch(leaves, row + 2);
    weights = texelFetch(leaves, row + 3);

    const vec2 kCorner[6] = vec2[](vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0, 1), vec2(1, 0),
                                   vec2(1, 1));
    vec2 texel = mix(texels.xy, texels.zw, kCorner[gl_VertexID % 6]);
    gl_Position = vec4(2.0 * texel / float(resolution) - 1.0, 0.0, 1.0);
}
