// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A row of a table of places.
struct TablePlace {
    std::size_t line = 0;          ///< of the file, from 1
    std::string id;                ///< empty where the row has none
    glm::dvec2 place{0.0};         ///< east and north, or longitude and latitude in degrees
    std::optional<double> height;  ///< metres
    std::string crs;               ///< "EPSG:n"; empty: the table does not say
};

struct PlaceTable {
    std::vector<TablePlace> places;
    std::vector<Diagnostic> remarks;  ///< rows that were left out, by line; the first kMostTold
    std::size_t skipped = 0;          ///< rows that were left out

    static constexpr std::size_t kMostPlaces = 100'000;
    static constexpr std::size_t kMostTold = 20;
};

/// Reads places out of a table of text (CSV) whose first row names the columns, in any order and in
/// upper or lower case, a unit in brackets behind: id or name; x and y, or east and north (also
/// German), or lon and lat; z, up or height; epsg or crs. Other columns are passed over.
///
/// Columns are apart by ';', tab or ',', whichever the first row has (in this order). With ';' and
/// tab a decimal comma is taken as well. Fields may stand in double quotes. Lines that begin with #
/// are remarks; one before the first row that names a system ("EPSG:25832") names it for all rows.
/// Longitude and latitude without a system are WGS 84.
///
/// Rows without a place, or with something else than a number in it, are left out and told.
/// Unreadable for what is no such table, with the columns that it has; ResourceLimit for more than
/// kMostPlaces rows.
[[nodiscard]] Result<PlaceTable> readPlaceTable(std::string_view text, const std::string& subject);

/// A text as a field of such a table: in quotes where it needs them (RFC 4180).
[[nodiscard]] std::string tableField(const std::string& text);

}  // namespace reflet
