// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A square that faces the eye, around a ball and its mark: six vertices without attributes.

uniform mat4 clip_from_eye;
uniform vec3 center;  // from the eye
uniform float radius;
uniform vec3 right;
uniform vec3 up;

out vec2 place;  // in radii of the ball

const float kReach = 1.9;

void main() {
    const vec2 kCorner[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1),
                                   vec2(1, 1));
    place = kReach * kCorner[gl_VertexID];
    vec3 fromEye = center + radius * (place.x * right + place.y * up);
    gl_Position = clip_from_eye * vec4(fromEye, 1.0);
}
