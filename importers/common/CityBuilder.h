// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"
#include "importers/common/CityPiece.h"
#include "importers/common/Extent.h"
#include "importers/common/Placement.h"
#include "importers/common/SourceCrs.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace reflet::importers {

enum class Purpose { Import, Inspect };

/// What every format does once its bytes are understood: chooses, places, triangulates and
/// assembles, piece by piece, and accounts for every object. Each step returns the error that ends
/// the import. Use: place() once, before the first add(); for each piece begin(), then fill its
/// geometry, then add(); at the end finish().
class CityBuilder {
public:
    /// `fileBytes` bounds what instances may blow up to. For an inspection the options that choose
    /// a part of the file are set aside. `path` lives as long as the builder.
    CityBuilder(Purpose purpose, const std::filesystem::path& path, const ImportOptions& options,
                std::size_t fileBytes);

    [[nodiscard]] Purpose purpose() const { return m_purpose; }
    [[nodiscard]] const ImportOptions& options() const { return m_options; }
    /// Of the file, once place() has found it; nullopt = metres.
    [[nodiscard]] const std::optional<Crs>& crs() const { return m_crs; }
    /// The frame has to be made from where the points lie; else any of them will do.
    [[nodiscard]] bool needsWholeExtent() const;
    [[nodiscard]] std::vector<Diagnostic>& fileDiagnostics() { return m_diagnostics; }

    /// What place() is told as declared is not of the file but of its format.
    void crsIsOfFormat() { m_crsOfFormat = true; }
    /// Finds the CRS and the frame. `declared`: the CRS as the file has it.
    [[nodiscard]] Result<void> place(const std::optional<std::string>& declared, AxisOrder order,
                                     Extent extent);
    /// Links the objects and chooses among their geometries.
    [[nodiscard]] CityPiece begin(SourceCity file);
    [[nodiscard]] Result<void> add(CityPiece piece, const JobContext& job);
    [[nodiscard]] Result<Imported<CityImport>> finish();

private:
    struct Work;
    void noteSurfaces(Work& work);
    [[nodiscard]] Result<void> triangulate(Work& work, const JobContext& job);
    [[nodiscard]] Result<void> placeInstances(Work& work, const JobContext& job);
    [[nodiscard]] Result<void> take(Work& work);
    void addModel(Work& work);
    [[nodiscard]] std::vector<std::uint32_t> addTextures(const SourceCity& file);
    [[nodiscard]] std::vector<std::uint32_t> addMaterials(const SourceCity& file);
    void noteTallies();

    Purpose m_purpose;
    const std::filesystem::path& m_path;
    std::string m_subject;
    ImportOptions m_options;
    std::size_t m_bytes;

    void noteCrs(const std::optional<std::string>& declared, CrsRule rule);
    void noteRemarked(const Work& work);

    bool m_swapAxes = false;
    bool m_crsOfFormat = false;
    std::optional<Crs> m_crs;
    std::optional<Placement> m_placement;

    Imported<CityImport> m_result;
    std::vector<Diagnostic> m_diagnostics;  ///< about the file
    std::string m_firstFault;
    Tallies m_tallies;
    std::size_t m_instanceTriangles = 0;
    std::vector<TextureEntry> m_textures;
    std::map<std::tuple<std::string, bool, TextureAlpha>, std::uint32_t> m_textureOf;
    std::set<std::string> m_images;  ///< names of the images that count in the summary
    std::unordered_map<std::string, std::uint32_t> m_materialOf;
};

/// What an inspection hands on.
[[nodiscard]] Result<Imported<SourceSummary>> summaryOnly(Result<Imported<CityImport>> result);

}  // namespace reflet::importers
