// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Import.h"

#include "app/pipeline/Edit.h"
#include "app/pipeline/GroundModels.h"
#include "core/city/TerrainDraping.h"
#include "core/geo/Crs.h"
#include "core/project/ProjectFile.h"
#include "importers/terrain/Orthophoto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

std::filesystem::path folderOf(const std::filesystem::path& project) {
    return project.empty() ? project : std::filesystem::absolute(project).parent_path();
}

ImportOptions optionsOf(const ImportRequest& request) {
    ImportOptions options;
    static_cast<ReadingOptions&>(options) = request;
    // A model that is placed comes into that CRS by its placement.
    const bool placed = request.places.size() == 1 && request.places.front().model.empty();
    options.projectCrs = placed ? std::string() : request.projectCrs;
    options.strict = request.strict;
    return options;
}

/// The files that were named without a use, by what they are for.
std::map<ModelUse, std::vector<std::filesystem::path>> filesByUse(const ImportRequest& request) {
    std::map<ModelUse, std::vector<std::filesystem::path>> files;
    for (const auto& file : request.files)
        files[useOf(file)].push_back(file);
    return files;
}

Result<void> readCities(const ImportRequest& request,
                        const std::vector<std::filesystem::path>& files, Project& project,
                        CityAssembly& assembly, const JobContext& job) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        const ReadingClock clock;
        const auto& file = files[i];
        const double count = double(files.size());
        ImportOptions options = optionsOf(request);
        options.frame = assembly.frame();
        auto imported = importFile(
            file, options,
            job.phase(file.filename().string(), double(i) / count, double(i + 1) / count));
        if (!imported)
            return tl::unexpected(imported.error());
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        auto hash = fileHash(file);
        if (!hash)
            return tl::unexpected(hash.error());
        project.models.push_back({request, storedPath(file, request.output), *hash});
        assembly.add(project.models.back(), file, *hash, std::move(*imported), clock);
    }
    return {};
}

/// The rasters as models of the project.
Result<void> addRasters(const std::vector<std::filesystem::path>& files, ModelUse use,
                        const ImportRequest& request, Project& project) {
    for (const auto& file : files) {
        auto hash = fileHash(file);
        if (!hash)
            return tl::unexpected(hash.error());
        ModelReference model;
        model.path = storedPath(file, request.output);
        model.hash = std::move(*hash);
        model.crs = request.crs;
        model.use = use;
        if (use == ModelUse::Terrain)
            model.bbox = request.bbox;
        project.models.push_back(std::move(model));
    }
    return {};
}

std::filesystem::path wholePath(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
}

/// A picture that a model names hangs on one of its walls: it is no picture of the ground.
using TextureFiles = std::set<std::filesystem::path>;
void addTextureFiles(TextureFiles& named, const CityModel& city) {
    for (const CityTexture& texture : city.textures) {
        if (!texture.path.empty())
            named.insert(wholePath(texture.path));
    }
}

Result<LoadedCity> readModels(const ImportRequest& request, Project& project,
                              const JobContext& job) {
    auto files = filesByUse(request);
    CityAssembly assembly;
    if (auto done = readCities(request, files[ModelUse::City], project, assembly,
                               job.phase("cities", 0.0, 0.7));
        !done)
        return tl::unexpected(done.error());
    TextureFiles textures;
    addTextureFiles(textures, assembly.city());
    const auto sortRasters = [&](ModelUse use, const auto& named) {
        std::erase_if(files[use], [&](const auto& f) { return textures.contains(wholePath(f)); });
        files[use].insert(files[use].end(), named.begin(), named.end());
    };
    sortRasters(ModelUse::Terrain, request.terrain);
    sortRasters(ModelUse::Orthophoto, request.orthophotos);
    for (const ModelUse use : {ModelUse::Terrain, ModelUse::Orthophoto})
        if (auto done = addRasters(files[use], use, request, project); !done)
            return tl::unexpected(done.error());
    auto loaded = assembly.finish(project, folderOf(request.output), optionsOf(request),
                                  job.phase("terrain", 0.7, 1.0));
    if (loaded)
        project.frame = loaded->city.frame;
    return loaded;
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

/// Places models, and reads the city where it now stands.
Result<void> applyPlaces(Project& project, const ImportRequest& request, ImportReport& report,
                         LoadedCity& city, const JobContext& job) {
    for (const PlaceRequest& place : request.places) {
        auto placed = placeModel(std::move(project), place, folderOf(request.output), job);
        if (!placed)
            return tl::unexpected(placed.error());
        project = std::move(placed->project);
        report.remarks.insert(report.remarks.end(), placed->remarks.begin(), placed->remarks.end());
    }
    if (request.places.empty())
        return {};
    auto loaded = loadCity(project, folderOf(request.output), job.phase("placing", 0.6, 0.7));
    if (!loaded)
        return tl::unexpected(loaded.error());
    city = std::move(*loaded);
    return {};
}

/// What is said of the first object that was lost, else of the file; null where nothing is wrong.
const Diagnostic* firstFault(const std::vector<Diagnostic>& diagnostics) {
    for (const bool ofObject : {true, false}) {
        const auto found =
            std::find_if(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
                return d.severity != Severity::Info && d.code != "no-crs" &&
                       d.object.empty() != ofObject;
            });
        if (found != diagnostics.end())
            return &*found;
    }
    return nullptr;
}

/// The error of a file that gave no surface, with the reason where one is known.
tl::unexpected<Error> nothingToShow(const std::string& file, std::size_t objects,
                                    const std::vector<Diagnostic>& diagnostics) {
    std::string what = "nothing to show: no surface was loaded";
    std::string remedy = "Check --lod, --types and --bbox, and the report of `reflet-cli info`.";
    if (const Diagnostic* fault = firstFault(diagnostics)) {
        what +=
            fmt::format("; {}{}{}", fault->object, fault->object.empty() ? "" : ": ", fault->text);
        if (!fault->remedy.empty())
            remedy = fault->remedy;
    } else if (objects == 0) {
        what += "; it has no city object, or none that was asked for";
    }
    return fail(ErrorCode::Refused, std::move(what), file, std::move(remedy));
}

std::size_t repairedOrSkipped(const LoadedCity& city) {
    std::size_t count = 0;
    for (const auto& file : city.files)
        count += file.counts.repaired + file.counts.skipped;
    return count;
}

/// Adds one raster to a project that has a frame, once it was seen that it can be read there.
Result<void> addRaster(Project& project, const std::filesystem::path& folder,
                       const std::filesystem::path& projectFile, const std::filesystem::path& file,
                       ModelUse use, const JobContext& job) {
    ImportRequest request;
    request.output = projectFile;
    Project alone;
    if (auto added = addRasters({file}, use, request, alone); !added)
        return added;
    LoadedCity loaded;
    loaded.city.frame = project.frame;
    ImportOptions options;
    options.frame = project.frame;
    if (auto read = readTerrain(alone.models, folder, options, loaded, job); !read)
        return read;
    if (auto laid = layOrthophotos(alone.models, folder, loaded, job); !laid)
        return laid;
    if (use == ModelUse::Terrain && loaded.city.triangles.empty())
        return fail(ErrorCode::Refused, "holds no height", file.string(),
                    "See `reflet-cli info` for what is in the file.");
    project.models.push_back(std::move(alone.models.front()));
    return {};
}

}  // namespace

Result<ImportReport> importProject(const ImportRequest& request, const JobContext& job) {
    if (request.files.empty() && request.terrain.empty()) {
        return fail(ErrorCode::Usage, "no file was given", "import",
                    "Name at least one city model, or a terrain with --terrain.");
    }
    const auto& firstFile = request.files.empty() ? request.terrain.front() : request.files.front();
    ImportReport report;
    Project& project = report.project;
    // "town.city.json" is the town.
    project.name = (request.output.empty() ? firstFile.stem() : request.output).stem().string();
    if (request.projectTemplate) {
        if (auto applied = applyTemplate(project, *request.projectTemplate); !applied)
            return tl::unexpected(applied.error());
    }
    auto read = readModels(request, project, job.phase("reading", 0.0, 0.7));
    if (!read)
        return tl::unexpected(read.error());
    LoadedCity& city = *read;
    if (city.city.triangles.empty()) {
        return city.files.empty()
                   ? nothingToShow(firstFile.string(), 0, {})
                   : nothingToShow(city.files.front().file, city.files.front().summary.objects,
                                   city.files.front().diagnostics);
    }
    if (const std::size_t count = repairedOrSkipped(city); request.strict && count > 0) {
        return fail(ErrorCode::Refused,
                    fmt::format("{} objects had to be repaired or skipped", count),
                    firstFile.string(),
                    "See `reflet-cli info`, mend the file, or import without --strict.");
    }
    if (auto placed = applyPlaces(project, request, report, city, job); !placed)
        return tl::unexpected(placed.error());
    if (!request.projectTemplate || !request.date.empty()) {
        if (auto applied = applyDate(project, request.date, city.city.bounds().center());
            !applied) {
            return tl::unexpected(applied.error());
        }
    }
    if (auto applied = applyVertical(project, request.vertical); !applied)
        return tl::unexpected(applied.error());
    city.city.frame = project.frame;
    report.remarks.insert(report.remarks.end(), city.remarks.begin(), city.remarks.end());
    report.city = std::make_shared<const LoadedCity>(std::move(city));
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
    TextureFiles textures;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const ModelUse use = useOf(files[i]);
        if (use != ModelUse::City) {
            if (textures.contains(wholePath(files[i])))
                continue;
            if (auto added = addRaster(project, folder, projectFile, files[i], use, job); !added)
                return tl::unexpected(added.error());
            continue;
        }
        ImportOptions options;
        options.frame = project.frame;
        const double count = double(files.size());
        const auto imported = importFile(
            files[i], options,
            job.phase(files[i].filename().string(), double(i) / count, double(i + 1) / count));
        if (!imported)
            return tl::unexpected(imported.error());
        if (imported->value.city.triangles.empty()) {
            return nothingToShow(files[i].string(), imported->value.summary.objects,
                                 imported->diagnostics);
        }
        addTextureFiles(textures, imported->value.city);
        auto hash = fileHash(files[i]);
        if (!hash)
            return tl::unexpected(hash.error());
        project.models.push_back({options, storedPath(files[i], projectFile), *hash});
    }
    return project;
}

}  // namespace reflet
