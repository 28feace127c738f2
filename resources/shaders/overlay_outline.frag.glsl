// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// A line around a mask.

layout(binding = 0) uniform sampler2D mask;
uniform vec3 color;
uniform int width;  // pixels

layout(location = 0) out vec4 drawn;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    if (texelFetch(mask, place, 0).r > 0.5) {
        discard;
    }
    ivec2 last = textureSize(mask, 0) - 1;
    float near = 0.0;
    for (int k = 0; k < 8; ++k) {
        const ivec2 kWay[8] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1),
                                      ivec2(1, 1), ivec2(-1, 1), ivec2(1, -1), ivec2(-1, -1));
        int reach = k < 4 ? width : max(1, (width * 7) / 10);
        near = max(near, texelFetch(mask, clamp(place + kWay[k] * reach, ivec2(0), last), 0).r);
    }
    if (near < 0.5) {
        discard;
    }
    drawn = vec4(color, 0.95);
}
