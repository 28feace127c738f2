// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ImportTypes.h"
#include "importers/common/CityGeometry.h"
#include "importers/common/LodChoice.h"
#include "importers/common/ObjectTree.h"

#include <array>
#include <string>
#include <vector>

namespace reflet::importers {

/// Notes what is odd about the objects themselves, geometry apart.
void noteOddObjects(const SourceCity& file, ImportReport& report);

/// Which geometries the caller asks for, by type and level of detail. Objects of other types are
/// left out of the report.
[[nodiscard]] std::vector<bool> selectGeometries(const SourceCity& file, const ObjectTree& tree,
                                                 const ImportOptions& options, ImportReport& report,
                                                 Tallies& tallies);

/// Leaves out what has nothing to show at the level of detail and in the box (in the frame) that
/// the caller asks for, unless something below it has.
void leaveOutUnwanted(const SourceCity& file, const ObjectTree& tree, const CityGeometry& geometry,
                      const std::vector<bool>& chosen, const std::vector<glm::dvec3>& local,
                      const glm::dvec3& origin, const ImportOptions& options, ImportReport& report,
                      Tallies& tallies);

/// Skips the objects that have geometry, but none that could be used. What a surface of an object
/// shows, the object shows.
void skipWhatShowsNothing(const SourceCity& file, const ObjectTree& tree,
                          const std::vector<bool>& chosen, const std::vector<bool>& showsSomething,
                          ImportReport& report);

}  // namespace reflet::importers
