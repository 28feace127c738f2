// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/PreparedCity.h"

#include "app/pipeline/TextureDecoding.h"
#include "core/baking/SceneParts.h"
#include "core/base/ContentHash.h"
#include "core/gpu/city/CityBaker.h"
#include "core/gpu/city/CityPass.h"
#include "core/io/HeightfieldCache.h"
#include "core/project/ProjectFile.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <future>
#include <mutex>
#include <optional>

namespace reflet {

namespace {

constexpr std::size_t kWorthKeeping = 250'000;  // cells of a heightfield; fewer are built at once
/// Part of a kept heightfield's key: to be raised when buildHeightfield gives other numbers.
constexpr int kHeightfieldVersion = 4;
constexpr std::size_t kAmbientNodes = 60'000;
constexpr double kUnknownLatitude = 45.0 * kPi / 180.0;
constexpr std::size_t kGridsKept = 4;  // of cells that sights are noted in

/// What a map depends on besides the city.
void addPlace(ContentHash& hash, const Lighting& lighting, const glm::dvec3& position,
              const BakeSettings& settings) {
    for (int axis = 0; axis < 3; ++axis)
        hash.add(lighting.sunDirection[axis]).add(position[axis]);
    hash.add(lighting.turbidity).add(settings.resolution).add(settings.samplesPerEdge);
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

/// Looks, textures and what rays need: the same in every light. Whoever comes first makes them.
struct PreparedCity::CityLooks {
    std::shared_ptr<const CityModel> model;
    std::timed_mutex mutex;  ///< guards what follows
    std::shared_ptr<const SurfaceLooks> looks;
    std::shared_ptr<const std::vector<TextureImage>> textures;
    std::shared_ptr<const CityMesh> mesh;
    std::optional<SceneParts> parts;
    std::unique_ptr<const CityContents> contents;
    std::deque<std::shared_ptr<const CellContents>> inGrids;  ///< the last that were asked for
    std::vector<Diagnostic> remarks;

    /// With the mutex held. Nothing is kept of what was cancelled.
    void makeLooks(const JobContext& job);
    void makeMesh(const JobContext& job);
    void makeContents(const JobContext& job);
};

struct PreparedCity::LitScene {
    std::timed_mutex mutex;
    std::shared_ptr<const RadianceScene> scene;
    std::timed_mutex ambientMutex;
    std::shared_ptr<const AmbientVolume> ambient;
};

struct PreparedCity::KeptRems {
    std::mutex mutex;
    std::shared_ptr<const PreparedRems> last;
};

namespace {

/// Waits for somebody else's work without losing sight of the own job's cancellation.
std::unique_lock<std::timed_mutex> lockUnlessCancelled(std::timed_mutex& mutex,
                                                       const JobContext& job) {
    constexpr std::chrono::milliseconds poll(20);
    std::unique_lock lock(mutex, std::defer_lock);
    while (!job.cancelled() && !lock.try_lock_for(poll)) {
    }
    return lock;
}

}  // namespace

void PreparedCity::CityLooks::makeLooks(const JobContext& job) {
    if (looks || job.cancelled())
        return;
    std::vector<Diagnostic> found;
    auto images = std::make_shared<const std::vector<TextureImage>>(
        decodeTextures(model->textures, found, job));
    if (job.cancelled())
        return;
    textures = std::move(images);
    remarks.insert(remarks.end(), found.begin(), found.end());
    auto made = std::make_shared<const SurfaceLooks>(*model, job);
    if (!job.cancelled())
        looks = std::move(made);
}

void PreparedCity::CityLooks::makeMesh(const JobContext& job) {
    makeLooks(job);
    if (looks && !mesh && !job.cancelled())
        mesh = buildCityMesh(std::make_shared<const DrawnCity>(
                                 DrawnCity{model, looks, textures, nullptr, nullptr, 0.0, nullptr}),
                             job);
}

void PreparedCity::CityLooks::makeContents(const JobContext& job) {
    makeLooks(job);
    if (!looks || contents || job.cancelled())
        return;
    contents = std::make_unique<const CityContents>(*model, *looks, contentOf(*textures, *model));
}

PreparedCity::PreparedCity(Project project, const std::filesystem::path& projectFile)
    : m_project(std::move(project)),
      m_file(std::filesystem::absolute(projectFile)),
      m_folder(m_file.parent_path()),
      m_cache(cacheFolder(m_file)),
      m_sights(cacheFolder(m_file)) {}

Result<PreparedCity> PreparedCity::prepare(Project project,
                                           const std::filesystem::path& projectFile,
                                           const JobContext& job, const PrepareOptions& options) {
    PreparedCity out(std::move(project), projectFile);
    if (auto done = out.complete(nullptr, options, job); !done)
        return tl::unexpected(done.error());
    return out;
}

Result<PreparedCity> PreparedCity::updated(Project project,
                                           const std::filesystem::path& projectFile,
                                           const JobContext& job) const {
    PreparedCity out(std::move(project), projectFile);
    if (auto done = out.complete(this, {}, job); !done)
        return tl::unexpected(done.error());
    return out;
}

PreparedCity PreparedCity::withTuning(const MemSettings& tuning) const {
    PreparedCity out = *this;
    out.m_project.tuning = tuning;
    return out;
}

std::shared_ptr<const PreparedRems> PreparedCity::preparedRems(const RemSet& rems) const {
    const std::scoped_lock lock(m_preparedRems->mutex);
    if (!m_preparedRems->last || !(m_preparedRems->last->rems() == rems))
        m_preparedRems->last = std::make_shared<const PreparedRems>(m_tracer, rems);
    return m_preparedRems->last;
}

Result<PreparedCity> PreparedCity::open(const std::filesystem::path& projectFile,
                                        const JobContext& job, const PrepareOptions& options) {
    auto project = loadProject(projectFile);
    if (!project)
        return tl::unexpected(project.error());
    return prepare(std::move(*project), projectFile, job, options);
}

Result<void> PreparedCity::takeCity(std::shared_ptr<const LoadedCity> city) {
    if (city->city.triangles.empty()) {
        return fail(ErrorCode::Refused, "the project has no geometry", m_project.name,
                    "Import a city model that has surfaces with `reflet-cli import`.");
    }
    m_loaded = std::move(city);
    m_looks = std::make_shared<CityLooks>();
    m_looks->model = std::shared_ptr<const CityModel>(m_loaded, &m_loaded->city);
    return {};
}

Result<void> PreparedCity::complete(const PreparedCity* before, const PrepareOptions& options,
                                    const JobContext& job) {
    if (before != nullptr && readsAlike(before->m_project, before->m_folder, m_project, m_folder)) {
        m_loaded = before->m_loaded;
        m_looks = before->m_looks;
    } else if (options.city != nullptr) {
        if (auto taken = takeCity(options.city); !taken)
            return taken;
    } else {
        auto loaded = loadCity(m_project, m_folder, job.phase("reading the city", 0.0, 0.6));
        if (!loaded)
            return tl::unexpected(loaded.error());
        auto taken = takeCity(std::make_shared<const LoadedCity>(std::move(*loaded)));
        if (!taken)
            return taken;
    }
    if (before != nullptr && m_loaded == before->m_loaded &&
        m_project.heightfield == before->m_project.heightfield) {
        m_heightfield = before->m_heightfield;
        m_tracer = before->m_tracer;
        m_preparedRems = before->m_preparedRems;
    } else {
        std::future<void> mesh;
        if (options.drawn) {
            mesh = std::async(std::launch::async, [looks = m_looks, stop = job.stopToken()] {
                const std::scoped_lock lock(looks->mutex);
                looks->makeMesh(JobContext({}, stop));
            });
        }
        auto built = buildField(options.keep, job.phase("building the heightfield", 0.6, 1.0));
        if (mesh.valid())
            mesh.get();
        if (!built)
            return built;
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
    }
    // Asking for the sun costs a walk over all vertices and PROJ: not at every move of a probe.
    if (before != nullptr && m_loaded == before->m_loaded &&
        m_project.frame == before->m_project.frame && m_project.date == before->m_project.date &&
        m_project.turbidity == before->m_project.turbidity) {
        m_lighting = before->m_lighting;
        m_placeKnown = before->m_placeKnown;
    } else {
        // By whole kilometres: a building more at the edge must not turn the sun for all others.
        constexpr double kKilometre = 1000.0;
        const glm::dvec3 middle = glm::round(city().bounds().center() / kKilometre) * kKilometre;
        m_lighting = lightingOf(m_project, {middle.x, middle.y, 0.0}, m_placeKnown);
    }
    const bool sameLight =
        before != nullptr && m_loaded == before->m_loaded && m_lighting == before->m_lighting;
    m_scene = sameLight ? before->m_scene : std::make_shared<LitScene>();
    return {};
}

Result<void> PreparedCity::buildField(bool keep, const JobContext& job) {
    const auto grid = gridFor(city(), m_project.heightfield);
    if (!grid)
        return tl::unexpected(grid.error());
    auto field = cachedField(*grid, keep, job);
    if (!field)
        return tl::unexpected(field.error());
    m_heightfield = std::make_shared<const Heightfield>(std::move(*field));
    // The tracer refers to the heightfield, and keeps it alive here.
    struct Both {
        std::shared_ptr<const Heightfield> field;
        HeightfieldTracer tracer;
    };
    const auto both =
        std::make_shared<const Both>(Both{m_heightfield, HeightfieldTracer(*m_heightfield)});
    m_tracer = std::shared_ptr<const HeightfieldTracer>(both, &both->tracer);
    m_preparedRems = std::make_shared<KeptRems>();
    return {};
}

Result<Heightfield> PreparedCity::cachedField(const GridSpec& grid, bool keep,
                                              const JobContext& job) const {
    if (!keep || grid.cellCount() < kWorthKeeping)
        return buildHeightfield(city(), grid, m_project.heightfield.rules, job);
    ContentHash hash;
    hash.add(kHeightfieldVersion).add(m_loaded->contentHash);
    hash.add(grid.x0).add(grid.y0).add(grid.cellSize).add(grid.columns).add(grid.rows);
    const HeightRules& rules = m_project.heightfield.rules;
    hash.add(rules.clearance);
    for (const HeightPolicy policy : rules.policies)
        hash.add(int(policy));
    const std::string key = hash.hex();
    const HeightfieldCache cache(cacheFolder(m_file));
    if (auto kept = cache.find(key, grid))
        return std::move(*kept);
    auto built = buildHeightfield(city(), grid, rules, job);
    // A folder that cannot be written to costs time, nothing else.
    if (built)
        static_cast<void>(cache.store(key, *built));
    return built;
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
    const float top = m_heightfield->standingTop(grid.index(i, j));
    return isMissing(top) ? 0.0 : double(top);
}

Result<std::shared_ptr<const DrawnCity>> PreparedCity::drawn(const JobContext& job) const {
    const auto lock = lockUnlessCancelled(m_looks->mutex, job);
    if (!lock)
        return tl::unexpected(JobContext::cancelledError());
    m_looks->makeMesh(job);
    if (!m_looks->mesh)
        return tl::unexpected(JobContext::cancelledError());
    auto city = std::make_shared<DrawnCity>(DrawnCity{
        m_looks->model, m_looks->looks, m_looks->textures, m_heightfield, m_tracer, diameter()});
    city->mesh = m_looks->mesh;
    return city;
}

Result<std::shared_ptr<const AmbientVolume>> PreparedCity::ambient(const JobContext& job) const {
    const auto scene = this->scene(job.phase("preparing", 0.0, 0.3));
    if (!scene)
        return tl::unexpected(scene.error());
    const auto lock = lockUnlessCancelled(m_scene->ambientMutex, job);
    if (!lock)
        return tl::unexpected(JobContext::cancelledError());
    if (!m_scene->ambient) {
        auto volume =
            gatherAmbient(**scene, kAmbientNodes, job.phase("gathering soft light", 0.3, 1.0));
        if (!volume)
            return tl::unexpected(volume.error());
        m_scene->ambient = std::make_shared<const AmbientVolume>(std::move(*volume));
    }
    return m_scene->ambient;
}

Result<std::shared_ptr<const RadianceScene>> PreparedCity::scene(const JobContext& job) const {
    const auto lock = lockUnlessCancelled(m_scene->mutex, job);
    if (!lock)
        return tl::unexpected(JobContext::cancelledError());
    if (!m_scene->scene) {
        auto made = sceneWith({}, job);
        if (!made)
            return tl::unexpected(made.error());
        m_scene->scene = std::move(*made);
    }
    return m_scene->scene;
}

Result<std::unique_ptr<RadianceScene>> PreparedCity::sceneWith(std::span<const Occluder> occluders,
                                                               const JobContext& job) const {
    std::optional<SceneParts> parts;
    {
        const auto lock = lockUnlessCancelled(m_looks->mutex, job);
        if (!lock)
            return tl::unexpected(JobContext::cancelledError());
        m_looks->makeLooks(job);
        if (!m_looks->looks)
            return tl::unexpected(JobContext::cancelledError());
        if (!m_looks->parts) {
            auto made = makeSceneParts(m_looks->model, m_looks->looks, m_looks->textures, job);
            if (!made)
                return tl::unexpected(made.error());
            m_looks->parts = std::move(*made);
        }
        parts = m_looks->parts;
    }
    return RadianceScene::create(*parts, m_lighting, occluders, job);
}

std::vector<Diagnostic> PreparedCity::remarks() const {
    std::vector<Diagnostic> out = m_loaded->remarks;
    if (!m_placeKnown) {
        out.push_back({Severity::Info, "place-unknown", "",
                       "The city has no place on the Earth; the sun stands as at 45 degrees north.",
                       "Import it with --crs to light it as at its own place."});
    }
    const std::unique_lock lock(m_looks->mutex);
    out.insert(out.end(), m_looks->remarks.begin(), m_looks->remarks.end());
    return out;
}

std::string PreparedCity::mapKey(const glm::dvec3& position, const BakeSettings& settings,
                                 Baker baker) const {
    ContentHash hash;
    hash.add(kBakeVersion).add(m_loaded->contentHash);
    addPlace(hash, m_lighting, position, settings);
    // Those of rays have the keys that they always had.
    if (baker == Baker::OpenGl)
        hash.add("OpenGL").add(kDrawnBakeVersion);
    return hash.hex();
}

std::string PreparedCity::placeKey(const glm::dvec3& position, const BakeSettings& settings) const {
    ContentHash hash;
    hash.add("sight").add(kBakeVersion);
    addPlace(hash, m_lighting, position, settings);
    return hash.hex();
}

Result<std::shared_ptr<const CellContents>> PreparedCity::contents(const CellGrid& grid,
                                                                   const JobContext& job) const {
    const auto lock = lockUnlessCancelled(m_looks->mutex, job);
    if (!lock)
        return tl::unexpected(JobContext::cancelledError());
    auto& kept = m_looks->inGrids;
    const auto found =
        std::find_if(kept.begin(), kept.end(), [&](const auto& one) { return one->grid == grid; });
    if (found != kept.end())
        return *found;
    m_looks->makeContents(job);
    if (!m_looks->contents)
        return tl::unexpected(JobContext::cancelledError());
    kept.push_front(std::make_shared<const CellContents>(m_looks->contents->in(grid)));
    kept.resize(std::min(kept.size(), kGridsKept));
    return kept.front();
}

}  // namespace reflet
