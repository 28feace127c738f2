// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"
#include "core/baking/AmbientVolume.h"
#include "core/baking/CityContents.h"
#include "core/baking/RadianceScene.h"
#include "core/geo/FramePosition.h"
#include "core/gpu/Frame.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/io/MapCache.h"
#include "core/io/SightCache.h"
#include "core/reconstruction/PreparedRems.h"

#include <filesystem>
#include <memory>
#include <span>

namespace reflet {

/// How a city is prepared.
struct PrepareOptions {
    std::shared_ptr<const LoadedCity> city = nullptr;  ///< read for the project already
    bool drawn = false;  ///< make what drawn() gives beside the heightfield, at the same time
    bool keep = true;    ///< keep a heightfield that took long in the cache folder
};

/// A project with everything that can be derived quickly from it: the city, its heightfield, the
/// light. What is slower (looks, textures, the scene for rays) is made when it is first asked for.
/// A value whose copies share all of it; safe to read from several threads, which wait for each
/// other while something is made for the first time.
class PreparedCity {
public:
    /// `projectFile` decides where models and the cache folder are looked for; it need not exist.
    [[nodiscard]] static Result<PreparedCity> prepare(Project project,
                                                      const std::filesystem::path& projectFile,
                                                      const JobContext& job,
                                                      const PrepareOptions& options = {});

    /// Loads a project file and prepares it.
    [[nodiscard]] static Result<PreparedCity> open(const std::filesystem::path& projectFile,
                                                   const JobContext& job,
                                                   const PrepareOptions& options = {});

    /// The same for a project that was changed since: what the change does not touch is shared
    /// with this one. Models that are read alike are not read again, even when their files changed.
    [[nodiscard]] Result<PreparedCity> updated(Project project,
                                               const std::filesystem::path& projectFile,
                                               const JobContext& job) const;

    /// The same with another tuning: nothing is made anew.
    [[nodiscard]] PreparedCity withTuning(const MemSettings& tuning) const;

    [[nodiscard]] const Project& project() const { return m_project; }
    /// The folder of the project file: relative paths start there.
    [[nodiscard]] const std::filesystem::path& folder() const { return m_folder; }
    [[nodiscard]] const LoadedCity& loaded() const { return *m_loaded; }
    [[nodiscard]] const CityModel& city() const { return m_loaded->city; }
    [[nodiscard]] const Heightfield& heightfield() const { return *m_heightfield; }
    [[nodiscard]] const HeightfieldTracer& tracer() const { return *m_tracer; }
    [[nodiscard]] const Lighting& lighting() const { return m_lighting; }
    [[nodiscard]] const MapCache& cache() const { return m_cache; }
    [[nodiscard]] const SightCache& sights() const { return m_sights; }
    /// Metres across the city: the distance that sky counts as.
    [[nodiscard]] double diameter() const;

    /// Absolute (project file) to project-frame coordinates.
    [[nodiscard]] glm::dvec3 inFrame(const glm::dvec3& absolute) const {
        return frameFromAbsolute(m_project.frame, absolute);
    }
    /// Which REMs serve which place; kept for the set that was asked for last.
    [[nodiscard]] std::shared_ptr<const PreparedRems> preparedRems(const RemSet& rems) const;
    /// Height of the ground (frame) under a frame position: the terrain, else the surface on top,
    /// else 0.
    [[nodiscard]] double groundHeight(double x, double y) const;

    /// What a renderer needs of it. Looks and textures are made at the first call. Cancelled.
    [[nodiscard]] Result<std::shared_ptr<const DrawnCity>> drawn(const JobContext& job) const;
    /// Soft light in the plain scene. Made at the first call.
    [[nodiscard]] Result<std::shared_ptr<const AmbientVolume>> ambient(const JobContext& job) const;
    /// Whether both were read from the same models: they are drawn from the same data.
    [[nodiscard]] bool sharesCityWith(const PreparedCity& other) const {
        return m_loaded == other.m_loaded && m_heightfield == other.m_heightfield;
    }

    /// The city for rays, without vehicles. Made at the first call.
    [[nodiscard]] Result<std::shared_ptr<const RadianceScene>> scene(const JobContext& job) const;
    /// The city with vehicles standing in it; it shares all but them with scene().
    [[nodiscard]] Result<std::unique_ptr<RadianceScene>> sceneWith(
        std::span<const Occluder> occluders, const JobContext& job) const;

    /// Cache key of a map baked at a frame position with these settings.
    [[nodiscard]] std::string mapKey(const glm::dvec3& position, const BakeSettings& settings,
                                     Baker baker = Baker::Rays) const;

    /// The same without the city: what keeps its name when the city changes.
    [[nodiscard]] std::string placeKey(const glm::dvec3& position,
                                       const BakeSettings& settings) const;
    /// What the city shows in the cells of a grid; kept for a few grids. Cancelled.
    [[nodiscard]] Result<std::shared_ptr<const CellContents>> contents(const CellGrid& grid,
                                                                       const JobContext& job) const;

    /// Remarks made so far (an unknown place for the sun, models that changed on the disk,
    /// textures that could not be read).
    [[nodiscard]] std::vector<Diagnostic> remarks() const;

private:
    struct CityLooks;  ///< made once for a city
    struct LitScene;   ///< made once for a city and a light
    struct KeptRems;   ///< what preparedRems() keeps, for a heightfield

    PreparedCity(Project project, const std::filesystem::path& projectFile);
    /// Takes the city, reads it anew where there is none, and so on down to the light.
    [[nodiscard]] Result<void> complete(const PreparedCity* before, const PrepareOptions& options,
                                        const JobContext& job);
    [[nodiscard]] Result<void> takeCity(std::shared_ptr<const LoadedCity> city);
    [[nodiscard]] Result<void> buildField(bool keep, const JobContext& job);
    /// From the cache folder where it was kept, else built (and kept when that took long).
    [[nodiscard]] Result<Heightfield> cachedField(const GridSpec& grid, bool keep,
                                                  const JobContext& job) const;

    Project m_project;
    std::filesystem::path m_file;
    std::filesystem::path m_folder;
    MapCache m_cache;
    SightCache m_sights;
    std::shared_ptr<const LoadedCity> m_loaded;
    std::shared_ptr<CityLooks> m_looks;
    std::shared_ptr<const Heightfield> m_heightfield;
    std::shared_ptr<const HeightfieldTracer> m_tracer;
    std::shared_ptr<KeptRems> m_preparedRems;
    Lighting m_lighting;
    bool m_placeKnown = true;
    std::shared_ptr<LitScene> m_scene;
};

/// The folder for derived data beside a project file: "name.cache".
[[nodiscard]] std::filesystem::path cacheFolder(const std::filesystem::path& projectFile);

/// The light at a place and time. A place that is unknown (local coordinates) counts as 45° north
/// on the meridian of the time zone; `placeKnown` tells.
[[nodiscard]] Lighting lightingOf(const Project& project, const glm::dvec3& center,
                                  bool& placeKnown);

}  // namespace reflet
