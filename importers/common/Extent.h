// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/math/Geometry.h"

#include <cstddef>
#include <vector>

namespace reflet::importers {

/// Where the points of a file lie, gathered one by one in bounded memory.
class Extent {
public:
    void add(const glm::dvec3& point);  ///< NaN is passed over
    void swapAxes();                    ///< exchanges x and y
    /// The middle of the points' box; the origin if there are none.
    [[nodiscard]] glm::dvec3 middle() const;
    /// The same, or, should stray points make the box larger than `hugeSize`, the median of each
    /// coordinate (of 60,000 points or more that are spread over all), with a warning.
    [[nodiscard]] glm::dvec3 centre(double hugeSize, std::vector<Diagnostic>& diagnostics) const;

private:
    Box m_box;
    std::vector<glm::dvec3> m_sample;  ///< every m_stride-th point
    std::size_t m_count = 0;
    std::size_t m_stride = 1;
};

}  // namespace reflet::importers
