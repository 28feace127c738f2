// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// Positions alone, for shadow maps.

layout(location = 0) in vec3 position;

uniform mat4 clip_from_model;

void main() {
    gl_Position = clip_from_model * vec4(position, 1.0);
}
