// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// The city for a view: each triangle's number is that of its last (provoking) vertex.

layout(location = 0) in vec3 position;
layout(location = 1) in uint triangle;

uniform mat4 clip_from_eye;
uniform vec3 eye;

flat out uint triangleNumber;

void main() {
    triangleNumber = triangle;
    gl_Position = clip_from_eye * vec4(position - eye, 1.0);
}
