// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"
#include "core/baking/RadianceScene.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/io/MapCache.h"

#include <filesystem>
#include <memory>
#include <span>

namespace reflet {

/// A project with everything that can be derived quickly from it: the city, its heightfield, the
/// light. The scene for rays is made when it is first asked for.
class PreparedCity {
public:
    /// `projectFile` decides where models and the cache folder are looked for.
    [[nodiscard]] static Result<PreparedCity> prepare(Project project,
                                                      const std::filesystem::path& projectFile,
                                                      const JobContext& job);

    /// Loads a project file and prepares it.
    [[nodiscard]] static Result<PreparedCity> open(const std::filesystem::path& projectFile,
                                                   const JobContext& job);

    [[nodiscard]] const Project& project() const { return m_project; }
    /// The folder of the project file: relative paths start there.
    [[nodiscard]] const std::filesystem::path& folder() const { return m_folder; }
    [[nodiscard]] const LoadedCity& loaded() const { return *m_loaded; }
    [[nodiscard]] const CityModel& city() const { return m_loaded->city; }
    [[nodiscard]] const Heightfield& heightfield() const { return *m_heightfield; }
    [[nodiscard]] const HeightfieldTracer& tracer() const { return *m_tracer; }
    [[nodiscard]] const Lighting& lighting() const { return m_lighting; }
    [[nodiscard]] const MapCache& cache() const { return m_cache; }
    /// Metres across the city: the distance that sky counts as.
    [[nodiscard]] double diameter() const;

    /// Absolute (project file) to project-frame coordinates.
    [[nodiscard]] glm::dvec3 inFrame(const glm::dvec3& absolute) const {
        return absolute - m_project.frame.origin;
    }
    /// Height of the ground (frame) under a frame position: the terrain, else the surface on top,
    /// else 0.
    [[nodiscard]] double groundHeight(double x, double y) const;

    /// The city for rays, without vehicles. Made once; textures are decoded then.
    [[nodiscard]] Result<const RadianceScene*> scene(const JobContext& job);
    /// The city with vehicles standing in it. The plain scene is dropped first to save memory.
    [[nodiscard]] Result<std::unique_ptr<RadianceScene>> sceneWith(
        std::span<const Occluder> occluders, const JobContext& job);

    /// Cache key of a map baked at a frame position with these settings.
    [[nodiscard]] std::string mapKey(const glm::dvec3& position,
                                     const BakeSettings& settings) const;

    /// Remarks made while preparing (an unknown place for the sun, textures that could not be
    /// read).
    [[nodiscard]] const std::vector<Diagnostic>& remarks() const { return m_remarks; }

private:
    PreparedCity(Project project, MapCache cache)
        : m_project(std::move(project)), m_cache(std::move(cache)) {}
    void readTextures();

    Project m_project;
    std::filesystem::path m_folder;
    MapCache m_cache;
    std::unique_ptr<LoadedCity> m_loaded;
    std::unique_ptr<Heightfield> m_heightfield;
    std::unique_ptr<HeightfieldTracer> m_tracer;
    Lighting m_lighting;
    std::vector<TextureImage> m_textures;
    bool m_texturesRead = false;
    std::unique_ptr<RadianceScene> m_scene;
    std::vector<Diagnostic> m_remarks;
};

/// The folder for derived data beside a project file: "name.cache".
[[nodiscard]] std::filesystem::path cacheFolder(const std::filesystem::path& projectFile);

/// The light at a place and time. A place that is unknown (local coordinates) counts as 45° north
/// on the meridian of the time zone; `placeKnown` tells.
[[nodiscard]] Lighting lightingOf(const Project& project, const glm::dvec3& center,
                                  bool& placeKnown);

}  // namespace reflet
