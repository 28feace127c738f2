// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GdalVector.h"

#include "core/io/GdalSession.h"

#include <memory>
#include <system_error>
#include <vector>

namespace reflet::gdal {

namespace fs = std::filesystem;

bool northFirst(const OGRSpatialReference& system) {
    const bool definedSo = system.EPSGTreatsAsLatLong() || system.EPSGTreatsAsNorthingEasting();
    const std::vector<int>& mapping = system.GetDataAxisToSRSAxisMapping();
    return definedSo && mapping.size() >= 2 && mapping[0] == 1;
}

bool isGeoJson(GDALDataset& dataset) {
    const std::string name = dataset.GetDriverName();
    return name == "GeoJSON" || name == "GeoJSONSeq" || name == "TopoJSON";
}

std::string whyNot(const GdalSession& session) {
    return session.message().empty() ? "is in no form that GDAL can read"
                                     : "GDAL cannot read it: " + session.message();
}

std::string wktOf(const OGRSpatialReference& system) {
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    system.exportToWkt(&text, options);
    std::string wkt = text == nullptr ? "" : text;
    CPLFree(text);
    return wkt;
}

Result<GdalDataset> openVector(const fs::path& path, const char* const* drivers,
                               const GdalSession& session) {
    std::error_code failed;
    if (!fs::is_regular_file(path, failed))
        return fail(ErrorCode::Unreadable, "there is no such file", path.string(),
                    "Check the name.");
    // An absolute name cannot be taken for a connection or a virtual file system.
    const fs::path absolute = fs::absolute(path).lexically_normal();
    GdalDataset dataset(GDALDataset::Open(absolute.c_str(), GDAL_OF_VECTOR, drivers));
    if (!dataset)
        return fail(ErrorCode::Unreadable, whyNot(session), path.string(),
                    "GeoJSON, GeoPackage and shapefile work best.");
    return dataset;
}

}  // namespace reflet::gdal
