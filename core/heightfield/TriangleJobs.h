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

inline TriangleCorners cornersOf(const CityModel& city, const CityTriangle& triangle) {
    return {glm::dvec3(city.vertices[triangle.vertex[0]]),
            glm::dvec3(city.vertices[triangle.vertex[1]]),
            glm::dvec3(city.vertices[triangle.vertex[2]])};
}

inline bool isFinite(const TriangleCorners& corners) {
    const glm::dvec3 zero = 0.0 * (corners[0] + corners[1] + corners[2]);
    return zero == glm::dvec3(0.0);
}

/// Hands the triangles [0, count) to raise(n, corners, rows), those that are not finite left out.
/// The rows of the grid are cut into bands, and each band is one thread's at a time: raise is
/// called for each band that a triangle touches, and writes to those rows alone without asking.
/// cornersAt(n) gives a triangle.
template <class CornersAt, class Raise>
class Rasterizer {
public:
    Rasterizer(const GridPlan& plan, const CornersAt& cornersAt, const Raise& raise,
               const JobContext& job)
        : m_plan(plan),
          m_cornersAt(cornersAt),
          m_raise(raise),
          m_job(job),
          m_rowsOfABand(std::max(kRows, plan.rows.count() / kMostBands + 1)),
          m_bands((plan.rows.count() + m_rowsOfABand - 1) / m_rowsOfABand) {}

    /// False when the job was cancelled on the way.
    bool run(std::size_t count) {
        for (std::size_t begin = 0; begin < count && !m_job.cancelled(); begin += kBatch) {
            const std::size_t end = std::min(count, begin + kBatch);
            findRows(begin, end);
            sortIntoBands();
            parallelFor(0, std::size_t(m_bands), 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t band = first; band < last; ++band)
                    raiseBand(begin, int(band));
            });
            m_job.progress(double(end) / double(count));
        }
        return !m_job.cancelled();
    }

private:
    /// Triangles between two looks at progress.
    static constexpr std::size_t kBatch = 1U << 16U;
    static constexpr std::size_t kGrain = 1024;
    static constexpr int kRows = 16;
    static constexpr int kMostBands = 512;

    void findRows(std::size_t begin, std::size_t end) {
        m_rows.resize(end - begin);
        parallelFor(begin, end, kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) {
                const TriangleCorners corners = m_cornersAt(n);
                m_rows[n - begin] =
                    isFinite(corners) ? touchedRows(m_plan, corners) : CellRange{0, 0};
            }
        });
    }

    /// Lists the triangles of the batch by the bands that they touch.
    void sortIntoBands() {
        m_first.assign(std::size_t(m_bands) + 2, 0);
        eachBand([&](std::size_t, int band) { ++m_first[std::size_t(band) + 2]; });
        for (std::size_t band = 2; band < m_first.size(); ++band)
            m_first[band] += m_first[band - 1];
        m_listed.resize(m_first.back());
        eachBand([&](std::size_t n, int band) {
            m_listed[m_first[std::size_t(band) + 1]++] = std::uint32_t(n);
        });
    }

    /// Calls use(n, band) for each triangle of the batch and each band that it touches.
    template <class Use>
    void eachBand(const Use& use) const {
        for (std::size_t n = 0; n < m_rows.size(); ++n) {
            const CellRange& rows = m_rows[n];
            for (int band = rows.first / m_rowsOfABand; band * m_rowsOfABand < rows.last; ++band)
                use(n, band);
        }
    }

    void raiseBand(std::size_t begin, int band) const {
        const CellRange own{band * m_rowsOfABand, (band + 1) * m_rowsOfABand};
        for (std::size_t k = m_first[std::size_t(band)];
             k < m_first[std::size_t(band) + 1] && !m_job.cancelled(); ++k) {
            const std::size_t n = m_listed[k];
            const CellRange rows{std::max(own.first, m_rows[n].first),
                                 std::min(own.last, m_rows[n].last)};
            m_raise(begin + n, m_cornersAt(begin + n), rows);
        }
    }

    const GridPlan& m_plan;
    const CornersAt& m_cornersAt;
    const Raise& m_raise;
    const JobContext& m_job;
    int m_rowsOfABand;
    int m_bands;
    std::vector<CellRange> m_rows;        ///< by triangle of the batch
    std::vector<std::size_t> m_first;     ///< by band, in m_listed
    std::vector<std::uint32_t> m_listed;  ///< triangles of the batch
};

}  // namespace reflet
