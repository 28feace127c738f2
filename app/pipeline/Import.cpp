// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Import.h"

#include "app/pipeline/Edit.h"
#include "core/geo/Crs.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// The path as it is stored in a project: relative to its folder, with slashes. Absolute for a
/// project that has no file.
std::string storedPath(const std::filesystem::path& file, const std::filesystem::path& project) {
    const auto absolute = std::filesystem::absolute(file).lexically_normal();
    if (project.empty())
        return absolute.generic_string();
    const auto folder = std::filesystem::absolute(project).parent_path().lexically_normal();
    const auto relative = absolute.lexically_relative(folder);
    return (relative.empty() ? absolute : relative).generic_string();
}

Result<void> applyTemplate(Project& project, const std::filesystem::path& path) {
    const auto source = loadProject(path);
    if (!source)
        return tl::unexpected(source.error());
    project.heightfield = source->heightfield;
    project.bake = source->bake;
    project.tuning = source->tuning;
    project.date = source->date;
    project.turbidity = source->turbidity;
    project.exposure = source->exposure;
    project.generatedGround = source->generatedGround;
    return {};
}

/// The zone of the default date: whole hours of mean solar time, or that of the date given.
Result<void> applyDate(Project& project, const std::string& date, const glm::dvec3& center) {
    const auto place = geoPosition(project.frame, center);
    const double offset = place ? solarUtcOffsetHours(place->longitude) : 0.0;
    if (date.empty()) {
        project.date.utcOffsetHours = offset;
        return {};
    }
    const auto parsed = parseDateTime(date, offset);
    if (!parsed)
        return tl::unexpected(parsed.error());
    project.date = *parsed;
    return {};
}

Result<void> readModels(const ImportRequest& request, Project& project, ImportReport& report,
                        CityModel& city, const JobContext& job) {
    std::optional<ProjectFrame> frame;
    for (std::size_t i = 0; i < request.files.size(); ++i) {
        const auto& file = request.files[i];
        const double count = double(request.files.size());
        ImportOptions options;
        options.lod = request.lod;
        options.crs = request.crs;
        options.projectCrs = request.projectCrs;
        options.frame = frame;
        options.types = request.types;
        options.bbox = request.bbox;
        options.strict = request.strict;
        auto imported = importFile(
            file, options,
            job.phase(file.filename().string(), double(i) / count, double(i + 1) / count));
        if (!imported)
            return tl::unexpected(imported.error());
        frame = imported->value.city.frame;
        auto hash = fileHash(file);
        if (!hash)
            return tl::unexpected(hash.error());
        project.models.push_back({storedPath(file, request.output), *hash, request.crs, request.lod,
                                  request.types, request.bbox});
        city.frame = *frame;
        append(city, imported->value.city);
        report.files.push_back({file.string(), std::move(imported->value.summary), imported->counts,
                                std::move(imported->diagnostics)});
    }
    project.frame = *frame;
    return {};
}

Result<void> applyVertical(Project& project, const std::string& vertical) {
    if (vertical.empty())
        return {};
    const auto crs = Crs::parse("EPSG:4326+" + vertical.substr(vertical.rfind(':') + 1));
    if (!crs || !crs->vertical()) {
        return fail(
            ErrorCode::Refused, "this is no vertical datum that PROJ knows", vertical,
            "Give the EPSG code of a vertical CRS, e.g. EPSG:5709 (NAP) or EPSG:7837 (DHHN2016).");
    }
    project.frame.vertical = *crs->vertical();
    return {};
}

std::size_t repairedOrSkipped(const ImportReport& report) {
    std::size_t count = 0;
    for (const auto& file : report.files)
        count += file.counts.repaired + file.counts.skipped;
    return count;
}

}  // namespace

Result<ImportReport> importProject(const ImportRequest& request, const JobContext& job) {
    if (request.files.empty()) {
        return fail(ErrorCode::Usage, "no file was given", "import",
                    "Name at least one city model.");
    }
    ImportReport report;
    Project& project = report.project;
    // "town.city.json" is the town.
    project.name =
        (request.output.empty() ? request.files.front().stem() : request.output).stem().string();
    CityModel city;
    if (auto read = readModels(request, project, report, city, job.phase("reading", 0.0, 0.7));
        !read) {
        return tl::unexpected(read.error());
    }
    if (city.triangles.empty()) {
        return fail(ErrorCode::Refused, "nothing to show: no surface was loaded",
                    request.files.front().string(),
                    "Check --lod, --types and --bbox, and the report of `reflet-cli info`.");
    }
    if (request.strict && repairedOrSkipped(report) > 0) {
        return fail(
            ErrorCode::Refused,
            fmt::format("{} objects had to be repaired or skipped", repairedOrSkipped(report)),
            request.files.front().string(),
            "See `reflet-cli info`, mend the file, or import without --strict.");
    }
    if (request.projectTemplate) {
        if (auto applied = applyTemplate(project, *request.projectTemplate); !applied)
            return tl::unexpected(applied.error());
    }
    if (!request.projectTemplate || !request.date.empty()) {
        if (auto applied = applyDate(project, request.date, city.bounds().center()); !applied) {
            return tl::unexpected(applied.error());
        }
    }
    if (auto applied = applyVertical(project, request.vertical); !applied)
        return tl::unexpected(applied.error());
    report.generatedGround =
        project.generatedGround &&
        std::none_of(city.triangles.begin(), city.triangles.end(), [&](const CityTriangle& t) {
            return isTerrain(city.objects[city.surfaces[t.surface].object].type);
        });
    if (request.routes) {
        const std::string vehicle = request.vehicle.empty() ? "tram" : request.vehicle;
        auto added = addRoutes(project, request.output, *request.routes, vehicle, report.remarks,
                               job.phase("routes", 0.7, 1.0));
        if (!added)
            return tl::unexpected(added.error());
    }
    if (!request.output.empty()) {
        if (auto saved = saveProject(project, request.output); !saved)
            return tl::unexpected(saved.error());
    }
    return report;
}

Result<Project> addModels(Project project, const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& files, const JobContext& job) {
    const std::filesystem::path projectFile = folder.empty() ? folder : folder / "project.reflet";
    for (std::size_t i = 0; i < files.size(); ++i) {
        ImportOptions options;
        options.frame = project.frame;
        const double count = double(files.size());
        const auto imported = importFile(
            files[i], options,
            job.phase(files[i].filename().string(), double(i) / count, double(i + 1) / count));
        if (!imported)
            return tl::unexpected(imported.error());
        if (imported->value.city.triangles.empty()) {
            return fail(ErrorCode::Refused, "nothing to show: no surface was loaded",
                        files[i].string(), "See `reflet-cli info` for what is in the file.");
        }
        auto hash = fileHash(files[i]);
        if (!hash)
            return tl::unexpected(hash.error());
        project.models.push_back(
            {storedPath(files[i], projectFile), *hash, options.crs, options.lod, {}, {}});
    }
    return project;
}

}  // namespace reflet
