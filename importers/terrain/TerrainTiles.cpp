// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/TerrainTiles.h"

#include "importers/terrain/GridTriangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace reflet::terrain {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
/// Heights beyond are leftovers of an undeclared no-data value, as is -9999 itself.
constexpr float kFarthestHeight = 12'000.0F;
constexpr float kUsualNoData = -9999.0F;

/// A column or row of `tile` in the grid of `base`, if it falls on a whole one.
std::optional<int> offsetOf(double from, double to, double size) {
    const double offset = (to - from) / size;
    const double whole = std::round(offset);
    constexpr double kTolerance = 0.01;  // of a pixel
    constexpr double kFarthest = 1e6;
    if (!(std::abs(offset - whole) < kTolerance) || !(std::abs(whole) < kFarthest))
        return std::nullopt;
    return int(whole);
}

bool sameSize(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::abs(a);
}

/// Puts the tile into the mosaic's grid; false when it does not fit.
bool fits(const Mosaic& mosaic, TerrainTile& tile) {
    const RasterInfo& base = mosaic.tiles.front().info;
    const std::array<double, 6>& p = base.transform;
    const std::array<double, 6>& q = tile.info.transform;
    const bool straight = p[2] == 0.0 && p[4] == 0.0 && q[2] == 0.0 && q[4] == 0.0;
    if (!straight || !base.placed || !tile.info.placed || !sameSize(p[1], q[1]) ||
        !sameSize(p[5], q[5]) || base.crs != tile.info.crs ||
        base.heightUnit != tile.info.heightUnit)
        return false;
    const auto column = offsetOf(p[0], q[0], p[1]);
    const auto row = offsetOf(p[3], q[3], p[5]);
    if (!column || !row)
        return false;
    tile.column = *column;
    tile.row = *row;
    return true;
}

/// Makes the mosaic as large as its tiles.
void settleSize(Mosaic& mosaic) {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
    for (const TerrainTile& tile : mosaic.tiles) {
        left = std::min(left, tile.column);
        top = std::min(top, tile.row);
        right = std::max(right, tile.column + tile.info.columns);
        bottom = std::max(bottom, tile.row + tile.info.rows);
    }
    mosaic.info = mosaic.tiles.front().info;
    const glm::dvec2 corner = mosaic.info.at(left, top);
    mosaic.info.transform[0] = corner.x;
    mosaic.info.transform[3] = corner.y;
    mosaic.info.columns = right - left;
    mosaic.info.rows = bottom - top;
    for (TerrainTile& tile : mosaic.tiles) {
        tile.column -= left;
        tile.row -= top;
    }
}

/// Reads rows of a mosaic in ascending order; a tile is open only while its rows are read.
class RowReader {
public:
    RowReader(const Mosaic& mosaic, const PixelWindow& window)
        : m_mosaic(mosaic), m_window(window), m_files(mosaic.tiles.size()) {}

    /// Row of the window, in metres.
    Result<void> read(int row, std::vector<float>& heights) {
        heights.assign(std::size_t(m_window.columns), kNaN);
        for (std::size_t k = 0; k < m_files.size(); ++k)
            if (auto done = readFrom(k, m_window.firstRow + row, heights); !done)
                return done;
        for (float& z : heights) {
            if (std::isnan(z))
                continue;
            if (std::abs(z) > kFarthestHeight / float(m_mosaic.unit) || z == kUsualNoData) {
                z = kNaN;
                ++m_outOfRange;
            } else if (m_mosaic.unit != 1.0) {
                z = float(double(z) * m_mosaic.unit);
            }
        }
        return {};
    }
    [[nodiscard]] std::size_t outOfRange() const { return m_outOfRange; }

private:
    Result<void> readFrom(std::size_t k, int row, std::vector<float>& heights) {
        const TerrainTile& tile = m_mosaic.tiles[k];
        const int first = std::max(tile.column, m_window.firstColumn);
        const int last =
            std::min(tile.column + tile.info.columns, m_window.firstColumn + m_window.columns);
        if (row >= tile.row + tile.info.rows)
            m_files[k].reset();
        if (row < tile.row || row >= tile.row + tile.info.rows || first >= last)
            return {};
        if (!m_files[k]) {
            auto opened = tile.open();
            if (!opened)
                return tl::unexpected(opened.error());
            m_files[k] = std::make_unique<RasterFile>(std::move(*opened));
        }
        m_row.resize(std::size_t(last - first));
        if (auto done = m_files[k]->readHeights(first - tile.column, row - tile.row, last - first,
                                                1, m_row.data());
            !done)
            return done;
        float* const to = heights.data() + (first - m_window.firstColumn);
        for (std::size_t i = 0; i < m_row.size(); ++i)
            if (std::isnan(to[i]))
                to[i] = m_row[i];
        return {};
    }

    const Mosaic& m_mosaic;
    PixelWindow m_window;
    std::vector<std::unique_ptr<RasterFile>> m_files;
    std::vector<float> m_row;
    std::size_t m_outOfRange = 0;
};

/// How far the posts of `fine`, between two rows of the grid, lie from its finest triangles.
double omittedError(const HeightGrid& grid, const std::vector<float>& fine, int step, int row,
                    int within) {
    double largest = 0.0;
    const double v = double(within) / step;
    for (int i = 0; i + 1 < grid.columns; ++i) {
        const std::array<double, 4> corners{grid.at(i, row), grid.at(i + 1, row),
                                            grid.at(i, row + 1), grid.at(i + 1, row + 1)};
        for (int k = 0; k < step; ++k) {
            const double z = fine[std::size_t(i * step + k)];
            const double surface = finestHeight(corners, i, row, double(k) / step, v);
            if (!std::isnan(z) && !std::isnan(surface))
                largest = std::max(largest, std::abs(z - surface));
        }
    }
    return largest;
}

int stepFor(const PixelWindow& window, std::size_t most) {
    int step = 1;
    while (std::size_t((window.columns - 1) / step + 1) *
               std::size_t((window.rows - 1) / step + 1) >
           most)
        ++step;
    return step;
}

}  // namespace

Result<RasterFile> TerrainTile::open() const {
    return bytes.empty() ? RasterFile::open(file) : RasterFile::openBytes(bytes, file);
}

std::vector<Mosaic> groupTiles(std::vector<TerrainTile> tiles) {
    std::vector<Mosaic> mosaics;
    for (TerrainTile& tile : tiles) {
        const auto home = std::find_if(mosaics.begin(), mosaics.end(),
                                       [&](const Mosaic& mosaic) { return fits(mosaic, tile); });
        if (home != mosaics.end()) {
            home->tiles.push_back(std::move(tile));
        } else {
            mosaics.emplace_back();
            mosaics.back().tiles.push_back(std::move(tile));
        }
    }
    for (Mosaic& mosaic : mosaics)
        settleSize(mosaic);
    return mosaics;
}

double heightUnitOf(const Crs& crs) {
    constexpr double kUsSurveyFoot = 1200.0 / 3937.0;
    constexpr double kFoot = 0.3048;
    if (const auto& vertical = crs.vertical())
        return *vertical == "EPSG:6360" ? kUsSurveyFoot : (*vertical == "EPSG:8228" ? kFoot : 1.0);
    return crs.isProjected() ? crs.metresPerUnit() : 1.0;
}

Result<MosaicHeights> readWindow(const Mosaic& mosaic, const PixelWindow& window,
                                 const ReadLimits& limits, const JobContext& job) {
    MosaicHeights out;
    out.window = window;
    out.step = stepFor(window, limits.mostPosts);
    const int step = out.step;
    HeightGrid& grid = out.grid;
    grid.columns = (window.columns - 1) / step + 1;
    grid.rows = (window.rows - 1) / step + 1;
    grid.heights.resize(std::size_t(grid.columns) * std::size_t(grid.rows));
    const bool all = std::size_t(window.columns) * std::size_t(window.rows) <= limits.mostLookedAt;
    if (!all)
        out.omittedError = kNaN;

    RowReader reader(mosaic, window);
    std::vector<std::vector<float>> between;
    between.resize(std::size_t(step));
    for (int row = 0; row <= (grid.rows - 1) * step; row += (all ? 1 : step)) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        job.progress(double(row) / window.rows);
        const int within = row % step;
        std::vector<float>& fine = between[std::size_t(within)];
        std::vector<float> line;
        if (auto done = reader.read(row, line); !done)
            return tl::unexpected(done.error());
        const int j = row / step;
        if (within == 0) {
            for (int i = 0; i < grid.columns; ++i)
                grid.heights[std::size_t(j) * std::size_t(grid.columns) + std::size_t(i)] =
                    line[std::size_t(i * step)];
            for (int k = 0; all && j > 0 && step > 1 && k < step; ++k)
                out.omittedError = std::max(
                    out.omittedError, omittedError(grid, between[std::size_t(k)], step, j - 1, k));
        }
        fine = std::move(line);
    }
    out.outOfRange = reader.outOfRange();
    out.missing = std::size_t(std::count_if(grid.heights.begin(), grid.heights.end(),
                                            [](float z) { return std::isnan(z); }));
    return out;
}

Result<HeightStatistics> statisticsOf(const TerrainTile& tile, const JobContext& job) {
    const auto file = tile.open();
    if (!file)
        return tl::unexpected(file.error());
    HeightStatistics out;
    out.lowest = std::numeric_limits<double>::infinity();
    out.highest = -out.lowest;
    std::vector<float> line(std::size_t(tile.info.columns));
    for (int row = 0; row < tile.info.rows; ++row) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        job.progress(double(row) / tile.info.rows);
        if (auto done = file->readHeights(0, row, tile.info.columns, 1, line.data()); !done)
            return tl::unexpected(done.error());
        for (const float z : line) {
            if (std::isnan(z))
                continue;
            ++out.valid;
            out.lowest = std::min(out.lowest, double(z));
            out.highest = std::max(out.highest, double(z));
        }
    }
    return out;
}

}  // namespace reflet::terrain
