// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: body_surface.vert.glsl
// Panes leave their depth and nothing else.

void main() {}
