// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "importers/cityjson/CityGeometry.h"
#include "importers/cityjson/Instances.h"
#include "importers/cityjson/ObjectTree.h"
#include "importers/cityjson/SoupTriangulation.h"

#include <vector>

namespace reflet::cityjson {

/// All that a model is put together from.
struct ModelParts {
    const CityJsonFile& file;
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

}  // namespace reflet::cityjson
