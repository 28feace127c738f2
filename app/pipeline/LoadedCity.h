// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/ContentHash.h"
#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/project/Project.h"
#include "importers/ImportTypes.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

inline constexpr double kGeneratedGroundMargin = 100.0;  ///< metres beyond the outermost buildings

/// What came of one source file.
struct FileReport {
    std::string file;
    SourceSummary summary;
    ImportCounts counts;
    std::vector<Diagnostic> diagnostics;
    double seconds = 0.0;        ///< that reading took
    std::size_t peakMemory = 0;  ///< bytes, the most that the process had until then; 0 = unknown
    /// Its objects in LoadedCity::city: one behind the other.
    std::uint32_t firstObject = 0, objectCount = 0;

    /// The account of the object that a remark is about; null for remarks on the file.
    [[nodiscard]] const ObjectAccount* accountOf(std::size_t remark) const;
};

/// How the buildings stand on the terrain.
struct GroundFit {
    double median = 0.0;  ///< metres that their bases lie above it; negative: below
    std::size_t buildings = 0;
};

/// Times the reading of a file.
class ReadingClock {
public:
    /// The seconds since it was made, and the memory, into the report.
    void note(FileReport& report) const;

private:
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

/// All models of a project as one city in the project's frame.
struct LoadedCity {
    CityModel city;
    std::vector<FileReport> files;
    std::vector<std::uint32_t> aboveGround;  ///< objects to be draped, as CityImport::aboveGround
    bool generatedGround = false;            ///< no file had terrain and one was interpolated
    /// ContentHash over everything that the city depends on: bytes of models and textures, options.
    std::string contentHash;
    std::vector<Diagnostic> remarks;  ///< models that are no longer as they were imported
    std::optional<GroundFit> groundFit = {};
};

/// Reads a file of any format that Reflet knows; the content decides. Unreadable for the rest, with
/// the formats that are known.
[[nodiscard]] Result<Imported<CityImport>> importFile(const std::filesystem::path& path,
                                                      const ImportOptions& options,
                                                      const JobContext& job);
/// What is in the file, in its own CRS, all levels of detail counted together.
[[nodiscard]] Result<Imported<SourceSummary>> inspectFile(const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);

/// Reads the models of a project whose file lies in `folder`. A missing model is Unreadable, with
/// the path that was looked for.
[[nodiscard]] Result<LoadedCity> loadCity(const Project& project,
                                          const std::filesystem::path& folder,
                                          const JobContext& job);

/// Puts a city together from models one by one: what loadCity() does once they are read, for those
/// who have read them already.
class CityAssembly {
public:
    /// Adds a city model, read from `path` in the frame of those before it. `bytes`: fileHash().
    void add(const ModelReference& model, const std::filesystem::path& path,
             const std::string& bytes, Imported<CityImport> imported, const ReadingClock& clock);
    /// The models so far, as one.
    [[nodiscard]] const CityModel& city() const { return m_loaded.city; }
    /// The frame of the models so far; nullopt before the first.
    [[nodiscard]] const std::optional<ProjectFrame>& frame() const { return m_frame; }
    /// Adds what lies under the models: terrain, ground where it is generated, orthophotos. Once,
    /// at the end. The frame is that of `options`, else that of the models, else that of the first
    /// raster.
    [[nodiscard]] Result<LoadedCity> finish(const Project& project,
                                            const std::filesystem::path& folder,
                                            ImportOptions options, const JobContext& job);

private:
    LoadedCity m_loaded;
    std::optional<ProjectFrame> m_frame;
    struct Source {
        ModelReference model;
        std::string bytes;                  ///< hash of the file
        std::vector<std::string> textures;  ///< hashes of the images
    };
    std::vector<Source> m_sources;
};

/// Whether two projects (with their folders) make the same city of the same files.
[[nodiscard]] bool readsAlike(const Project& a, const std::filesystem::path& folderOfA,
                              const Project& b, const std::filesystem::path& folderOfB);

/// The project with a model that was moved: `model` is its path as the project has it. Unreadable
/// when the new file cannot be read. A file of other bytes is taken as it is: the maps become
/// stale.
[[nodiscard]] Result<Project> relocateModel(Project project, const std::string& model,
                                            const std::filesystem::path& newFile,
                                            const std::filesystem::path& folder);
/// The project with the hashes of its models' files as they are now, so that no remark is made
/// about their change any more.
[[nodiscard]] Result<Project> acceptChangedModels(Project project,
                                                  const std::filesystem::path& folder);

/// How a model of a project is read into its frame.
[[nodiscard]] ImportOptions importOptionsOf(const ModelReference& model, const ProjectFrame& frame);
/// Reads a model by `read` and puts it where its placement says: a local one is read in a frame of
/// its own first, because sums with the project's origin must not be made in float.
[[nodiscard]] Result<Imported<CityImport>> importPlaced(
    const ModelReference& model, const ImportOptions& options,
    const std::function<Result<Imported<CityImport>>(const ImportOptions&)>& read);

/// Adds how a model is read besides its bytes to a hash.
void addReading(ContentHash& hash, const ModelReference& model);
/// What to say of a model whose bytes are not those that were imported.
[[nodiscard]] Diagnostic changedModel(const std::string& file);

/// Hex ContentHash of a file's bytes; of a folder, of the names and bytes of the rasters in it;
/// of a shapefile, of its attributes and CRS too; of an OBJ file, of the materials of its name;
/// of a tileset.json, of the names and sizes of the tiles below its folder.
[[nodiscard]] Result<std::string> fileHash(const std::filesystem::path& path);

/// The path of a model of the project, made absolute.
[[nodiscard]] std::filesystem::path modelPath(const ModelReference& model,
                                              const std::filesystem::path& folder);

}  // namespace reflet
