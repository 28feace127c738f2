// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/DrivableGround.h"

#include "core/heightfield/BuiltBounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace reflet {

namespace {

constexpr double kClearance = 1.5;     // metres from what stands there; strips are twice as wide
constexpr double kSteepest = 0.15;     // rise over run
constexpr double kSlopeOver = 2.0;     // metres that a slope is measured over, to both sides
constexpr float kNoObstacle = 0.3F;    // metres above the ground: kerbs, stairs' first step
constexpr float kUnderpass = 3.0F;     // metres of air that a car needs
constexpr double kAroundBuilt = 15.0;  // metres
constexpr double kNearBuilt = 40.0;    // metres; farther off there is nothing to mirror
constexpr float kBuilt = 2.5F;         // metres: higher than that is a building or a tree
constexpr double kLeastOpen = 0.25;    // share of all; less without a way out is a courtyard

using Mask = std::vector<unsigned char>;

/// Marks the cells whose centres the triangles of chosen surfaces cover in the plan.
Mask coveredBy(const GridSpec& grid, const CityModel& city,
               const std::function<bool(const CitySurface&)>& chosen) {
    Mask mask(grid.cellCount(), 0);
    for (const CityTriangle& triangle : city.triangles) {
        if (!chosen(city.surfaces[triangle.surface]))
            continue;
        const glm::dvec2 a(city.vertices[triangle.vertex[0]]);
        const glm::dvec2 b(city.vertices[triangle.vertex[1]]);
        const glm::dvec2 c(city.vertices[triangle.vertex[2]]);
        const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) {
            return u.x * v.y - u.y * v.x;
        };
        const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const int i0 = std::max(0, grid.column(low.x)), j0 = std::max(0, grid.row(low.y));
        const int i1 = std::min(grid.columns - 1, grid.column(high.x));
        const int j1 = std::min(grid.rows - 1, grid.row(high.y));
        for (int j = j0; j <= j1; ++j) {
            for (int i = i0; i <= i1; ++i) {
                const glm::dvec2 p(grid.xMin(i) + 0.5 * grid.cellSize,
                                   grid.yMin(j) + 0.5 * grid.cellSize);
                const double u = cross(b - a, p - a), v = cross(c - b, p - b),
                             w = cross(a - c, p - c);
                if ((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))
                    mask[grid.index(i, j)] = 1;
            }
        }
    }
    return mask;
}

/// Whether a vehicle has room above the ground of a cell.
bool isFree(const Heightfield& field, std::size_t cell) {
    if (isMissing(field.ground[cell]) || isMissing(field.topMax[cell]))
        return false;
    const float ground = field.ground[cell];
    if (const auto above = field.overhead(cell))
        return field.standingTop(cell) - ground <= kNoObstacle && above->low - ground >= kUnderpass;
    return field.topMax[cell] - ground <= kNoObstacle;
}

Mask freeCells(const Heightfield& field) {
    Mask mask(field.grid.cellCount(), 0);
    for (std::size_t cell = 0; cell < mask.size(); ++cell)
        mask[cell] = isFree(field, cell) ? 1 : 0;
    return mask;
}

bool isGentle(const Heightfield& field, int i, int j) {
    const GridSpec& grid = field.grid;
    const int step = std::max(1, int(std::lround(kSlopeOver / grid.cellSize)));
    const auto height = [&](int di, int dj) {
        const int ci = std::clamp(i + di, 0, grid.columns - 1);
        const int cj = std::clamp(j + dj, 0, grid.rows - 1);
        return double(field.ground[grid.index(ci, cj)]);
    };
    const double run = 2.0 * step * grid.cellSize;
    const double rise =
        std::hypot(height(step, 0) - height(-step, 0), height(0, step) - height(0, -step));
    return rise / run < kSteepest;  // not where the ground is missing
}

/// The cells of a mask that have no others within `distance` metres (to the others' middles).
Mask shrunk(const GridSpec& grid, const Mask& mask, double distance) {
    const int reach = int(std::floor(distance / grid.cellSize));
    Mask out = mask;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            if (mask[grid.index(i, j)] != 0)
                continue;
            for (int dj = -reach; dj <= reach; ++dj) {
                for (int di = -reach; di <= reach; ++di) {
                    if (std::hypot(di, dj) * grid.cellSize <= distance &&
                        grid.contains(i + di, j + dj))
                        out[grid.index(i + di, j + dj)] = 0;
                }
            }
        }
    }
    return out;
}

/// The cells within a distance of what stands high, by rings of cells around it.
Mask nearBuilt(const Heightfield& field) {
    const GridSpec& grid = field.grid;
    Mask mask(grid.cellCount(), 0);
    std::vector<std::uint32_t> ring;
    for (std::size_t cell = 0; cell < mask.size(); ++cell) {
        if (!(field.topMax[cell] - field.ground[cell] > kBuilt))
            continue;
        mask[cell] = 1;
        ring.push_back(std::uint32_t(cell));
    }
    for (int steps = int(kNearBuilt / grid.cellSize); steps > 0 && !ring.empty(); --steps) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t cell : ring) {
            const int i = int(cell % std::uint32_t(grid.columns));
            const int j = int(cell / std::uint32_t(grid.columns));
            for (int dj = -1; dj <= 1; ++dj) {
                for (int di = -1; di <= 1; ++di) {
                    if (!grid.contains(i + di, j + dj) || mask[grid.index(i + di, j + dj)] != 0)
                        continue;
                    mask[grid.index(i + di, j + dj)] = 1;
                    next.push_back(std::uint32_t(grid.index(i + di, j + dj)));
                }
            }
        }
        ring = std::move(next);
    }
    return mask;
}

/// Takes away what no way leads out of: connected parts that do not reach the border of `within`
/// and are small beside the whole.
void closeCourtyards(const GridSpec& grid, Mask& mask, const std::pair<int, int>& low,
                     const std::pair<int, int>& high) {
    const auto all = std::size_t(std::count(mask.begin(), mask.end(), 1));
    Mask seen(mask.size(), 0);
    for (std::size_t start = 0; start < mask.size(); ++start) {
        if (mask[start] == 0 || seen[start] != 0)
            continue;
        std::vector<std::size_t> part{start};
        seen[start] = 1;
        bool open = false;
        for (std::size_t k = 0; k < part.size(); ++k) {
            const int i = int(part[k] % std::size_t(grid.columns));
            const int j = int(part[k] / std::size_t(grid.columns));
            open = open || i <= low.first || j <= low.second || i >= high.first || j >= high.second;
            for (const auto& [di, dj] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                if (!grid.contains(i + di, j + dj))
                    continue;
                const std::size_t next = grid.index(i + di, j + dj);
                if (mask[next] != 0 && seen[next] == 0) {
                    seen[next] = 1;
                    part.push_back(next);
                }
            }
        }
        if (open || double(part.size()) >= kLeastOpen * double(all))
            continue;
        for (const std::size_t cell : part)
            mask[cell] = 0;
    }
}

bool isRoad(CityObjectType type) {
    return type == CityObjectType::Road || type == CityObjectType::TransportSquare;
}

Mask modelledRoads(const GridSpec& grid, const CityModel& city) {
    const auto typeOf = [&](const CitySurface& s) { return city.objects[s.object].type; };
    const bool tellsTraffic =
        std::any_of(city.surfaces.begin(), city.surfaces.end(), [&](const CitySurface& s) {
            return isRoad(typeOf(s)) && s.type == SurfaceType::TrafficArea;
        });
    return coveredBy(grid, city, [&](const CitySurface& s) {
        return isRoad(typeOf(s)) && (!tellsTraffic || s.type == SurfaceType::TrafficArea);
    });
}

Mask openGround(const Heightfield& field, const CityModel& city, const Mask& free) {
    const GridSpec& grid = field.grid;
    const Mask unfit = coveredBy(grid, city, [&](const CitySurface& s) {
        const CityObjectType type = city.objects[s.object].type;
        return type == CityObjectType::WaterBody || type == CityObjectType::PlantCover;
    });
    Mask mask(grid.cellCount(), 0);
    for (std::size_t cell = 0; cell < mask.size(); ++cell)
        mask[cell] = free[cell] != 0 && unfit[cell] == 0 ? 1 : 0;
    mask = shrunk(grid, mask, kClearance);
    const Box built = builtBounds(field);
    const auto column = [&](double x) {
        return std::clamp(grid.column(std::clamp(x, grid.x0, grid.xMax())), 0, grid.columns - 1);
    };
    const auto row = [&](double y) {
        return std::clamp(grid.row(std::clamp(y, grid.y0, grid.yMax())), 0, grid.rows - 1);
    };
    const std::pair<int, int> low{column(built.min.x - kAroundBuilt),
                                  row(built.min.y - kAroundBuilt)};
    const std::pair<int, int> high{column(built.max.x + kAroundBuilt),
                                   row(built.max.y + kAroundBuilt)};
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const bool near =
                i >= low.first && i <= high.first && j >= low.second && j <= high.second;
            if (!near || !isGentle(field, i, j))
                mask[grid.index(i, j)] = 0;
        }
    }
    closeCourtyards(grid, mask, low, high);
    const Mask worth = nearBuilt(field);
    for (std::size_t cell = 0; cell < mask.size(); ++cell)
        mask[cell] = mask[cell] != 0 && worth[cell] != 0 ? 1 : 0;
    return mask;
}

}  // namespace

DrivableGround drivableGround(const Heightfield& field, const CityModel& city) {
    DrivableGround ground;
    ground.grid = field.grid;
    const Mask free = freeCells(field);
    ground.cells = modelledRoads(field.grid, city);
    for (std::size_t cell = 0; cell < free.size(); ++cell)
        ground.cells[cell] = ground.cells[cell] != 0 && free[cell] != 0 ? 1 : 0;
    ground.count = std::size_t(std::count(ground.cells.begin(), ground.cells.end(), 1));
    ground.modelled = ground.count > 0;
    if (!ground.modelled) {
        ground.cells = openGround(field, city, free);
        ground.count = std::size_t(std::count(ground.cells.begin(), ground.cells.end(), 1));
    }
    return ground;
}

std::vector<glm::dvec3> DrivableGround::places(const Heightfield& field, double spacing) const {
    std::vector<glm::dvec3> out;
    const int step = std::max(1, int(std::ceil(spacing / grid.cellSize - 1e-9)));
    for (int j = step / 2; j < grid.rows; j += step) {
        for (int i = step / 2; i < grid.columns; i += step) {
            const std::size_t cell = grid.index(i, j);
            if (cells[cell] == 0)
                continue;
            out.emplace_back(grid.xMin(i) + 0.5 * grid.cellSize, grid.yMin(j) + 0.5 * grid.cellSize,
                             double(field.ground[cell]));
        }
    }
    return out;
}

}  // namespace reflet
