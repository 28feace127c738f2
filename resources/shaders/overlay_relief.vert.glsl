// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// The columns of a heightfield around the eye, from its texture alone: for each cell a top and the
// walls to its western and southern neighbours, 18 vertices.

layout(binding = 1) uniform sampler2D heights;
uniform mat4 clip_from_eye;
uniform int across;       // cells along an edge
uniform int firstColumn;
uniform int firstRow;
uniform float cellSize;
uniform vec3 corner;      // of the first cell, from the eye, at height 0

out vec3 fromEye;
flat out float height;
flat out float tone;  // light on tops, darker on walls

float heightAt(ivec2 cell) {
    return texelFetch(heights, clamp(cell, ivec2(0), textureSize(heights, 0) - 1), 0).r;
}

void main() {
    int cellIndex = gl_VertexID / 18;
    int k = gl_VertexID % 18;
    ivec2 cell = ivec2(cellIndex % across, cellIndex / across);
    ivec2 place = cell + ivec2(firstColumn, firstRow);
    height = heightAt(place);
    const vec2 kCorner[6] = vec2[](vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0, 1), vec2(1, 0),
                                   vec2(1, 1));
    vec2 uv = kCorner[k % 6];
    vec3 at;
    if (k < 6) {
        at = vec3(vec2(cell) + uv, height);
        tone = 1.0;
    } else {
        bool west = k < 12;
        float other = heightAt(place - (west ? ivec2(1, 0) : ivec2(0, 1)));
        float z = uv.y < 0.5 ? min(height, other) : max(height, other);
        at = vec3(vec2(cell) + (west ? vec2(0.0, uv.x) : vec2(uv.x, 0.0)), z);
        tone = west ? 0.55 : 0.7;
        height = max(height, other);
    }
    // A missing height (NaN) takes its triangles out of the picture.
    fromEye = vec3(corner.xy + cellSize * at.xy, corner.z + at.z);
    gl_Position = isnan(at.z) ? vec4(0.0, 0.0, -1.0, 0.0) : clip_from_eye * vec4(fromEye, 1.0);
}
