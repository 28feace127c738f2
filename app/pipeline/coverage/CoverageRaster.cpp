// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageFiles.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kRouteCell = 1.0;  // metres

/// Cells over a box, their borders at multiples of their size.
GridSpec gridOver(const Box& box, double cell) {
    GridSpec grid;
    grid.cellSize = cell;
    grid.x0 = std::floor(box.min.x / cell) * cell;
    grid.y0 = std::floor(box.min.y / cell) * cell;
    grid.columns = int(std::floor((box.max.x - grid.x0) / cell)) + 1;
    grid.rows = int(std::floor((box.max.y - grid.y0) / cell)) + 1;
    return grid;
}

CoverageRaster emptyOver(const Box& box, double cell) {
    CoverageRaster raster;
    raster.grid = gridOver(box, cell);
    raster.coverage.assign(raster.grid.cellCount(), kMissingHeight);
    raster.seen = raster.coverage;
    return raster;
}

/// The least multiple of kGroundCell whose cells hold a few samples each on average.
double groundCell(const CoverageReport& report) {
    constexpr double kSamples = 8.0;
    const DemandGround& ground = *report.plan.ground;
    const double area = double(ground.places.size()) * ground.cellSize * ground.cellSize;
    const double edge = std::sqrt(kSamples * area / double(report.demand.samples.size()));
    return CoverageRaster::kGroundCell *
           std::max(1.0, std::ceil(edge / CoverageRaster::kGroundCell));
}

CoverageRaster ofGround(const CoverageReport& report) {
    Box box;
    for (const DemandSample& sample : report.demand.samples)
        box.add(sample.vehicle);
    CoverageRaster raster = emptyOver(box, groundCell(report));
    std::vector<std::uint32_t> counts(raster.grid.cellCount(), 0);
    std::fill(raster.coverage.begin(), raster.coverage.end(), 0.0F);
    std::fill(raster.seen.begin(), raster.seen.end(), 0.0F);
    for (std::size_t k = 0; k < report.demand.samples.size(); ++k) {
        const glm::dvec3& at = report.demand.samples[k].vehicle;
        const std::size_t cell = raster.grid.index(raster.grid.column(at.x), raster.grid.row(at.y));
        ++counts[cell];
        raster.coverage[cell] += report.samples.best[k];
        raster.seen[cell] += report.samples.seenBy[k] > 0 ? 1.0F : 0.0F;
    }
    for (std::size_t cell = 0; cell < counts.size(); ++cell) {
        // 0 / 0 is NaN: no data.
        raster.coverage[cell] /= float(counts[cell]);
        raster.seen[cell] /= float(counts[cell]);
    }
    return raster;
}

/// Paints a stretch: the worse of what is there and what it says.
void paint(CoverageRaster& raster, const Route& route, const CoveredStretch& stretch) {
    const double half = 0.5 * CoverageRaster::kLaneWidth;
    const double step = 0.5 * raster.grid.cellSize;
    for (double station = stretch.from; station <= stretch.to; station += step) {
        const glm::dvec3 middle = route.at(station);
        const glm::dvec3 along = route.tangent(station);
        for (double aside = -half; aside <= half; aside += step) {
            const int i = raster.grid.column(middle.x - aside * along.y);
            const int j = raster.grid.row(middle.y + aside * along.x);
            if (!raster.grid.contains(i, j))
                continue;
            const std::size_t cell = raster.grid.index(i, j);
            if (!(raster.coverage[cell] <= float(stretch.coverage))) {
                raster.coverage[cell] = float(stretch.coverage);
                raster.seen[cell] = float(stretch.seen);
            }
        }
    }
}

CoverageRaster ofRoutes(const CoverageReport& report) {
    Box box;
    for (const DemandLine& line : report.plan.lines)
        for (const glm::dvec3& point : line.route->points()) {
            box.add(point - glm::dvec3(CoverageRaster::kLaneWidth));
            box.add(point + glm::dvec3(CoverageRaster::kLaneWidth));
        }
    CoverageRaster raster = emptyOver(box, kRouteCell);
    for (const CoveredStretch& stretch : report.stretches)
        if (stretch.samples > 0)
            paint(raster, *report.plan.lines[stretch.line].route, stretch);
    return raster;
}

}  // namespace

CoverageRaster coverageRaster(const CoverageReport& report) {
    if (report.demand.samples.empty())
        return {};
    return report.plan.ground ? ofGround(report) : ofRoutes(report);
}

}  // namespace reflet
