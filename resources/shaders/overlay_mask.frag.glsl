// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: body_surface.vert.glsl
// Where a body is.

layout(location = 0) out float covered;

void main() {
    covered = 1.0;
}
