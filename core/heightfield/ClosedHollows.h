// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

namespace reflet {

/// Fills the hollows that no air reaches from the open: houses whose roofs are bodies of their own
/// on nothing but walls, attics, girders. Air goes from cell to cell, over more than half the
/// clearance in height, as the conservative columns let it. At a cell's centre, a hollow that a
/// wall cuts off over the cell goes with the hollows beside it. `open`: cells that stay as they
/// are (tunnels), ascending. Internal to core/heightfield.
void fillClosedHollows(Heightfield& field, double clearance,
                       const std::vector<std::uint32_t>& open);

}  // namespace reflet
