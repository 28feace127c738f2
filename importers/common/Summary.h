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
    const std::vector<glm::dvec3>& source;  ///< vertices in the file's CRS: east, north, up
};

/// Of one piece of a file; its CRS and the textures are left to be filled in.
struct PieceSummary {
    SourceSummary counts;
    std::vector<bool> usedTextures;  ///< one for each of the piece
};

/// Of the file as it is written, unusable surfaces included.
[[nodiscard]] PieceSummary summaryOfFile(const SummaryParts& parts);
/// Of what is in the model: objects neither skipped nor left out, surfaces with triangles.
[[nodiscard]] PieceSummary summaryOfImport(const SummaryParts& parts,
                                           const SoupTriangles& triangles);

/// Adds the counts of another piece.
void addSummary(SourceSummary& sum, const SourceSummary& piece);

}  // namespace reflet::importers
