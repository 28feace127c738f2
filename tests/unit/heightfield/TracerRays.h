// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <random>

namespace reflet::test {

enum class RayKind {
    Anywhere,        ///< origin inside or outside of the grid, any direction
    Street,          ///< low origin, nearly level
    AxisParallel,    ///< one horizontal component is +0 or -0
    AlongBorder,     ///< axis-parallel on a cell border
    ThroughCorners,  ///< diagonal from a corner of cells
    FromBorder,      ///< starts on a border or a corner, any direction
    Vertical,        ///< both horizontal components are +0 or -0
    Inside,          ///< starts below the top of a column
    Grazing,         ///< level, at exactly the height of some cell
    ToTopEdge,       ///< aimed at a point on the upper edge of a column
    Leaving,         ///< starts close to the grid's rim and goes out
    Passing,         ///< starts outside
    TinyComponents,  ///< components from 1e-320 to 1e-15
    HugeComponents,  ///< components and distances of many orders of magnitude
    Count,
};

/// Rays of every kind over one field, repeatable.
class RaySource {
public:
    RaySource(const GridSpec& grid, const std::vector<float>& layer, unsigned seed)
        : m_grid(grid), m_layer(layer), m_random(seed) {}

    [[nodiscard]] Ray next(RayKind kind) {
        Ray ray{somewhere(), direction()};
        switch (kind) {
            case RayKind::Anywhere:
                ray.origin = around();
                break;
            case RayKind::Street:
                ray.direction.z *= 0.05;
                ray.origin.z = in(-1.0, 4.0);
                break;
            case RayKind::AxisParallel:
                ray.direction[in(0, 1)] = zero();
                break;
            case RayKind::AlongBorder: {
                const int axis = in(0, 1);
                ray.direction[axis] = zero();
                ray.origin[axis] = line(axis);
                break;
            }
            case RayKind::ThroughCorners: {
                ray.origin.x = line(0);
                ray.origin.y = line(1);
                const double scale = in(0, 1) == 0 ? m_grid.cellSize : in(0.1, 3.0);
                ray.direction.x = in(0, 1) == 0 ? scale : -scale;
                ray.direction.y = in(0, 1) == 0 ? scale : -scale;
                break;
            }
            case RayKind::FromBorder:
                ray.origin.x = line(0);
                if (in(0, 1) == 0)
                    ray.origin.y = line(1);
                break;
            case RayKind::Vertical:
                ray.direction = {zero(), zero(), in(0, 1) == 0 ? 1.0 : -1.0};
                break;
            case RayKind::Inside:
                ray.origin.z = height() - in(0, 3);
                break;
            case RayKind::Grazing:
                ray.origin.z = height();
                ray.direction.z = zero();
                break;
            case RayKind::ToTopEdge: {
                const glm::dvec3 target(line(0), in(0, 1) == 0 ? line(1) : somewhere().y, height());
                ray.direction = target - ray.origin;
                break;
            }
            case RayKind::Leaving:
                ray.origin.x = m_grid.xMax() - in(0.0, 1.5) * m_grid.cellSize;
                ray.direction.x = std::abs(ray.direction.x);
                break;
            case RayKind::Passing:
                ray.origin = around();
                ray.origin.x = in(0, 1) == 0 ? m_grid.x0 : m_grid.xMax();
                break;
            case RayKind::TinyComponents:
                for (int axis = 0; axis < 3; ++axis) {
                    if (in(0, 1) == 0)
                        ray.direction[axis] *= std::pow(10.0, in(-320.0, -15.0));
                }
                break;
            case RayKind::HugeComponents: {
                const double away = std::pow(10.0, in(0.0, 17.0));
                const double scale = std::pow(10.0, in(-100.0, 100.0));
                ray.origin -= away * ray.direction;
                ray.direction *= scale;
                break;
            }
            case RayKind::Count:
                break;
        }
        return ray;
    }

private:
    double in(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(m_random);
    }
    int in(int from, int to) { return std::uniform_int_distribution<int>(from, to)(m_random); }
    double zero() { return in(0, 1) == 0 ? 0.0 : -0.0; }
    double line(int axis) {
        const int k = in(0, axis == 0 ? m_grid.columns : m_grid.rows);
        return axis == 0 ? m_grid.xMin(k) : m_grid.yMin(k);
    }
    double height() {
        const float value = m_layer[std::size_t(in(0, int(m_layer.size()) - 1))];
        return isMissing(value) ? 1.0 : double(value);
    }
    glm::dvec3 direction() { return {in(-1.0, 1.0), in(-1.0, 1.0), in(-0.4, 0.4)}; }
    glm::dvec3 somewhere() {
        return {in(m_grid.x0, m_grid.xMax()), in(m_grid.y0, m_grid.yMax()), in(-2.0, 14.0)};
    }
    glm::dvec3 around() {
        const glm::dvec3 p = somewhere();
        return {p.x + in(-1.0, 1.0) * m_grid.columns * m_grid.cellSize,
                p.y + in(-1.0, 1.0) * m_grid.rows * m_grid.cellSize, p.z};
    }

    const GridSpec& m_grid;
    const std::vector<float>& m_layer;
    std::mt19937_64 m_random;
};

/// Heights of few distinct whole and half metres, so that ties are frequent; some cells missing.
inline std::vector<float> blockyLayer(const GridSpec& grid, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> layer(grid.cellCount());
    for (float& height : layer) {
        const unsigned kind = random() % 10;
        height = kind == 0 ? kMissingHeight : kind < 7 ? 0.0F : 0.5F * float(random() % 20);
    }
    return layer;
}

}  // namespace reflet::test
