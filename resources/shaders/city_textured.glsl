// SPDX-License-Identifier: GPL-3.0-or-later
// Images of surfaces from the pages of core/gpu/city/TexturePages.h, filtered as MipTexture does.

layout(binding = 6) uniform sampler2DArray pages;

const int kMaxTaps = 8;

/// Texels from level 0 of an image to another of its levels (TexturePages::levelOffset).
ivec2 levelOffset(ivec2 size, int level) {
    ivec2 at = level == 0 ? ivec2(0) : ivec2(size.x + 2, 0);
    for (int l = 1; l < level; ++l)
        at.y += max(size.y >> l, 1) + 2;
    return at;
}

/// Linear colour and alpha of one level, bilinear; at: in [0, 1]², rows from the top.
vec4 levelTexel(uvec4 place, ivec2 size, int level, vec2 at) {
    vec2 origin = vec2(ivec2(place.xy) + levelOffset(size, level));
    vec2 extent = vec2(max(size >> level, ivec2(1)));
    vec2 edge = vec2(textureSize(pages, 0).xy);
    return textureLod(pages, vec3((origin + at * extent) / edge, float(place.z & 0xffffu)), 0.0);
}

/// The mean over the parallelogram that two axes span around uv (v up); place: of the texture.
vec4 sampleImage(uvec4 place, vec2 uv, vec2 axisA, vec2 axisB) {
    ivec2 size = ivec2(place.w & 0xffffu, place.w >> 16);
    int top = int(place.z >> 16 & 0x7fffu) - 1;
    bool repeat = (place.z >> 31) != 0u;
    float lengthA = length(axisA * vec2(size));
    float lengthB = length(axisB * vec2(size));
    float longer = max(lengthA, lengthB);
    vec2 along = lengthA >= lengthB ? axisA : axisB;
    float shorter = max(max(min(lengthA, lengthB), longer / float(kMaxTaps)), 1.0);
    float lod = clamp(log2(shorter), 0.0, float(top));
    int taps = clamp(int(ceil(longer / shorter)), 1, kMaxTaps);
    int level = int(lod);
    int next = min(level + 1, top);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < taps; ++i) {
        vec2 at = uv + along * ((float(i) + 0.5) / float(taps) - 0.5);
        at = repeat ? at - floor(at) : clamp(at, 0.0, 1.0);
        at.y = 1.0 - at.y;
        sum += mix(levelTexel(place, size, level, at), levelTexel(place, size, next, at),
                   lod - float(level));
    }
    return sum / float(taps);
}
