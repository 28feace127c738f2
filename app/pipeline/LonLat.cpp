// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/LonLat.h"

#include "core/geo/Crs.h"

namespace reflet {

std::optional<std::vector<glm::dvec2>> lonLatOf(const ProjectFrame& frame,
                                                const std::vector<glm::dvec3>& places) {
    if (!frame.crs)
        return std::nullopt;
    const auto from = Crs::parse(*frame.crs);
    const auto to = Crs::parse("EPSG:4326");
    if (!from || !to)
        return std::nullopt;
    const auto transform = CrsTransform::create(*from, *to);
    std::vector<glm::dvec3> points = places;
    if (!transform || !transform->apply(points))
        return std::nullopt;
    return std::vector<glm::dvec2>(points.begin(), points.end());
}

}  // namespace reflet
