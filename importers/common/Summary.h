// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ImportTypes.h"
#include "importers/common/CityGeometry.h"
#include "importers/common/ImportReport.h"
#include "importers/common/SoupTriangulation.h"
#include "importers/common/SourceCrs.h"

#include <vector>

namespace reflet::importers {

/// What a summary is drawn from.
struct SummaryParts {
    const SourceCity& file;
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

}  // namespace reflet::importers
