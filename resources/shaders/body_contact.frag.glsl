// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// The sky's light that a vehicle keeps from the ground: multiplied onto what is already there. The
// body counts as a box that hovers over its running surface; the share of the sky that it hides
// falls off with the distance from its outline.

layout(binding = 0) uniform sampler2D depth;  // of the city, reversed

uniform mat4 eye_from_body;
uniform vec3 forward;
uniform float near;
uniform vec2 halfSize;  // of the outline, metres
uniform vec2 middle;    // of the outline, body frame
uniform float reach;    // metres over which the shade fades outside the outline

in vec3 fromEye;

layout(location = 0) out vec4 kept;

const float kDeepest = 0.72;  // of the light is lost under the middle of the vehicle

void main() {
    float sceneDepth = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    vec3 place = fromEye * (near / (max(sceneDepth, 1e-9) * dot(fromEye, forward)));
    vec3 inBody = transpose(mat3(eye_from_body)) * (place - eye_from_body[3].xyz);
    vec2 beyond = abs(inBody.xy - middle) - halfSize;
    float outer = length(max(beyond, 0.0));
    float inner = min(max(beyond.x, beyond.y), 0.0);
    float shade = kDeepest * (0.5 + 0.5 * smoothstep(0.0, 0.8, -inner));
    float fade = 1.0 - smoothstep(0.0, reach, outer);
    // Only what lies about the height of the running surface: kerbs, not walls.
    float level = 1.0 - smoothstep(0.15, 0.5, abs(inBody.z));
    kept = vec4(vec3(1.0 - shade * fade * fade * level), 1.0);
}
