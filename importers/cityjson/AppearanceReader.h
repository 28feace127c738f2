// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/cityjson/CityJsonFile.h"

namespace reflet::cityjson {

/// Reads the "appearance" of a file: materials (colours made linear), textures by reference,
/// texture coordinates and default themes.
void readAppearance(JsonValue value, SourceCity& file, const JobContext& job);

}  // namespace reflet::cityjson
