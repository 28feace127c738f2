// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core

void main() {}
