// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/PreparedCity.h"

#include "core/base/ContentHash.h"
#include "core/base/ParallelFor.h"
#include "core/io/ImageFile.h"
#include "core/project/ProjectFile.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reflet {

namespace {

constexpr double kTextureBudget = 256.0 * 1024 * 1024;  // bytes of decoded textures
constexpr double kUnknownLatitude = 45.0 * kPi / 180.0;

/// The longest edge that keeps `count` textures within the budget, a power of two in 64..2048.
int textureEdge(std::size_t count) {
    const double edge = std::sqrt(kTextureBudget / (4.0 * double(std::max<std::size_t>(count, 1))));
    return int(std::clamp(std::bit_floor(unsigned(edge)), 64U, 2048U));
}

}  // namespace

std::filesystem::path cacheFolder(const std::filesystem::path& projectFile) {
    std::filesystem::path folder = projectFile;
    return folder.replace_extension(".cache");
}

Lighting lightingOf(const Project& project, const glm::dvec3& center, bool& placeKnown) {
    const auto place = geoPosition(project.frame, center);
    placeKnown = place.has_value();
    const GeoPosition where =
        place ? *place
              : GeoPosition{project.date.utcOffsetHours * kPi / 12.0, kUnknownLatitude, 0.0};
    Lighting lighting;
    lighting.sunDirection =
        sunDirection(sunPosition(project.date, where.longitude, where.latitude), where.convergence);
    lighting.turbidity = project.turbidity;
    return lighting;
}

Result<PreparedCity> PreparedCity::prepare(Project project,
                                           const std::filesystem::path& projectFile,
                                           const JobContext& job) {
    const std::filesystem::path absolute = std::filesystem::absolute(projectFile);
    PreparedCity out(std::move(project), MapCache(cacheFolder(absolute)));
    out.m_folder = absolute.parent_path();
    auto loaded = loadCity(out.m_project, out.m_folder, job.phase("reading the city", 0.0, 0.6));
    if (!loaded)
        return tl::unexpected(loaded.error());
    out.m_loaded = std::make_unique<LoadedCity>(std::move(*loaded));
    if (out.city().triangles.empty()) {
        return fail(ErrorCode::Refused, "the project has no geometry", projectFile.string(),
                    "Import a city model that has surfaces with `reflet-cli import`.");
    }
    const auto grid = gridFor(out.city(), out.m_project.heightfield);
    if (!grid)
        return tl::unexpected(grid.error());
    auto field =
        buildHeightfield(out.city(), *grid, job.phase("building the heightfield", 0.6, 1.0));
    if (!field)
        return tl::unexpected(field.error());
    out.m_heightfield = std::make_unique<Heightfield>(std::move(*field));
    out.m_tracer = std::make_unique<HeightfieldTracer>(*out.m_heightfield);
    bool placeKnown = false;
    out.m_lighting = lightingOf(out.m_project, out.city().bounds().center(), placeKnown);
    if (!placeKnown) {
        out.m_remarks.push_back(
            {Severity::Info, "place-unknown", "",
             "The city has no place on the Earth; the sun stands as at 45 degrees north.",
             "Import it with --crs to light it as at its own place."});
    }
    return out;
}

Result<PreparedCity> PreparedCity::open(const std::filesystem::path& projectFile,
                                        const JobContext& job) {
    auto project = loadProject(projectFile);
    if (!project)
        return tl::unexpected(project.error());
    return prepare(std::move(*project), projectFile, job);
}

double PreparedCity::diameter() const {
    return std::max(1.0, glm::length(city().bounds().size()));
}

double PreparedCity::groundHeight(double x, double y) const {
    const float ground = m_heightfield->groundAt(x, y);
    if (!isMissing(ground))
        return double(ground);
    const GridSpec& grid = m_heightfield->grid;
    const int i = grid.column(x);
    const int j = grid.row(y);
    if (!grid.contains(i, j))
        return 0.0;
    const float top = m_heightfield->topCenter[grid.index(i, j)];
    return isMissing(top) ? 0.0 : double(top);
}

void PreparedCity::readTextures() {
    if (m_texturesRead)
        return;
    m_texturesRead = true;
    const auto& references = city().textures;
    m_textures.resize(references.size());
    const int edge = textureEdge(references.size());
    std::vector<Diagnostic> problems(references.size());
    parallelFor(0, references.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (references[i].path.empty())
                continue;
            auto image = readTexture(references[i].path, 64'000'000, edge);
            if (image) {
                m_textures[i] = std::move(*image);
            } else {
                problems[i] = {Severity::Warning, "texture-unreadable", "", image.error().message(),
                               ""};
            }
        }
    });
    for (auto& problem : problems) {
        if (!problem.code.empty())
            m_remarks.push_back(std::move(problem));
    }
}

Result<const RadianceScene*> PreparedCity::scene(const JobContext& job) {
    if (!m_scene) {
        readTextures();
        auto made = RadianceScene::create(city(), m_textures, m_lighting, {}, job);
        if (!made)
            return tl::unexpected(made.error());
        m_scene = std::move(*made);
    }
    return m_scene.get();
}

Result<std::unique_ptr<RadianceScene>> PreparedCity::sceneWith(std::span<const Occluder> occluders,
                                                               const JobContext& job) {
    readTextures();
    m_scene.reset();
    return RadianceScene::create(city(), m_textures, m_lighting, occluders, job);
}

std::string PreparedCity::mapKey(const glm::dvec3& position, const BakeSettings& settings) const {
    ContentHash hash;
    hash.add(kBakeVersion).add(m_loaded->contentHash);
    for (int axis = 0; axis < 3; ++axis)
        hash.add(m_lighting.sunDirection[axis]).add(position[axis]);
    hash.add(m_lighting.turbidity).add(settings.resolution).add(settings.samplesPerEdge);
    return hash.hex();
}

}  // namespace reflet
