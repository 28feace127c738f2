// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A box along the axes of the sun's shadow maps: 36 vertices without attributes.

uniform mat4 clip_from_eye;
uniform mat3 axes;   // right, up and towards the sun
uniform vec3 lower;  // of the box along the axes, relative to the eye
uniform vec3 upper;

const int kCorner[36] = int[](0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6,
                              7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5);

out vec3 fromEye;

void main() {
    int corner = kCorner[gl_VertexID];
    fromEye = axes * mix(lower, upper, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    gl_Position = clip_from_eye * vec4(fromEye, 1.0);
}
