// SPDX-License-Identifier: GPL-3.0-or-later
// The one place where tinygltf is compiled; Debian's shared library would open files by itself.
#include <fstream>  // of its writer

#define TINYGLTF_IMPLEMENTATION
#include "importers/gltf/TinyGltf.h"
