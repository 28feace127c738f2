// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/GridLines.h"
#include "core/heightfield/HeightfieldBuilder.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

/// Sizes that are binary fractions (cell borders are exact) and divide 1000 m (tiles of whole
/// kilometres fit), 0.5 to 1000 m.
constexpr std::array kCellSizes{0.5,  0.625, 1.0,   1.25,  2.0,   2.5,   4.0,   5.0,
                                6.25, 8.0,   10.0,  12.5,  20.0,  25.0,  31.25, 50.0,
                                62.5, 100.0, 125.0, 200.0, 250.0, 500.0, 1000.0};

/// Cells along one axis: first line at or below `from`, last at or above `to`. Counts are double,
/// so that absurd bounds or cells cannot overflow.
struct AxisCells {
    double firstLine = 0.0;  ///< in cells from the CRS's own zero, as seen from the frame
    double count = 1.0;
};

AxisCells axisCells(double from, double to, double phase, double cellSize) {
    // A billionth of a cell forgives the division: 1.5 / 0.3 must not cost another column.
    const double first = std::floor((from + phase) / cellSize + 1e-9);
    const double last = std::ceil((to + phase) / cellSize - 1e-9);
    return {first, std::max(1.0, last - first)};
}

struct GridSize {
    AxisCells x;
    AxisCells y;
    [[nodiscard]] double cells() const { return x.count * y.count; }
};

GridSize gridSize(const CityModel& city, const Box& bounds, double cellSize) {
    const glm::dvec3& origin = city.frame.origin;
    return {axisCells(bounds.min.x, bounds.max.x, gridPhase(origin.x, cellSize), cellSize),
            axisCells(bounds.min.y, bounds.max.y, gridPhase(origin.y, cellSize), cellSize)};
}

/// The finest cell of the list whose grid stays within `maxCells`; beyond the list it doubles.
double automaticCellSize(const CityModel& city, const Box& bounds, double maxCells) {
    for (const double size : kCellSizes) {
        if (gridSize(city, bounds, size).cells() <= maxCells) {
            return size;
        }
    }
    double size = 2.0 * kCellSizes.back();
    while (gridSize(city, bounds, size).cells() > maxCells) {
        size *= 2.0;
    }
    return size;
}

Error tooManyCells(double cellSize, double cells, double limit, double sizeThatFits) {
    return {
        ErrorCode::ResourceLimit,
        fmt::format("cells of {:g} m would need {:.3g} million of them, more than {:.3g} million",
                    cellSize, cells * 1e-6, limit * 1e-6),
        "heightfield",
        fmt::format("Take cells of {:g} m or more, or leave the cell size to Reflet", sizeThatFits),
        {}};
}

}  // namespace

Result<GridSpec> gridFor(const CityModel& city, const HeightfieldSettings& settings) {
    const Box bounds = city.bounds();
    if (bounds.empty()) {
        return fail(ErrorCode::Refused,
                    "the city has no surfaces, so there is nothing to take heights from",
                    "heightfield", "Import a city model with geometry");
    }
    const glm::dvec3 size = bounds.size();
    if (!std::isfinite(size.x) || !std::isfinite(size.y)) {
        return fail(ErrorCode::Refused, "the city has coordinates that are not finite numbers",
                    "heightfield", "Repair the model's coordinates");
    }
    if (!(settings.cellSize >= 0.0) || !std::isfinite(settings.cellSize)) {
        return fail(ErrorCode::Usage, "a cell size must be a positive number of metres",
                    "heightfield", "Give a cell size such as 1, or 0 to leave it to Reflet");
    }
    // Beyond this many cells no index would fit an int, whatever the settings allow.
    const double limit = std::max(1.0, std::min(double(settings.cellLimit), 2.0e9));
    const double automatic = std::max(1.0, std::min(double(settings.maxCells), limit));
    const double cellSize =
        settings.cellSize > 0.0 ? settings.cellSize : automaticCellSize(city, bounds, automatic);
    const GridSize cells = gridSize(city, bounds, cellSize);
    if (!(cells.cells() <= limit)) {
        return tl::unexpected(
            tooManyCells(cellSize, cells.cells(), limit, automaticCellSize(city, bounds, limit)));
    }
    GridSpec grid;
    grid.cellSize = cellSize;
    grid.x0 = cells.x.firstLine * cellSize - gridPhase(city.frame.origin.x, cellSize);
    grid.y0 = cells.y.firstLine * cellSize - gridPhase(city.frame.origin.y, cellSize);
    grid.columns = int(cells.x.count);
    grid.rows = int(cells.y.count);
    return grid;
}

}  // namespace reflet
