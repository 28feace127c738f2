// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// One triangle that covers the screen, from three vertices without attributes.

out vec2 uv;  // 0..1 from the lower left corner

void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
