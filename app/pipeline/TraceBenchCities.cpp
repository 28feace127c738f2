// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TraceBenchCities.h"

#include "app/pipeline/Import.h"
#include "app/pipeline/ScratchFolder.h"
#include "app/pipeline/Traffic.h"
#include "app/pipeline/WriteSample.h"
#include "core/heightfield/HeightfieldBuilder.h"

#include <array>

namespace reflet {

namespace {

constexpr double kBodyCenter = 1.5;  ///< metres above the ground, where no vehicle tells it
constexpr float kOpen = 0.3F;        ///< metres that open ground may rise above the terrain
constexpr std::uint64_t kSeed = 1;

/// Part of a number in the Halton sequence, in [0, 1): spreads positions evenly.
double halton(unsigned index, unsigned base) {
    double part = 1.0, value = 0.0;
    for (; index > 0; index /= base) {
        part /= double(base);
        value += part * double(index % base);
    }
    return value;
}

/// Positions on the ground where nothing stands on it.
std::vector<glm::dvec3> openPositions(const Heightfield& field, int count) {
    const GridSpec& grid = field.grid;
    std::vector<glm::dvec3> positions;
    for (unsigned k = 1; int(positions.size()) < count && k < 1000U * unsigned(count); ++k) {
        const int i = int(halton(k, 2) * grid.columns);
        const int j = int(halton(k, 3) * grid.rows);
        const float ground = field.ground[grid.index(i, j)];
        if (!isMissing(ground) && field.topMax[grid.index(i, j)] < ground + kOpen)
            positions.push_back({grid.xMin(i) + 0.37 * grid.cellSize,
                                 grid.yMin(j) + 0.71 * grid.cellSize,
                                 double(ground) + kBodyCenter});
    }
    return positions;
}

/// Centres of the vehicles' local maps at equal steps along their routes.
std::vector<glm::dvec3> drivenPositions(const Traffic& traffic, int count) {
    std::vector<glm::dvec3> positions;
    for (int k = 0; k < count; ++k) {
        const auto reflector = std::size_t(k) % traffic.size();
        const double part = (k + 0.5) / count;
        const PlacedReflector placed =
            traffic.atStation(reflector, part * traffic.route(reflector).length());
        positions.push_back(placed.mapCenter(std::size_t(k) % placed.poses.size()));
    }
    return positions;
}

Result<TraceBenchCity> cityOf(const PreparedCity& prepared, std::string name, int poses) {
    const auto traffic = trafficOf(prepared.project(), prepared.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    TraceBenchCity city;
    city.name = std::move(name);
    city.model = prepared.city();
    city.field = prepared.heightfield();
    city.tracer = std::make_shared<const HeightfieldTracer>(city.field);
    city.positions =
        traffic->size() > 0 ? drivenPositions(*traffic, poses) : openPositions(city.field, poses);
    city.diameter = prepared.diameter();
    city.tuning = prepared.project().tuning;
    if (city.positions.empty())
        return fail(ErrorCode::Refused, "There is no open ground to trace from", city.name,
                    "Give it a route with a vehicle.");
    return city;
}

Result<PreparedCity> opened(const std::filesystem::path& file, const JobContext& job) {
    if (file.extension() == ".reflet")
        return PreparedCity::open(file, job);
    ImportRequest request;
    request.files = {file};
    auto imported = importProject(request, job.phase("import", 0.0, 0.6));
    if (!imported)
        return tl::unexpected(imported.error());
    PrepareOptions options;
    options.city = std::move(imported->city);
    options.keep = false;
    return PreparedCity::prepare(std::move(imported->project), file.parent_path() / "bench.reflet",
                                 job.phase("prepare", 0.6, 1.0), options);
}

/// "paper" as it would be written, read back; nothing of it stays on the disk.
Result<TraceBenchCity> paperCity(int poses, const JobContext& job) {
    const ScratchFolder folder;
    if (folder.path().empty())
        return fail(ErrorCode::WriteFailed, "There is no temporary folder to write the sample to",
                    "TMPDIR", "Let TMPDIR name a folder that can be written to.");
    const auto project = writeSample("paper", kSeed, folder.path());
    if (!project)
        return tl::unexpected(project.error());
    const auto prepared = opened(*project, job);
    if (!prepared)
        return tl::unexpected(prepared.error());
    return cityOf(*prepared, "paper", poses);
}

Result<TraceBenchCity> tenfoldCity(const TraceBenchCity& city, const JobContext& job) {
    TraceBenchCity dense = city;
    dense.name = city.name + "-tenfold";
    dense.model = tenfold(city.model);
    auto field = buildHeightfield(dense.model, city.field.grid, job);
    if (!field)
        return tl::unexpected(field.error());
    dense.field = std::move(*field);
    dense.tracer = std::make_shared<const HeightfieldTracer>(dense.field);
    return dense;
}

using Corners = std::array<std::uint32_t, 3>;

/// The four parts of a triangle, the middle one last.
std::array<Corners, 4> quartered(std::vector<glm::vec3>& vertices, const Corners& corners) {
    Corners middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = std::uint32_t(vertices.size());
        vertices.push_back(0.5F * (vertices[corners[k]] + vertices[corners[(k + 1) % 3]]));
    }
    return {{{corners[0], middle[0], middle[2]},
             {middle[0], corners[1], middle[1]},
             {middle[2], middle[1], corners[2]},
             middle}};
}

}  // namespace

CityModel tenfold(const CityModel& city) {
    CityModel dense;
    dense.frame = city.frame;
    dense.objects = city.objects;
    dense.surfaces = city.surfaces;
    dense.vertices = city.vertices;
    dense.triangles.reserve(10 * city.triangles.size());
    for (const auto& triangle : city.triangles) {
        const auto parts = quartered(dense.vertices, triangle.vertex);
        for (std::size_t k = 0; k < 2; ++k)
            dense.triangles.push_back({parts[k], triangle.surface});
        for (std::size_t k = 2; k < 4; ++k) {
            for (const Corners& part : quartered(dense.vertices, parts[k]))
                dense.triangles.push_back({part, triangle.surface});
        }
    }
    return dense;
}

Result<std::vector<TraceBenchCity>> traceBenchCities(const TraceBenchOptions& options,
                                                     const JobContext& job) {
    std::vector<TraceBenchCity> cities;
    for (std::size_t k = 0; k < options.files.size(); ++k) {
        const auto& file = options.files[k];
        const double count = double(options.files.size());
        const auto prepared = opened(
            file, job.phase(file.filename().string(), double(k) / count, double(k + 1) / count));
        if (!prepared)
            return tl::unexpected(prepared.error());
        auto city = cityOf(*prepared, file.stem().string(), options.poses);
        if (!city)
            return tl::unexpected(city.error());
        cities.push_back(std::move(*city));
    }
    if (options.files.empty()) {
        auto paper = paperCity(options.poses, job.phase("paper", 0.0, 0.5));
        if (!paper)
            return tl::unexpected(paper.error());
        auto dense = tenfoldCity(*paper, job.phase("tenfold", 0.5, 1.0));
        if (!dense)
            return tl::unexpected(dense.error());
        cities.push_back(std::move(*paper));
        cities.push_back(std::move(*dense));
    }
    return cities;
}

}  // namespace reflet
