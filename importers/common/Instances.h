// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/CityGeometry.h"
#include "importers/common/ImportReport.h"
#include "importers/common/Placement.h"
#include "importers/common/SoupTriangulation.h"

#include <string>
#include <vector>

namespace reflet::importers {

/// A template ready to be placed: its triangles with vertices numbered from 0.
struct TemplateMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> surfaces;       ///< of each triangle: index into the templates' soup
    std::vector<std::array<glm::vec2, 3>> uv;  ///< empty, or one for each triangle
    std::size_t nominalTriangles = 0;
};

[[nodiscard]] std::vector<TemplateMesh> templateMeshes(const SourceCity& file,
                                                       const CityGeometry& geometry,
                                                       const SoupTriangles& triangles);

/// An instance in the project frame.
struct PlacedInstance {
    std::uint32_t object = 0;
    std::uint32_t templateIndex = 0;
    bool mirrored = false;  ///< front faces have to be turned around
    std::vector<glm::dvec3> points;
};

/// Places one instance: matrix (row-major, columns multiply) times template point, divided by w,
/// plus the anchor. nullopt, and a note in the report: it cannot be placed.
[[nodiscard]] Result<std::optional<PlacedInstance>> placeInstance(
    const InstanceRecord& instance, const TemplateMesh& mesh, const Placement& placement,
    const glm::dvec3& sourceAnchor, const glm::dvec3& localAnchor, ImportReport& report);

/// ResourceLimit when the instances of objects that are not left out have too many triangles:
/// a few kilobytes can ask for billions. `total` counts them over all pieces of a file.
[[nodiscard]] Result<void> checkInstanceLimit(const std::vector<InstanceRecord>& instances,
                                              const std::vector<TemplateMesh>& meshes,
                                              const std::vector<bool>& leftOut,
                                              std::size_t fileBytes, const std::string& subject,
                                              std::size_t& total);

}  // namespace reflet::importers
