// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A box around the underside of a body: 36 vertices without attributes.

uniform mat4 eye_from_body;
uniform mat4 clip_from_eye;
uniform vec3 lower;  // of the box, body frame
uniform vec3 upper;

const int kCorner[36] = int[](0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6,
                              7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5);

out vec3 fromEye;

void main() {
    int corner = kCorner[gl_VertexID];
    vec3 place = mix(lower, upper, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    fromEye = (eye_from_body * vec4(place, 1.0)).xyz;
    gl_Position = clip_from_eye * vec4(fromEye, 1.0);
}
