// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// Smooths edges of a picture with one sample a pixel (after Lottes 2009, FXAA): where the lightness
// of the neighbours differs much, the pixel is averaged along the edge.

layout(binding = 0) uniform sampler2D picture;

layout(location = 0) out vec4 smoothed;

const float kLeastContrast = 0.06;    // absolute
const float kContrastShare = 0.16;    // of the lightest neighbour
const float kLongest = 6.0;           // pixels along the edge

float lightness(vec3 c) {
    return dot(c, vec3(0.299, 0.587, 0.114));
}

void main() {
    ivec2 size = textureSize(picture, 0);
    ivec2 place = ivec2(gl_FragCoord.xy);
    ivec2 low = max(place - 1, ivec2(0));
    ivec2 high = min(place + 1, size - 1);
    vec3 own = texelFetch(picture, place, 0).rgb;
    float m = lightness(own);
    float sw = lightness(texelFetch(picture, low, 0).rgb);
    float ne = lightness(texelFetch(picture, high, 0).rgb);
    float se = lightness(texelFetch(picture, ivec2(high.x, low.y), 0).rgb);
    float nw = lightness(texelFetch(picture, ivec2(low.x, high.y), 0).rgb);
    float least = min(m, min(min(nw, ne), min(sw, se)));
    float most = max(m, max(max(nw, ne), max(sw, se)));
    if (most - least < max(kLeastContrast, kContrastShare * most)) {
        smoothed = vec4(own, 1.0);
        return;
    }
    vec2 along = vec2((nw + ne) - (sw + se), (nw + sw) - (ne + se));
    float shrink = 1.0 / (min(abs(along.x), abs(along.y)) + max((nw + ne + sw + se) * 0.03, 0.008));
    along = clamp(along * shrink, -kLongest, kLongest) / vec2(size);
    vec2 uv = gl_FragCoord.xy / vec2(size);
    vec3 inner = 0.5 * (textureLod(picture, uv - along / 6.0, 0.0).rgb +
                        textureLod(picture, uv + along / 6.0, 0.0).rgb);
    vec3 outer = 0.5 * inner + 0.25 * (textureLod(picture, uv - along * 0.5, 0.0).rgb +
                                       textureLod(picture, uv + along * 0.5, 0.0).rgb);
    float outerLightness = lightness(outer);
    bool beyond = outerLightness < least || outerLightness > most;
    smoothed = vec4(beyond ? inner : outer, 1.0);
}
