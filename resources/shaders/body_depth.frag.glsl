// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: body_surface.vert.glsl
// Leaves its depth and nothing else.

void main() {}
