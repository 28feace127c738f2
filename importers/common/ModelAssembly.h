// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "importers/common/CityGeometry.h"
#include "importers/common/Instances.h"
#include "importers/common/ObjectTree.h"
#include "importers/common/SoupTriangulation.h"

#include <vector>

namespace reflet::importers {

/// All that a model is put together from.
struct ModelParts {
    const SourceCity& file;
    const ObjectTree& tree;
    const ImportReport& report;
    const CityGeometry& geometry;
    const std::vector<bool>& chosen;
    const std::vector<glm::dvec3>& local;
    const SoupTriangles& triangles;
    const std::vector<TemplateMesh>& meshes;
    const std::vector<PlacedInstance>& instances;
};

/// The model of all objects that were neither skipped nor left out. Vertices are those in use, in
/// the order of the file, then points where edges cross, then instances.
[[nodiscard]] CityModel assembleModel(const ModelParts& parts);

}  // namespace reflet::importers
