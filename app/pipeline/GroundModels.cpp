// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GroundModels.h"

#include "importers/terrain/Orthophoto.h"
#include "importers/terrain/TerrainImporter.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

namespace fs = std::filesystem;

namespace {

struct Group {
    std::vector<const ModelReference*> models;
    std::vector<fs::path> files;
};

/// Terrain that is read in the same way may join.
std::vector<Group> terrainGroups(const std::vector<ModelReference>& models) {
    std::vector<Group> groups;
    for (const ModelReference& model : models) {
        if (model.use != ModelUse::Terrain)
            continue;
        const auto home = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
            const ModelReference& first = *group.models.front();
            return first.crs == model.crs && first.bbox == model.bbox &&
                   first.placement == model.placement;
        });
        Group& group = home != groups.end() ? *home : groups.emplace_back();
        group.models.push_back(&model);
    }
    return groups;
}

Result<void> readGroup(Group& group, const fs::path& folder, ImportOptions options,
                       LoadedCity& loaded, const JobContext& job) {
    const ReadingClock clock;
    for (const ModelReference* model : group.models) {
        auto files = rasterFiles(modelPath(*model, folder));
        if (!files)
            return tl::unexpected(files.error());
        group.files.insert(group.files.end(), files->begin(), files->end());
    }
    const ModelReference& first = *group.models.front();
    options.crs = first.crs;
    options.bbox = first.bbox;
    auto imported = importPlaced(first, options, [&](const ImportOptions& asked) {
        return importTerrain(group.files, asked, {}, job);
    });
    if (!imported)
        return tl::unexpected(imported.error());
    if (loaded.city.triangles.empty() && !options.frame)
        loaded.city.frame = imported->value.city.frame;
    const auto firstObject = std::uint32_t(loaded.city.objects.size());
    append(loaded.city, imported->value.city);
    // The first of several tells of all of them.
    for (const ModelReference* model : group.models) {
        loaded.files.push_back({modelPath(*model, folder).string(), imported->value.summary,
                                imported->counts, std::move(imported->diagnostics)});
        FileReport& report = loaded.files.back();
        report.firstObject = firstObject;
        report.objectCount = std::uint32_t(imported->value.city.objects.size());
        clock.note(report);
        imported->diagnostics.clear();
        imported->counts = {};
    }
    return {};
}

}  // namespace

Result<void> readTerrain(const std::vector<ModelReference>& models, const fs::path& folder,
                         const ImportOptions& options, LoadedCity& loaded, const JobContext& job) {
    std::vector<Group> groups = terrainGroups(models);
    ImportOptions now = options;
    for (std::size_t k = 0; k < groups.size(); ++k) {
        const double count = double(groups.size());
        auto done = readGroup(groups[k], folder, now, loaded,
                              job.phase("terrain", double(k) / count, double(k + 1) / count));
        if (!done)
            return done;
        now.frame = loaded.city.frame;
    }
    return {};
}

Result<void> layOrthophotos(const std::vector<ModelReference>& models, const fs::path& folder,
                            LoadedCity& loaded, const JobContext& job) {
    std::vector<Orthophoto> pictures;
    for (const ModelReference& model : models) {
        if (model.use != ModelUse::Orthophoto)
            continue;
        const auto files = rasterFiles(modelPath(model, folder));
        if (!files)
            return tl::unexpected(files.error());
        const glm::dvec2 offset(model.placement ? model.placement->offset : glm::dvec3(0.0));
        for (const fs::path& file : *files)
            pictures.push_back({file, model.crs, offset});
        FileReport report;
        report.file = modelPath(model, folder).string();
        report.summary.format = "orthophoto";
        report.summary.texturesReferenced = report.summary.texturesResolved = files->size();
        loaded.files.push_back(std::move(report));
    }
    if (pictures.empty())
        return {};
    auto remarks = drape(loaded.city, pictures, {}, job);
    if (!remarks)
        return tl::unexpected(remarks.error());
    loaded.remarks.insert(loaded.remarks.end(), remarks->begin(), remarks->end());
    return {};
}

Result<void> addGroundModels(ContentHash& hash, const std::vector<ModelReference>& models,
                             const fs::path& folder, std::vector<Diagnostic>& remarks) {
    for (const ModelReference& model : models) {
        if (model.use == ModelUse::City)
            continue;
        const fs::path path = modelPath(model, folder);
        const auto own = fileHash(path);
        if (!own)
            return tl::unexpected(own.error());
        if (!model.hash.empty() && model.hash != *own)
            remarks.push_back(changedModel(path.string()));
        const auto files = rasterFiles(path);
        if (!files)
            return tl::unexpected(files.error());
        hash.add(model.use).add(*own);
        addReading(hash, model);
        for (const fs::path& file : *files) {
            const auto bytes = file == path ? own : fileHash(file);
            if (!bytes)
                return tl::unexpected(bytes.error());
            hash.add(*bytes);
        }
    }
    return {};
}

ModelUse useOf(const fs::path& path) {
    const auto files = rasterFiles(path);
    if (!files)
        return ModelUse::City;
    switch (rasterUse(files->front())) {
        case RasterUse::Terrain:
            return ModelUse::Terrain;
        case RasterUse::Orthophoto:
            return ModelUse::Orthophoto;
        case RasterUse::None:
            break;
    }
    return ModelUse::City;
}

}  // namespace reflet
