// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of reference maps in blocks: core/environment/DistanceBlocks in GLSL. Words are held by
// arrays of textures: a layer is a map, as wide as a face has blocks, the lower half of a word in r.

#include "cube_face.glsl"

// A map in blocks.
struct Blocks {
    int array;  // which texture; what that means is up to distanceTexel()
    int layer;
    int resolution;
};

// Whoever includes this says where words are. at: column, row, layer.
uvec2 distanceTexel(int array, ivec3 at);

uvec2 distanceWord(Blocks map, int index) {
    int width = (map.resolution + 3) / 4;
    return distanceTexel(map.array, ivec3(index % width, index / width, map.layer));
}

uvec2 distanceEntry(Blocks map, uint entry) {
    int width = (map.resolution + 3) / 4;
    return distanceWord(map, 3 * width * width + int(entry));  // after the table
}

// A float with 5 bits of exponent.
float smallFloat(uint bits, int mantissa) {
    return bits == 0u ? 0.0 : uintBitsToFloat((bits << (23 - mantissa)) + (107u << 23));
}

// 1/z at a place in texels from the middle of the block that a reference is in.
float inverseDepthByReference(Blocks map, uint reference, vec2 place) {
    uvec2 plane = distanceEntry(map, bitfieldExtract(reference, 10, 20));
    vec2 blocks = vec2(bitfieldExtract(int(reference), 0, 5), bitfieldExtract(int(reference), 5, 5));
    float a = smallFloat(bitfieldExtract(plane.x, 0, 22), 17);
    vec2 slopes = vec2(bitfieldExtract(int(plane.x >> 22 | plane.y << 10), 0, 20),
                       bitfieldExtract(int(plane.y), 10, 20)) / 524288.0;
    return a * (1.0 + dot(slopes, place - 4.0 * blocks));
}

// 1/z of a texel of a face, 0 or below for sky.
float inverseDepthInBlocks(Blocks map, int face, ivec2 texel) {
    int width = (map.resolution + 3) / 4;
    ivec2 at = texel / 4;
    ivec2 within = texel % 4;
    int index = (face * width + at.y) * width + at.x;
    uvec2 pair = distanceWord(map, index / 2);
    uint block = index % 2 == 0 ? pair.x : pair.y;
    vec2 place = vec2(within) - 1.5;
    switch (block & 3u) {
        case 0u: return inverseDepthByReference(map, block >> 2, place);
        case 1u: {
            uint first = block >> 12;
            uvec2 head = distanceEntry(map, first);
            uint which = bitfieldExtract(head.x, 2 * (4 * within.y + within.x), 2);
            if (which == 3u) {
                return 0.0;
            }
            uvec2 tail = distanceEntry(map, first + 1u);
            uint reference = which == 0u ? head.y : which == 1u ? tail.x : tail.y;
            return inverseDepthByReference(map, reference, place);
        }
        case 2u: {
            uvec2 row = distanceEntry(map, (block >> 12) + uint(within.y));
            uint half_ = within.x < 2 ? row.x : row.y;
            return smallFloat(bitfieldExtract(half_, 16 * (within.x % 2), 16), 11);
        }
        default: {
            vec2 slopes = vec2(bitfieldExtract(int(block), 14, 9),
                               bitfieldExtract(int(block), 23, 9)) / 384.0;
            return smallFloat(bitfieldExtract(block, 2, 12), 7) * (1.0 + dot(slopes, place));
        }
    }
}

// The distance of a texel. One beyond an edge of its face is the neighbour's.
float distanceInBlocks(Blocks map, int face, ivec2 texel) {
    vec2 st = vec2(2 * texel + 1) / float(map.resolution) - 1.0;
    if (any(greaterThan(abs(st), vec2(1.0)))) {
        const float kJustBeyond = 1.00001;
        vec3 direction = directionOnFace(face, clamp(st, -kJustBeyond, kJustBeyond));
        face = faceOf(direction, st);
        texel = clamp(ivec2((st + 1.0) * 0.5 * float(map.resolution)), ivec2(0), ivec2(map.resolution - 1));
        st = vec2(2 * texel + 1) / float(map.resolution) - 1.0;
    }
    float inverse = inverseDepthInBlocks(map, face, texel);
    return inverse > 0.0 ? length(vec3(1.0, st)) / inverse : kInfinity;
}

// The four texels around a direction, in the order of textureGather.
vec4 distancesInBlocks(Blocks map, vec3 direction) {
    const ivec2 kOrder[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));
    vec2 st;
    int face = faceOf(direction, st);
    ivec2 first = clamp(ivec2(floor((st + 1.0) * 0.5 * float(map.resolution) - 0.5)), ivec2(-1),
                        ivec2(map.resolution - 1));
    vec4 distances;
    for (int k = 0; k < 4; ++k) {
        distances[k] = distanceInBlocks(map, face, first + kOrder[k]);
    }
    return distances;
}

// The texel that holds a direction.
float nearestDistanceInBlocks(Blocks map, vec3 direction) {
    vec2 st;
    int face = faceOf(direction, st);
    ivec2 texel = ivec2((st + 1.0) * 0.5 * float(map.resolution));
    return distanceInBlocks(map, face,
                            clamp(texel, ivec2(0), ivec2(map.resolution - 1)));
}
