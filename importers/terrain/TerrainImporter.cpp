// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/TerrainImporter.h"

#include "importers/common/Placement.h"
#include "importers/terrain/GridTriangulation.h"
#include "importers/terrain/TerrainTiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

using terrain::Mosaic;
using terrain::MosaicHeights;
using terrain::PixelWindow;
using terrain::TerrainTile;

namespace fs = std::filesystem;

constexpr double kFarthest = 1e9;  ///< no CRS has coordinates beyond
constexpr double kNoPlace = std::numeric_limits<double>::quiet_NaN();

/// A file's coordinates in the terms of the city formats.
importers::SourceCity sourceOf(const RasterInfo& info) {
    importers::SourceCity source;
    source.format = info.format;
    source.version = "1.0";  // without a transform of its own
    source.referenceSystem = info.crs;
    return source;
}

/// Where the grid lies: its system and the frame that it comes into.
struct Place {
    importers::SourceCity source;
    importers::SourceCrs crs;
    importers::Placement placement;
};

class TerrainImport {
public:
    TerrainImport(const ImportOptions& options, const TerrainOptions& terrain,
                  const JobContext& job)
        : m_options(options), m_terrain(terrain), m_job(job) {}

    Result<Imported<CityImport>> run(std::vector<TerrainTile> tiles) {
        summarise(tiles);
        std::vector<Mosaic> mosaics = terrain::groupTiles(std::move(tiles));
        for (std::size_t k = 0; k < mosaics.size(); ++k) {
            const double count = double(mosaics.size());
            const JobContext job =
                m_job.phase("reading the terrain", double(k) / count, double(k + 1) / count);
            if (auto done = add(mosaics[k], job); !done)
                return tl::unexpected(done.error());
        }
        if (mosaics.size() > 1) {
            remark(Severity::Info, "terrain-grids",
                   fmt::format("the files make {} separate grids", mosaics.size()),
                   "Bring them onto one grid with gdalwarp where they shall join.");
        }
        m_out.value.summary.vertices = m_out.value.city.vertices.size();
        m_out.value.summary.triangles = m_out.value.city.triangles.size();
        m_out.value.summary.surfaces = m_out.value.city.surfaces.size();
        m_out.counts.loaded = m_out.value.city.objects.size();
        return std::move(m_out);
    }

private:
    void remark(Severity severity, std::string code, std::string text, std::string remedy = {}) {
        m_out.diagnostics.push_back(
            {severity, std::move(code), m_object, std::move(text), std::move(remedy)});
    }

    void summarise(const std::vector<TerrainTile>& tiles) {
        SourceSummary& summary = m_out.value.summary;
        summary.format = tiles.front().info.format;
        const std::string type = toString(CityObjectType::TinRelief);
        for (const TerrainTile& tile : tiles)
            summary.raster.push_back({tile.info.columns, tile.info.rows, tile.info.bands});
        summary.byType[type] = 0;
    }

    Result<void> add(Mosaic& mosaic, const JobContext& job) {
        const std::string subject = mosaic.tiles.front().file;
        m_object = fs::path(subject).stem().string();
        if (!mosaic.info.placed)
            remark(Severity::Warning, "not-placed",
                   "it does not say where it lies; its pixels were taken as metres",
                   "Give it a world file (.tfw), or place it by hand.");
        auto place = placeOf(mosaic, subject);
        if (!place)
            return tl::unexpected(place.error());
        const auto window = windowOf(mosaic, *place);
        if (!window)
            return tl::unexpected(window.error());
        if (window->columns < 2 || window->rows < 2) {
            remark(Severity::Warning, "outside", "none of it lies in the part that was asked for");
            return {};
        }
        const terrain::ReadLimits limits{m_terrain.mostPosts, m_terrain.mostLookedAt};
        auto heights = terrain::readWindow(mosaic, *window, limits, job.phase("reading", 0.0, 0.6));
        if (!heights)
            return tl::unexpected(heights.error());
        auto triangles =
            terrain::triangulateGrid(heights->grid, {m_terrain.error, m_terrain.mostTriangles},
                                     job.phase("triangulating", 0.6, 0.95));
        if (!triangles)
            return tl::unexpected(triangles.error());
        account(*heights, *triangles);
        return append(mosaic, *heights, *triangles, *place, job);
    }

    /// The system, its unit and the frame. The frame of the first grid serves for the rest.
    Result<Place> placeOf(Mosaic& mosaic, const std::string& subject) {
        importers::SourceCity source = sourceOf(mosaic.info);
        ImportOptions options = m_options;
        if (!m_out.value.city.objects.empty())
            options.frame = m_out.value.city.frame;
        auto crs = importers::sourceCrs(source.referenceSystem, options, false, subject,
                                        m_out.diagnostics);
        if (!crs)
            return tl::unexpected(crs.error());
        const double unitOfCrs = crs->crs ? terrain::heightUnitOf(*crs->crs) : 1.0;
        mosaic.unit = mosaic.info.heightUnit.value_or(unitOfCrs);
        m_unitOfCrs = unitOfCrs;
        const RasterInfo& info = mosaic.info;
        importers::Extent extent;
        for (const double i : {0.5, info.columns - 0.5})
            for (const double j : {0.5, info.rows - 0.5})
                extent.add(glm::dvec3(info.at(i, j), 0.0));
        const glm::dvec2 middle = info.at(0.5 * info.columns, 0.5 * info.rows);
        importers::checkAxes(glm::dvec3(middle, 0.0), importers::AxisOrder::Settled, "", *crs,
                             m_out.diagnostics);  // GDAL has put east first
        if (!m_out.diagnostics.empty() && m_out.diagnostics.back().code == kAxesExchanged)
            m_out.diagnostics.back().remedy =
                "Mend the place of the raster with gdal_translate -a_ullr, or its CRS with -a_srs.";
        std::vector<Diagnostic> remarks;
        auto placement = importers::Placement::create(*crs, extent, options, subject, remarks);
        if (!placement)
            return tl::unexpected(placement.error());
        for (Diagnostic& said : remarks)
            if (said.code != "height-unit" || !mosaic.info.heightUnit)
                m_out.diagnostics.push_back(std::move(said));
        if (crs->crs) {
            m_out.value.summary.crsHorizontal = crs->crs->horizontal();
            m_out.value.summary.crsVertical = crs->crs->vertical();
        }
        m_out.value.summary.crsAccount = {crs->rule, source.referenceSystem, placement->operation(),
                                          placement->accuracy()};
        return Place{std::move(source), std::move(*crs), std::move(*placement)};
    }

    /// The pixels that the caller wants, those around them included.
    Result<PixelWindow> windowOf(const Mosaic& mosaic, const Place& place) const {
        PixelWindow window{0, 0, mosaic.info.columns, mosaic.info.rows};
        if (!m_options.bbox)
            return window;
        auto rim = rimOf(*m_options.bbox);
        const auto& frame = place.placement.frame();
        if (place.crs.crs && frame.crs && place.crs.crs->horizontal() != *frame.crs) {
            const auto from = Crs::parse(*frame.crs);
            if (!from)
                return tl::unexpected(from.error());
            const auto transform = CrsTransform::create(*from, *place.crs.crs);
            if (!transform)
                return tl::unexpected(transform.error());
            if (auto done = transform->apply(rim); !done)
                return tl::unexpected(done.error().in("finding the part of --bbox"));
        }
        return around(mosaic.info, rim);
    }

    static std::vector<glm::dvec3> rimOf(const std::array<double, 4>& box) {
        constexpr int kSteps = 16;
        std::vector<glm::dvec3> rim;
        for (int k = 0; k <= kSteps; ++k) {
            const double s = double(k) / kSteps;
            const double east = box[0] + s * (box[2] - box[0]);
            const double north = box[1] + s * (box[3] - box[1]);
            rim.emplace_back(east, box[1], 0.0);
            rim.emplace_back(east, box[3], 0.0);
            rim.emplace_back(box[0], north, 0.0);
            rim.emplace_back(box[2], north, 0.0);
        }
        return rim;
    }

    static PixelWindow around(const RasterInfo& info, const std::vector<glm::dvec3>& points) {
        const auto& t = info.transform;
        const double determinant = t[1] * t[5] - t[2] * t[4];
        glm::dvec2 low(info.columns, info.rows);
        glm::dvec2 high(0.0);
        for (const glm::dvec3& p : points) {
            const double x = p.x - t[0];
            const double y = p.y - t[3];
            // Posts are numbered from 0 at the centre of the first pixel.
            const glm::dvec2 pixel((t[5] * x - t[2] * y) / determinant - 0.5,
                                   (t[1] * y - t[4] * x) / determinant - 0.5);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
        const auto whole = [](double value, int most) {
            return int(std::clamp(value, 0.0, double(most)));
        };
        const int first = whole(std::floor(low.x), info.columns);
        const int top = whole(std::floor(low.y), info.rows);
        const int last = whole(std::ceil(high.x) + 1.0, info.columns);
        const int bottom = whole(std::ceil(high.y) + 1.0, info.rows);
        return {first, top, std::max(last - first, 0), std::max(bottom - top, 0)};
    }

    void account(const MosaicHeights& heights, const terrain::GridTriangles& triangles) {
        if (heights.outOfRange > 0)
            remark(Severity::Warning, "undeclared-no-data",
                   fmt::format("{} pixels hold -9999 or heights beyond 12 km and were taken as "
                               "missing",
                               heights.outOfRange),
                   "Declare the no-data value: gdal_edit.py -a_nodata VALUE FILE");
        if (heights.missing > 0)
            remark(Severity::Info, "no-data",
                   fmt::format("{} of {} posts have no height; there is no ground there",
                               heights.missing, heights.grid.heights.size()));
        const double error = triangles.error + heights.omittedError;
        std::string text = fmt::format(
            "{} posts became {} triangles; no post lies further than "
            "{:.2f} m from them",
            heights.grid.heights.size(), triangles.triangles.size(), error);
        if (heights.step > 1)
            text = fmt::format(
                "of {} x {} posts every {}th each way was taken; {}", heights.window.columns,
                heights.window.rows, heights.step,
                std::isnan(error) ? "how far the others lie off was not measured" : text);
        remark(triangles.error > m_terrain.error || heights.step > 1 ? Severity::Warning
                                                                     : Severity::Info,
               "decimated", std::move(text),
               heights.step > 1 ? "Import a part with --bbox to have all of it." : "");
    }

    Result<void> append(const Mosaic& mosaic, const MosaicHeights& heights,
                        const terrain::GridTriangles& triangles, Place& place,
                        const JobContext& job) {
        importers::SourceCity& source = place.source;
        source.vertices.clear();
        source.vertices.reserve(triangles.places.size());
        for (std::size_t k = 0; k < triangles.places.size(); ++k) {
            const glm::dvec2 pixel =
                glm::dvec2(heights.window.firstColumn, heights.window.firstRow) +
                triangles.places[k] * double(heights.step) + 0.5;
            const glm::dvec2 p = mosaic.info.at(pixel.x, pixel.y);
            // Written so that NaN fails too.
            const bool sound = std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest;
            source.vertices.push_back(sound ? glm::dvec3(p, triangles.heights[k] / m_unitOfCrs)
                                            : glm::dvec3(kNoPlace));
        }
        auto local = place.placement.vertices(source, source.vertices, false, job);
        if (!local)
            return tl::unexpected(local.error());
        CityModel grid;
        grid.frame = place.placement.frame();
        grid.objects.push_back(
            {m_object, CityObjectType::TinRelief, toString(CityObjectType::TinRelief), {}, {}});
        grid.vertices.assign(local->begin(), local->end());
        addTriangles(grid, triangles, *local);
        CityModel& city = m_out.value.city;
        city.frame = grid.frame;
        reflet::append(city, grid);
        SourceSummary& summary = m_out.value.summary;
        ++summary.objects;
        ++summary.byType[toString(CityObjectType::TinRelief)];
        for (const glm::dvec3& p : source.vertices)
            summary.bounds.add(glm::dvec3(p.x, p.y, p.z));
        return {};
    }

    static void addTriangles(CityModel& grid, const terrain::GridTriangles& triangles,
                             const std::vector<glm::dvec3>& local) {
        std::uint32_t block = kNone;
        for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
            std::array<std::uint32_t, 3> corner = triangles.triangles[t];
            const glm::dvec2 a(local[corner[0]]);
            const glm::dvec2 b(local[corner[1]]);
            const glm::dvec2 c(local[corner[2]]);
            const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            if (!(std::abs(area) > 0.0))
                continue;  // no image in the frame, or a sliver at the rim
            if (area < 0.0)
                std::swap(corner[1], corner[2]);
            if (triangles.block[t] != block) {
                block = triangles.block[t];
                grid.surfaces.push_back({0, SurfaceType::Ground, kNone, kNone, false});
            }
            grid.triangles.push_back({corner, std::uint32_t(grid.surfaces.size() - 1)});
        }
    }

    const ImportOptions& m_options;
    const TerrainOptions& m_terrain;
    const JobContext& m_job;
    Imported<CityImport> m_out;
    std::string m_object;      ///< of the grid at hand
    double m_unitOfCrs = 1.0;  ///< that the placement will multiply heights by
};

constexpr int kMostColumns = 2'000'000;  ///< a row must fit into memory with ease

Result<void> checkSize(const RasterInfo& info, const std::string& name) {
    if (info.columns <= kMostColumns && info.rows <= kMostColumns)
        return {};
    return fail(ErrorCode::ResourceLimit,
                fmt::format("claims {} x {} pixels", info.columns, info.rows), name,
                "Cut the part that is needed out of it: gdal_translate -projwin.");
}

Result<TerrainTile> tileOf(const Result<RasterFile>& file, const std::string& name,
                           std::string bytes) {
    if (!file)
        return tl::unexpected(file.error());
    if (file->info().isPicture())
        return fail(ErrorCode::Refused, "is a picture, not a terrain: it has colours", name,
                    "Give it with --ortho, and a raster with one band of heights with --terrain.");
    if (auto sound = checkSize(file->info(), name); !sound)
        return tl::unexpected(sound.error());
    return TerrainTile{name, std::move(bytes), file->info()};
}

}  // namespace

Result<Imported<CityImport>> importTerrain(const std::vector<fs::path>& files,
                                           const ImportOptions& options,
                                           const TerrainOptions& terrain, const JobContext& job) {
    std::vector<TerrainTile> tiles;
    for (const fs::path& path : files) {
        auto tile = tileOf(RasterFile::open(path), path.string(), {});
        if (!tile)
            return tl::unexpected(tile.error());
        tiles.push_back(std::move(*tile));
    }
    if (tiles.empty())
        return fail(ErrorCode::Usage, "no file was given", "terrain");
    return TerrainImport(options, terrain, job).run(std::move(tiles));
}

Result<Imported<CityImport>> importTerrainBytes(std::string_view bytes, const std::string& name,
                                                const ImportOptions& options,
                                                const TerrainOptions& terrain,
                                                const JobContext& job) {
    auto tile = tileOf(RasterFile::openBytes(bytes, name), name, std::string(bytes));
    if (!tile)
        return tl::unexpected(tile.error());
    std::vector<TerrainTile> tiles;
    tiles.push_back(std::move(*tile));
    return TerrainImport(options, terrain, job).run(std::move(tiles));
}

Result<Imported<CityImport>> importRaster(const fs::path& path, const ImportOptions& options,
                                          const JobContext& job) {
    if (rasterUse(path) != RasterUse::Orthophoto)
        return importTerrain({path}, options, {}, job);
    auto seen = inspectRaster(path, options, job);
    if (!seen)
        return tl::unexpected(seen.error());
    Imported<CityImport> out;
    out.value.summary = std::move(seen->value);
    out.diagnostics = std::move(seen->diagnostics);
    if (options.frame)
        out.value.city.frame = *options.frame;
    return out;
}

RasterUse rasterUse(const fs::path& path) {
    if (!RasterFile::recognises(path))
        return RasterUse::None;
    const auto file = RasterFile::open(path);
    if (!file)
        return RasterUse::None;
    return file->info().isPicture() ? RasterUse::Orthophoto : RasterUse::Terrain;
}

Result<Imported<SourceSummary>> inspectRaster(const fs::path& path, const ImportOptions& options,
                                              const JobContext& job) {
    const auto file = RasterFile::open(path);
    if (!file)
        return tl::unexpected(file.error());
    const RasterInfo& info = file->info();
    Imported<SourceSummary> out;
    SourceSummary& summary = out.value;
    summary.format = info.format;
    summary.raster.push_back({info.columns, info.rows, info.bands});
    summary.texturesReferenced = summary.texturesResolved = info.isPicture() ? 1 : 0;
    const auto crs = importers::sourceCrs(info.crs, options, true, path.string(), out.diagnostics);
    if (!crs)
        return tl::unexpected(crs.error());
    summary.crsAccount = {crs->rule, info.crs, {}, {}};
    if (crs->crs) {
        summary.crsHorizontal = crs->crs->horizontal();
        summary.crsVertical = crs->crs->vertical();
    }
    glm::dvec2 heights(0.0);
    if (auto sound = checkSize(info, path.string()); !sound)
        return tl::unexpected(sound.error());
    constexpr double kMostLookedAt = 4e9;
    if (!info.isPicture() && double(info.columns) * info.rows < kMostLookedAt) {
        const auto statistics = terrain::statisticsOf({path.string(), {}, info}, job);
        if (!statistics)
            return tl::unexpected(statistics.error());
        summary.objects = 1;
        summary.byType[toString(CityObjectType::TinRelief)] = 1;
        summary.vertices = statistics->valid;
        if (statistics->valid > 0)
            heights = {statistics->lowest, statistics->highest};
    }
    for (const int i : {0, info.columns})
        for (const int j : {0, info.rows})
            for (const double z : {heights.x, heights.y})
                summary.bounds.add(glm::dvec3(info.at(i, j), z));
    out.counts.loaded = summary.objects;
    return out;
}

}  // namespace reflet
