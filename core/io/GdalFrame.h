// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"

#include <ogr_spatialref.h>

#include <optional>

// Only for the .cpp files of core/io, beside GdalSession.h.
namespace reflet::gdal {

/// The frame's horizontal system, east first; nullopt for a local frame.
[[nodiscard]] Result<std::optional<OGRSpatialReference>> horizontalReference(
    const ProjectFrame& frame);

/// The same, compound where the heights' datum is known.
[[nodiscard]] Result<std::optional<OGRSpatialReference>> spatialReference(
    const ProjectFrame& frame);

}  // namespace reflet::gdal
