// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/CityGeometry.h"
#include "importers/common/Extent.h"
#include "importers/common/ImportReport.h"
#include "importers/common/ObjectTree.h"
#include "importers/common/SourceCity.h"

#include <vector>

namespace reflet::importers {

/// Objects of a file that are read together, with all that belongs to them: parents beside their
/// children. A small file is one piece; a large one comes in many, so that only the model grows.
struct CityPiece {
    SourceCity file;
    ImportReport report{0};
    ObjectTree tree;
    std::vector<bool> chosen;  ///< which of file.geometries are to be read into `geometry`
    CityGeometry geometry;
};

/// Appends a part of the same file to a piece: indices are moved on. The piece's CRS and transform
/// stay. A part without geometry of templates uses those of the piece.
void append(CityPiece& piece, CityPiece part);

/// Where the points that its surfaces and instances use lie, in the file's CRS and order.
void addTo(Extent& extent, const CityPiece& piece);

/// What is wrong with a template is wrong with every object that shows it.
void noteTemplates(const CityGeometry& geometry, ImportReport& report);

}  // namespace reflet::importers
