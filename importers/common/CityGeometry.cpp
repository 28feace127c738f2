// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/CityGeometry.h"

namespace reflet::importers {

std::size_t nominalTriangles(std::size_t points, std::size_t rings) {
    const std::size_t edges = points + 2 * rings;  // points + 2 (rings - 1) - 2, without borrowing
    return edges > 4 && rings > 0 ? edges - 4 : 0;
}

}  // namespace reflet::importers
