// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ImportTypes.h"
#include "importers/cityjson/CityGeometry.h"
#include "importers/cityjson/SoupTriangulation.h"
#include "importers/cityjson/SourceCrs.h"

#include <vector>

namespace reflet::cityjson {

/// What a summary is drawn from.
struct SummaryParts {
    const CityJsonFile& file;
    const CityGeometry& geometry;
    const ImportReport& report;
    const std::vector<bool>& chosen;
    const std::vector<glm::dvec3>& source;     ///< vertices in the file's CRS
    const std::vector<CityTexture>& textures;  ///< resolved
};

/// Of the file as it is written, unusable surfaces included.
[[nodiscard]] SourceSummary summaryOfFile(const SummaryParts& parts);
/// Of what is in the model: objects neither skipped nor left out, surfaces with triangles.
[[nodiscard]] SourceSummary summaryOfImport(const SummaryParts& parts,
                                            const SoupTriangles& triangles);

}  // namespace reflet::cityjson
