// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// What a user may say about a file of city data: how it is understood and what of it is taken.
/// Options of an import, the model of a project and importers share it.
struct ReadingOptions {
    /// CRS of a file that declares none; "" = unknown, "local" = local metres.
    std::string crs;
    /// "highest" per object, "all" (inspection only), or a value such as "2.2".
    std::string lod = "highest";
    /// CityJSON type names to load, with all objects below them; empty = all.
    std::vector<std::string> types;
    /// E0, N0, E1, N1 in the target CRS; objects that touch it are kept.
    std::optional<std::array<double, 4>> bbox;
    /// Footprints and trees: attribute with the height above the ground; "" = by the usual names.
    std::string heightField;
    /// Footprints: attribute with the elevation of the ground; "" = by the usual names.
    std::string baseField;
    /// Trees: attribute with the diameter of the crown; "" = by the usual names.
    std::string crownField;
    /// Footprints, trees and OpenStreetMap: metres of what tells no height; nullopt = 9, trees 10.
    std::optional<double> defaultHeight;
    /// OBJ and glTF: the axis that points up, "y" or "z"; "" = as the file has it, or as it seems.
    std::string upAxis;
    /// OBJ and glTF: metres of a unit; nullopt = one.
    std::optional<double> unit;
    /// 3D Tiles: the coarsest that is good enough, metres (the tiles' geometricError); nullopt = as
    /// fine as a city can hold.
    std::optional<double> geometricError;
    /// Which coordinate comes first in the file: "en" = east, "ne" = north; "" = as its format and
    /// CRS have it, or as it seems.
    std::string axisOrder;

    friend bool operator==(const ReadingOptions&, const ReadingOptions&) = default;
};

}  // namespace reflet
