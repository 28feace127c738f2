// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/geo/Crs.h"
#include "importers/ImportTypes.h"
#include "importers/common/SourceCity.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::importers {

/// The CRS that the coordinates of a file are in.
struct SourceCrs {
    std::optional<Crs> crs;  ///< nullopt = local metres, or the frame's own
    bool swapAxes = false;   ///< the file has north before east
    CrsRule rule = CrsRule::Assumed;
};

/// What the file declares, else what the caller says, else nothing with a warning "no-crs". Refused
/// for a CRS that is unknown or geocentric, and under `strict` for none. For an inspection an
/// unknown CRS is an error among the diagnostics.
[[nodiscard]] Result<SourceCrs> sourceCrs(const std::optional<std::string>& declared,
                                          const ImportOptions& options, bool inspection,
                                          const std::string& subject,
                                          std::vector<Diagnostic>& diagnostics);

/// The order of a format's coordinates: always east before north, as the CRS's authority has it, or
/// brought into east before north by the importer already.
enum class AxisOrder { EastNorth, OfAuthority, Settled };

/// Looks at where the coordinates lie: those that are in the CRS's area of use in the other order
/// only are marked for swapping, in formats of the first kind if they are geographic; else a
/// warning offers it. Coordinates outside it in both draw a warning. `asked`: the order that the
/// user has told (ReadingOptions::axisOrder), which counts; "" = nothing.
void checkAxes(const glm::dvec3& centre, AxisOrder order, std::string_view asked, SourceCrs& crs,
               std::vector<Diagnostic>& diagnostics);

/// Coordinates of a vertex in the file's CRS and order; NaN for what is no point or beyond 10^9.
[[nodiscard]] glm::dvec3 sourceVertex(const SourceCity& file, std::size_t vertex);
[[nodiscard]] std::vector<glm::dvec3> sourceVertices(const SourceCity& file);

}  // namespace reflet::importers
