// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/ObjectTree.h"
#include "importers/common/SourceCity.h"

#include <string>
#include <string_view>
#include <vector>

namespace reflet::importers {

/// A level of detail to be compared: "2.2" is (2, 2), "2" is (2, 0); anything else, and none, come
/// below all of them.
struct LodRank {
    int major = -1;
    int minor = 0;
    friend auto operator<=>(const LodRank&, const LodRank&) = default;
};
[[nodiscard]] LodRank lodRank(std::string_view lod);

/// A level by its value, neither "highest" nor "all".
[[nodiscard]] bool isOneLevel(const std::string& lod);

/// The LoD of a geometry; that of an instance is its template's.
[[nodiscard]] std::uint32_t lodOf(const GeometryOutline& geometry, const SourceCity& file);

/// The level that was chosen for an object; empty when nothing was.
[[nodiscard]] std::string lodOfObject(const SourceCity& file, const std::vector<bool>& chosen,
                                      std::uint32_t object);

/// Which geometries are to be loaded, one flag for each of SourceCity::geometries.
///
/// "highest": of each object, those of the highest LoD at which it has surfaces; and nothing of an
/// object whose parts (BuildingPart and the like, at any depth) have a higher one: in 3DBAG the
/// building is an LoD 0 footprint and its parts are LoD 2.2 solids. "all": everything. A value:
/// that LoD; a whole number such as "2" stands for the highest 2.x of the object if it has no "2".
/// Points and lines are never chosen. An object and the surfaces that bound it (CityGML) are taken
/// as one.
[[nodiscard]] std::vector<bool> chooseGeometries(const SourceCity& file, const ObjectTree& tree,
                                                 const std::string& lod);

}  // namespace reflet::importers
