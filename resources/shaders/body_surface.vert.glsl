// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A vehicle's body where it stands.

layout(location = 0) in vec3 position;  // body frame
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;

uniform mat4 eye_from_body;  // shifted by the eye, not turned: small numbers near the camera
uniform mat4 clip_from_eye;

invariant gl_Position;  // the depth is drawn first, by another program

out vec3 fromEye;  // metres, axes of the project frame
out vec3 facing;
flat out uint materialIndex;

void main() {
    vec4 shifted = eye_from_body * vec4(position, 1.0);
    fromEye = shifted.xyz;
    facing = mat3(eye_from_body) * normal;
    materialIndex = material;
    gl_Position = clip_from_eye * vec4(shifted.xyz, 1.0);
}
