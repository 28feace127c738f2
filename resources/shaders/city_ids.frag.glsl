// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core

flat in uint triangleNumber;

layout(location = 0) out uint number;

void main() {
    number = triangleNumber;
}
