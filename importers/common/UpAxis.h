// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/math/Geometry.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet::importers {

/// The axes and the unit of a mesh, as a step from the file's numbers to metres east, north and up.
struct MeshAxes {
    bool yUp = false;  ///< x east, y up, -z north; else x east, y north, z up
    double unit = 1.0;

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const {
        return unit * (yUp ? glm::dvec3(p.x, -p.z, p.y) : p);
    }
};

/// As the options say, else as the box of the points seems: a city is lower than it is wide and
/// long. Tells in the diagnostics what was guessed; of coordinates in a CRS z is up.
[[nodiscard]] MeshAxes meshAxes(const Box& box, bool hasCrs, const ImportOptions& options,
                                std::vector<Diagnostic>& diagnostics);

/// The CRS in a file of the same name with the suffix .prj: its WKT. nullopt: there is none.
[[nodiscard]] std::optional<std::string> crsBeside(const std::filesystem::path& path);

}  // namespace reflet::importers
