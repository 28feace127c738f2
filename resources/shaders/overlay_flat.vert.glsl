// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// Triangles of core/gpu/overlay/OverlayShapes.

layout(location = 0) in vec3 position;  // from the eye
layout(location = 1) in vec4 tint;
layout(location = 2) in vec4 shape;

uniform mat4 clip_from_eye;

out vec3 fromEye;
out vec4 color;
out vec2 place;
flat out int pattern;
flat out float slack;

void main() {
    fromEye = position;
    color = tint;
    place = shape.xy;
    pattern = int(shape.z);
    slack = shape.w;
    gl_Position = clip_from_eye * vec4(position, 1.0);
}
