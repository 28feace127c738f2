// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Arcade.h"
#include "core/samples/kit/Roof.h"
#include "core/samples/kit/Window.h"

#include <array>
#include <vector>

namespace reflet::kit {

/// How one side of a house is made.
enum class Treatment {
    Arcade,  ///< arches on the ground floor, windows above
    Shops,   ///< shop fronts on the ground floor, windows above
    Plain,   ///< windows on all floors
    Party,   ///< a blind wall
    Rear,    ///< left to the procedural façade
};

struct HouseStyle {
    Paint wall = Paint::PlasterCream;
    Paint trim = Paint::Trim;
    Paint shutter = Paint::ShutterGreen;
    Paint shutterDark = Paint::ShutterGreenDark;
    double groundHeight = 4.4;
    std::vector<double> storeys{3.6, 3.4, 3.2};  ///< above the ground floor, from below
    double bay = 3.2;                            ///< wanted width of a bay
    bool grand = false;  ///< pediments, quoins, balconies on each window of the first floor
    Detail detail = Detail::Middle;
    bool awnings = true;
    bool dormers = false;
    ArcadeStyle arcade;
    RoofStyle roof;
};

/// Which treatment the south, east, north and west sides get.
using Sides = std::array<Treatment, 4>;

/// Top of the walls, where the roof begins, above the house's foot.
[[nodiscard]] double eavesHeight(const HouseStyle& style);
/// A whole house on a plot, its foot at height z.
void house(Mesh& mesh, const Plot& plot, double z, const HouseStyle& style, const Sides& sides,
           Random& random);

}  // namespace reflet::kit
