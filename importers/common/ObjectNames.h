// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "importers/common/SourceCity.h"

#include <string_view>

namespace reflet::importers {

/// What the "type" of a city object means. Extensions ("+X") and unknown names are Other, with the
/// exception of those that CityJSON 2.0 moved into an extension ("+GenericCityObject").
[[nodiscard]] CityObjectType cityObjectType(std::string_view name);
/// A name that CityJSON 1.0, 1.1 or 2.0 defines, or an extension.
[[nodiscard]] bool isKnownCityObjectType(std::string_view name);
/// BuildingPart, BridgePart, TunnelPart: what together makes up its parent.
[[nodiscard]] bool isPart(std::string_view typeName);
[[nodiscard]] SurfaceType surfaceType(std::string_view name);
[[nodiscard]] GeometryType geometryType(std::string_view name);

}  // namespace reflet::importers
