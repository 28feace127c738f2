// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/geo/Crs.h"
#include "importers/ImportTypes.h"
#include "importers/common/SourceCity.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet::importers {

/// The CRS that the coordinates of a file are in.
struct SourceCrs {
    std::optional<Crs> crs;  ///< nullopt = local metres, or the frame's own
    bool swapAxes = false;   ///< the file has north before east
};

/// What the file declares, else what the caller says, else nothing with a warning "no-crs". Refused
/// for a CRS that is unknown or geocentric, and under `strict` for none. For an inspection an
/// unknown CRS is an error among the diagnostics.
[[nodiscard]] Result<SourceCrs> sourceCrs(const SourceCity& file, const ImportOptions& options,
                                          bool inspection, const std::string& subject,
                                          std::vector<Diagnostic>& diagnostics);

/// Looks at where the coordinates lie: geographic ones with the latitude first are recognised and
/// marked for swapping; coordinates outside the CRS's area of use draw a warning.
void checkAxes(const glm::dvec3& centre, SourceCrs& crs, std::vector<Diagnostic>& diagnostics);

/// Coordinates of the vertices in the file's CRS; NaN for what is no point or beyond 10^9.
[[nodiscard]] std::vector<glm::dvec3> sourceVertices(const SourceCity& file);

/// The middle of the points that are marked: of their box, or, should stray points make that huge,
/// the median of each coordinate, with a warning. The origin if there are none.
[[nodiscard]] glm::dvec3 centreOf(const std::vector<glm::dvec3>& points,
                                  const std::vector<bool>& marked, double hugeSize,
                                  std::vector<Diagnostic>& diagnostics);

}  // namespace reflet::importers
