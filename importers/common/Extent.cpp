// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Extent.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet::importers {

void Extent::add(const glm::dvec3& point) {
    constexpr std::size_t kLargestSample = 120'000;
    if (std::isnan(point.x + point.y + point.z))
        return;
    m_box.add(point);
    if (m_count++ % m_stride != 0)
        return;
    m_sample.push_back(point);
    if (m_sample.size() < kLargestSample)
        return;
    for (std::size_t i = 0; 2 * i < m_sample.size(); ++i)
        m_sample[i] = m_sample[2 * i];
    m_sample.resize((m_sample.size() + 1) / 2);
    m_stride *= 2;
}

void Extent::swapAxes() {
    for (glm::dvec3& point : m_sample)
        std::swap(point.x, point.y);
    if (m_count > 0) {
        std::swap(m_box.min.x, m_box.min.y);
        std::swap(m_box.max.x, m_box.max.y);
    }
}

glm::dvec3 Extent::middle() const {
    return m_count == 0 ? glm::dvec3(0.0) : m_box.center();
}

glm::dvec3 Extent::centre(double hugeSize, std::vector<Diagnostic>& diagnostics) const {
    if (m_count == 0)
        return middle();
    const glm::dvec3 size = m_box.size();
    if (size.x <= hugeSize && size.y <= hugeSize)
        return middle();
    diagnostics.push_back(
        {Severity::Warning, "far-apart", "",
         fmt::format("the objects spread over {:.0f} by {:.0f} units", size.x, size.y),
         "Check for stray objects, or import a part with --bbox."});
    glm::dvec3 median(0.0);
    std::vector<double> values(m_sample.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(m_sample.begin(), m_sample.end(), values.begin(),
                       [&](const glm::dvec3& p) { return p[axis]; });
        const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), half, values.end());
        median[axis] = *half;
    }
    return median;
}

}  // namespace reflet::importers
