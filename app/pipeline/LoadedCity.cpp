// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/LoadedCity.h"

#include "app/pipeline/GroundModels.h"
#include "core/base/FileHash.h"
#include "core/city/TerrainDraping.h"
#include "importers/FormatRegistry.h"
#include "importers/terrain/TerrainImporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <sys/resource.h>
#include <utility>

namespace reflet {

namespace {

std::vector<std::string> textureHashes(const CityModel& city) {
    std::vector<std::string> hashes;
    for (const auto& texture : city.textures) {
        if (texture.window || texture.embedded)
            continue;  // a part of a model, whose bytes are in the hash
        const auto bytes = texture.path.empty() ? Result<std::string>("") : fileHash(texture.path);
        hashes.push_back(bytes ? *bytes : std::string("unreadable"));
    }
    return hashes;
}

/// Of the rasters in a folder.
Result<std::string> folderHash(const std::filesystem::path& folder) {
    const auto files = rasterFiles(folder);
    if (!files)
        return tl::unexpected(files.error());
    ContentHash hash;
    for (const auto& file : *files) {
        const auto bytes = fileHash(file);
        if (!bytes)
            return bytes;
        hash.add(file.filename().string()).add(*bytes);
    }
    return hash.hex();
}

/// Of a tileset: its bytes, and the names and sizes of the files below its folder, which may be
/// many gigabytes.
Result<std::string> tilesetHash(const std::filesystem::path& path) {
    ContentHash hash;
    if (auto added = addFileBytes(hash, path); !added)
        return tl::unexpected(added.error());
    constexpr std::array<std::string_view, 7> kTiles{".json", ".b3dm", ".i3dm", ".cmpt",
                                                     ".glb",  ".gltf", ".bin"};
    std::vector<std::pair<std::string, std::uint64_t>> files;
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    for (std::filesystem::recursive_directory_iterator entry(folder, error), end;
         !error && entry != end; entry.increment(error)) {
        const std::string suffix = entry->path().extension().string();
        std::error_code ignored;
        if (std::find(kTiles.begin(), kTiles.end(), suffix) != kTiles.end())
            files.emplace_back(entry->path().lexically_relative(folder).generic_string(),
                               entry->file_size(ignored));
    }
    std::sort(files.begin(), files.end());
    for (const auto& [name, size] : files)
        hash.add(name).add(size);
    return hash.hex();
}

/// Trees that stand above the ground: they tell nothing of where it is, but wait for it.
std::vector<std::uint32_t> plantsOf(const LoadedCity& loaded) {
    std::vector<std::uint32_t> plants;
    for (const std::uint32_t object : loaded.aboveGround) {
        if (loaded.city.objects[object].type == CityObjectType::SolitaryVegetation)
            plants.push_back(object);
    }
    return plants;
}

}  // namespace

ImportOptions importOptionsOf(const ModelReference& model, const ProjectFrame& frame) {
    ImportOptions options;
    static_cast<ReadingOptions&>(options) = model;
    options.frame = frame;
    return options;
}

const ObjectAccount* FileReport::accountOf(std::size_t remark) const {
    const auto& all = summary.remarked;
    const auto behind = std::upper_bound(
        all.begin(), all.end(), remark,
        [](std::size_t r, const ObjectAccount& account) { return r < account.firstRemark; });
    if (behind == all.begin())
        return nullptr;
    const ObjectAccount& account = *std::prev(behind);
    return remark < account.firstRemark + account.remarks ? &account : nullptr;
}

void ReadingClock::note(FileReport& report) const {
    constexpr std::size_t kKibi = 1024;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - m_start;
    report.seconds = taken.count();
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        report.peakMemory = std::size_t(usage.ru_maxrss) * kKibi;
}

void addReading(ContentHash& hash, const ModelReference& model) {
    hash.add(model.lod).add(model.crs);
    for (const auto& type : model.types)
        hash.add(type);
    if (model.bbox) {
        for (const double value : *model.bbox)
            hash.add(value);
    }
    if (model.placement) {
        for (int axis = 0; axis < 3; ++axis)
            hash.add(model.placement->offset[axis]);
        hash.add(model.placement->heading).add(model.placement->scale);
    }
    // Only where they are in use: the cities of older projects keep their hash.
    if (!model.heightField.empty() || !model.baseField.empty() || model.defaultHeight)
        hash.add(model.heightField).add(model.baseField).add(model.defaultHeight.value_or(0.0));
    if (!model.upAxis.empty() || model.unit)
        hash.add(model.upAxis).add(model.unit.value_or(1.0));
    if (!model.crownField.empty())
        hash.add(model.crownField);
    if (model.geometricError)
        hash.add("geometricError").add(*model.geometricError);
    if (!model.axisOrder.empty())
        hash.add("axes").add(model.axisOrder);
}

Diagnostic changedModel(const std::string& file) {
    return {Severity::Warning, "model-changed", file,
            "The city model is not the file that was imported: it has changed since.",
            "Put the old file back, or accept the new one; probes that show the change are baked "
            "again."};
}

std::filesystem::path modelPath(const ModelReference& model, const std::filesystem::path& folder) {
    return (folder / model.path).lexically_normal();
}

Result<std::string> fileHash(const std::filesystem::path& path) {
    std::error_code failed;
    if (path.filename() == "tileset.json" && std::filesystem::is_regular_file(path, failed))
        return tilesetHash(path);
    if (std::filesystem::is_directory(path, failed))
        return folderHash(path);
    ContentHash hash;
    if (auto added = addFileBytes(hash, path); !added)
        return tl::unexpected(added.error());
    // A shapefile is several files: its attributes and its CRS lie beside it. So are the materials
    // of an OBJ file.
    for (const auto& [suffix, companion] :
         {std::pair(".shp", ".dbf"), std::pair(".shp", ".prj"), std::pair(".shp", ".cpg"),
          std::pair(".obj", ".mtl"), std::pair(".obj", ".prj")}) {
        std::filesystem::path beside = path;
        beside.replace_extension(companion);
        if (path.extension() != suffix || !std::filesystem::is_regular_file(beside, failed))
            continue;
        if (auto added = addFileBytes(hash, beside); !added)
            return tl::unexpected(added.error());
    }
    return hash.hex();
}

Result<Imported<CityImport>> importFile(const std::filesystem::path& path,
                                        const ImportOptions& options, const JobContext& job) {
    const auto format = cityFormatOf(path);
    if (!format)
        return tl::unexpected(format.error());
    return (*format)->read(path, options, job);
}

Result<Imported<SourceSummary>> inspectFile(const std::filesystem::path& path,
                                            const ImportOptions& options, const JobContext& job) {
    const auto format = cityFormatOf(path);
    if (!format)
        return tl::unexpected(format.error());
    return (*format)->inspect(path, options, job);
}

Result<Imported<CityImport>> importPlaced(
    const ModelReference& model, const ImportOptions& options,
    const std::function<Result<Imported<CityImport>>(const ImportOptions&)>& read) {
    if (!model.placement)
        return read(options);
    ImportOptions asked = options;
    const bool local = model.crs == "local";
    if (local) {
        asked.frame.reset();
        asked.projectCrs.clear();
        asked.bbox.reset();
    }
    auto imported = read(asked);
    if (!imported)
        return imported;
    CityModel& city = imported->value.city;
    if (local && !city.frame.crs) {
        place(city, *model.placement, options.frame.value_or(city.frame));
    } else if (local) {
        return fail(ErrorCode::Refused,
                    "is placed as a local model, but the file says where it lies", model.path,
                    "Take its placement away.");
    } else {
        const ModelPlacement shift{model.placement->offset, 0.0, 1.0};
        place(city, shift, city.frame);
    }
    return imported;
}

bool readsAlike(const Project& a, const std::filesystem::path& folderOfA, const Project& b,
                const std::filesystem::path& folderOfB) {
    const auto alike = [&](const ModelReference& x, const ModelReference& y) {
        ModelReference moved = y;
        moved.path = x.path;
        moved.hash = x.hash;
        return moved == x && modelPath(x, folderOfA) == modelPath(y, folderOfB);
    };
    return a.frame.crs == b.frame.crs && a.frame.origin == b.frame.origin &&
           a.generatedGround == b.generatedGround &&
           std::equal(a.models.begin(), a.models.end(), b.models.begin(), b.models.end(), alike);
}

Result<Project> relocateModel(Project project, const std::string& model,
                              const std::filesystem::path& newFile,
                              const std::filesystem::path& folder) {
    const auto found = std::find_if(project.models.begin(), project.models.end(),
                                    [&](const ModelReference& m) { return m.path == model; });
    if (found == project.models.end())
        return fail(ErrorCode::Usage, "the project has no model of that path", model, "");
    auto hash = fileHash(newFile);
    if (!hash)
        return tl::unexpected(hash.error());
    const auto absolute = std::filesystem::absolute(newFile).lexically_normal();
    const auto relative =
        folder.empty() ? std::filesystem::path() : absolute.lexically_relative(folder);
    found->path = (relative.empty() ? absolute : relative).generic_string();
    found->hash = std::move(*hash);
    return project;
}

Result<Project> acceptChangedModels(Project project, const std::filesystem::path& folder) {
    for (auto& model : project.models) {
        auto hash = fileHash(modelPath(model, folder));
        if (!hash)
            return tl::unexpected(hash.error());
        model.hash = std::move(*hash);
    }
    return project;
}

void CityAssembly::add(const ModelReference& model, const std::filesystem::path& path,
                       const std::string& bytes, Imported<CityImport> imported,
                       const ReadingClock& clock) {
    if (!model.hash.empty() && model.hash != bytes)
        m_loaded.remarks.push_back(changedModel(path.string()));
    CityModel& city = imported.value.city;
    m_sources.push_back({model, bytes, textureHashes(city)});
    if (!m_frame)
        m_frame = m_loaded.city.frame = city.frame;
    const auto first = std::uint32_t(m_loaded.city.objects.size());
    const auto count = std::uint32_t(city.objects.size());
    for (const std::uint32_t object : imported.value.aboveGround)
        m_loaded.aboveGround.push_back(first + object);
    if (m_loaded.files.empty()) {
        m_loaded.city = std::move(city);
    } else {
        append(m_loaded.city, city);
    }
    FileReport& report =
        m_loaded.files.emplace_back(FileReport{path.string(), std::move(imported.value.summary),
                                               imported.counts, std::move(imported.diagnostics)});
    report.firstObject = first;
    report.objectCount = count;
    clock.note(report);
}

Result<LoadedCity> CityAssembly::finish(const Project& project, const std::filesystem::path& folder,
                                        ImportOptions options, const JobContext& job) {
    LoadedCity& loaded = m_loaded;
    if (!options.frame)
        options.frame = m_frame;
    if (options.frame)
        loaded.city.frame = *options.frame;
    if (auto done = readTerrain(project.models, folder, options, loaded, job); !done)
        return tl::unexpected(done.error());
    ContentHash hash;
    hash.add(loaded.city.frame.crs.value_or("local"));
    for (int axis = 0; axis < 3; ++axis)
        hash.add(loaded.city.frame.origin[axis]);
    for (const Source& source : m_sources) {
        hash.add(source.bytes);
        addReading(hash, source.model);
        for (const std::string& texture : source.textures)
            hash.add(texture);
    }
    if (auto done = addGroundModels(hash, project.models, folder, loaded.remarks); !done)
        return tl::unexpected(done.error());
    drapeOnTerrain(loaded.city, loaded.aboveGround);
    judgeGroundFit(loaded);
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (project.generatedGround && addGeneratedGround(loaded.city, kGeneratedGroundMargin)) {
        loaded.generatedGround = true;
        drapeOnTerrain(loaded.city, plantsOf(loaded));
    }
    if (auto done = layOrthophotos(project.models, folder, loaded, job); !done)
        return tl::unexpected(done.error());
    loaded.contentHash = hash.add(project.generatedGround).hex();
    return std::move(loaded);
}

Result<LoadedCity> loadCity(const Project& project, const std::filesystem::path& folder,
                            const JobContext& job) {
    CityAssembly assembly;
    const double count = double(project.models.size());
    for (std::size_t i = 0; i < project.models.size(); ++i) {
        const ModelReference& model = project.models[i];
        if (model.use != ModelUse::City)
            continue;
        const std::filesystem::path path = modelPath(model, folder);
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error)) {
            return fail(ErrorCode::Unreadable, "the city model of the project is missing",
                        path.string(),
                        "Put the file back, show where it is now, or import it anew with "
                        "`reflet-cli import`.");
        }
        const ReadingClock clock;
        const JobContext phase = job.phase("reading " + path.filename().string(), double(i) / count,
                                           double(i + 1) / count);
        auto imported = importPlaced(
            model, importOptionsOf(model, project.frame),
            [&](const ImportOptions& options) { return importFile(path, options, phase); });
        if (!imported)
            return tl::unexpected(imported.error());
        const auto bytes = fileHash(path);
        if (!bytes)
            return tl::unexpected(bytes.error());
        assembly.add(model, path, *bytes, std::move(*imported), clock);
    }
    ImportOptions options;
    options.frame = project.frame;
    return assembly.finish(project, folder, options, job);
}

}  // namespace reflet
