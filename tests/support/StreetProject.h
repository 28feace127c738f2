// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Import.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <filesystem>

namespace reflet::test {

/// Imports a StreetCity with a car on its road, files and all, into the folder as `file`.
inline Result<ImportReport> importStreetWithCar(const TemporaryFolder& folder,
                                                const std::filesystem::path& file,
                                                StreetCity street = StreetCity()) {
    ImportRequest request;
    request.files = {folder.write("street.city.json", street.cityJson())};
    request.routes = folder.write("route.geojson", street.routeGeoJson());
    request.vehicle = "car";
    request.output = file;
    return importProject(request, {});
}

}  // namespace reflet::test
