// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// tinygltf as Reflet compiles it (TinyGltf.cpp): it parses, and touches neither files nor images.
// Its own Draco (TINYGLTF_ENABLE_DRACO) stays out: tinygltf 2.7 takes the numbers of views,
// buffers, accessors and attributes in that extension as indices without looking whether they
// exist, so that a file of 200 bytes ends the program. GltfCompression.cpp decodes Draco behind
// checks.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
