// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/base/ParallelFor.h"
#include "core/city/CityModel.h"
#include "core/heightfield/TriangleRaster.h"

#include <algorithm>
#include <vector>

// How the triangles of a city are shared out among threads. Internal to core/heightfield.

namespace reflet {

/// Triangles between two looks at progress; pieces of them between two looks at the stop token.
inline constexpr std::size_t kBatch = 1U << 16U;
inline constexpr std::size_t kGrain = 128;
inline constexpr std::size_t kRowGrain = 4;
/// A triangle over more cells than this is shared out by rows.
inline constexpr double kManyCells = 65536.0;

inline TriangleCorners cornersOf(const CityModel& city, const CityTriangle& triangle) {
    return {glm::dvec3(city.vertices[triangle.vertex[0]]),
            glm::dvec3(city.vertices[triangle.vertex[1]]),
            glm::dvec3(city.vertices[triangle.vertex[2]])};
}

inline bool isFinite(const TriangleCorners& corners) {
    const glm::dvec3 zero = 0.0 * (corners[0] + corners[1] + corners[2]);
    return zero == glm::dvec3(0.0);
}

inline double cellsUnder(const GridPlan& plan, const TriangleCorners& corners, CellRange rows) {
    const auto [low, high] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const CellRange columns = touchedCells(plan.columns, low, high);
    return double(rows.last - rows.first) * double(columns.last - columns.first);
}

/// Hands the triangles [0, count) to raise(n, corners, rows): most of them in parallel with one
/// another, large ones one by one with their rows in parallel. cornersAt(n) gives a triangle.
template <class CornersAt, class Raise>
class Rasterizer {
public:
    Rasterizer(const GridPlan& plan, const CornersAt& cornersAt, const Raise& raise,
               const JobContext& job)
        : m_plan(plan), m_cornersAt(cornersAt), m_raise(raise), m_job(job) {}

    /// False when the job was cancelled on the way.
    bool run(std::size_t count) {
        for (std::size_t begin = 0; begin < count && !m_job.cancelled(); begin += kBatch) {
            const std::size_t end = std::min(count, begin + kBatch);
            const std::vector<char> large = raiseSmall(begin, end);
            for (std::size_t n = begin; n < end && !m_job.cancelled(); ++n) {
                if (large[n - begin] != 0) {
                    raiseLarge(n);
                }
            }
            m_job.progress(double(end) / double(count));
        }
        return !m_job.cancelled();
    }

private:
    /// Says for each triangle of [begin, end) whether it was too large and is left to do.
    std::vector<char> raiseSmall(std::size_t begin, std::size_t end) {
        std::vector<char> large(end - begin, 0);
        parallelFor(begin, end, kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last && !m_job.cancelled(); ++n) {
                const TriangleCorners corners = m_cornersAt(n);
                if (!isFinite(corners)) {
                    continue;
                }
                const CellRange rows = touchedRows(m_plan, corners);
                if (cellsUnder(m_plan, corners, rows) > kManyCells) {
                    large[n - begin] = 1;
                } else {
                    m_raise(n, corners, rows);
                }
            }
        });
        return large;
    }

    void raiseLarge(std::size_t n) {
        const TriangleCorners corners = m_cornersAt(n);
        const CellRange rows = touchedRows(m_plan, corners);
        parallelFor(std::size_t(rows.first), std::size_t(rows.last), kRowGrain,
                    [&](std::size_t first, std::size_t last) {
                        if (!m_job.cancelled()) {
                            m_raise(n, corners, {int(first), int(last)});
                        }
                    });
    }

    const GridPlan& m_plan;
    const CornersAt& m_cornersAt;
    const Raise& m_raise;
    const JobContext& m_job;
};

}  // namespace reflet
