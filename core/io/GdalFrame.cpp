// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GdalFrame.h"

#include "core/geo/Crs.h"

#include <string>

namespace reflet::gdal {

Result<std::optional<OGRSpatialReference>> horizontalReference(const ProjectFrame& frame) {
    if (!frame.crs)
        return std::nullopt;
    const auto parsed = Crs::parse(*frame.crs);
    if (!parsed)
        return tl::unexpected(parsed.error());
    OGRSpatialReference horizontal;
    if (horizontal.importFromWkt(parsed->wkt().c_str()) != OGRERR_NONE)
        return fail(ErrorCode::Internal, "GDAL does not take PROJ's WKT", *frame.crs);
    horizontal.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return horizontal;
}

Result<std::optional<OGRSpatialReference>> spatialReference(const ProjectFrame& frame) {
    auto horizontal = horizontalReference(frame);
    if (!horizontal || !*horizontal)
        return horizontal;
    OGRSpatialReference vertical;
    if (!frame.vertical || vertical.SetFromUserInput(frame.vertical->c_str()) != OGRERR_NONE)
        return horizontal;
    const std::string name =
        std::string((*horizontal)->GetName()) + " + " + std::string(vertical.GetName());
    OGRSpatialReference compound;
    if (compound.SetCompoundCS(name.c_str(), &**horizontal, &vertical) != OGRERR_NONE)
        return horizontal;
    return compound;
}

}  // namespace reflet::gdal
