// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <optional>
#include <string_view>

namespace reflet::importers {

/// What a name of an object, a group or a material says about what it is, in English, German,
/// Dutch or French, in whatever case: "Terrain", "BuildingWall", "Strasse_12". nullopt: nothing.
[[nodiscard]] std::optional<CityObjectType> typeByName(std::string_view name);

/// Likewise of a surface: "BuildingWall", "roof tiles".
[[nodiscard]] SurfaceType surfaceByName(std::string_view name);

}  // namespace reflet::importers
