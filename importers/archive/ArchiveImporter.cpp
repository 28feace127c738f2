// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/archive/ArchiveImporter.h"

#include "importers/CityFiles.h"
#include "importers/FormatRegistry.h"
#include "importers/archive/UnpackedArchive.h"
#include "importers/common/CityBuilder.h"
#include "importers/common/Summary.h"
#include "importers/terrain/TerrainImporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace reflet {

namespace fs = std::filesystem;

using namespace importers;

namespace {

/// A file of an archive, or several rasters that make one terrain.
struct Part {
    std::vector<fs::path> files;
    bool terrain = false;
};

/// What is in an archive, sorted out.
struct Contents {
    fs::path folder;
    std::vector<Part> parts;
    std::vector<fs::path> pictures;  ///< orthophotos, or textures that say where they lie
    std::vector<Diagnostic> remarks;
};

bool isArchive(const fs::path& path) {
    const auto format = cityFormatOf(path);
    return format && (*format)->read == importArchive;
}

Contents sortOut(CityFiles found, UnpackedArchive unpacked) {
    Contents contents{unpacked.folder, {}, {}, std::move(unpacked.remarks)};
    Part terrain{{}, true};
    std::vector<fs::path> files;
    for (const fs::path& file : found.files) {
        std::error_code ignored;
        const auto rasters = rasterFiles(file);
        if (rasters && fs::is_directory(file, ignored))
            files.insert(files.end(), rasters->begin(), rasters->end());
        else
            files.push_back(file);
    }
    for (const fs::path& file : files) {
        const RasterUse use = rasterUse(file);
        if (use == RasterUse::Terrain) {
            terrain.files.push_back(file);
        } else if (use == RasterUse::Orthophoto) {
            contents.pictures.push_back(file);
        } else if (isArchive(file)) {
            contents.remarks.push_back({Severity::Warning, "archive-nested",
                                        file.lexically_relative(unpacked.folder).string(),
                                        "an archive in an archive was left out",
                                        "Unpack it and import it by itself."});
        } else {
            contents.parts.push_back({{file}, false});
        }
    }
    if (!terrain.files.empty())
        contents.parts.push_back(std::move(terrain));
    std::move(found.remarks.begin(), found.remarks.end(), std::back_inserter(contents.remarks));
    return contents;
}

/// A number of models that become one.
template <class Value>
class Reading {
public:
    Reading(const fs::path& path, const ImportOptions& options, const JobContext& job)
        : m_path(path), m_options(options), m_job(job) {}

    Result<Imported<Value>> run() {
        auto contents = open();
        if (!contents)
            return tl::unexpected(contents.error());
        m_contents = *std::move(contents);
        m_out.diagnostics = std::move(m_contents.remarks);
        for (Diagnostic& remark : m_out.diagnostics) {
            if (remark.object == m_contents.folder.string())
                remark.object = m_path.filename().string();
        }
        const auto count = double(m_contents.parts.size());
        for (std::size_t i = 0; i < m_contents.parts.size(); ++i) {
            const double first = kUnpacking + (1.0 - kUnpacking) * double(i) / count;
            const double next = kUnpacking + (1.0 - kUnpacking) * double(i + 1) / count;
            const Part& part = m_contents.parts[i];
            if (auto read = add(part, m_job.phase(nameOf(part.files.front()), first, next)); !read)
                return tl::unexpected(read.error());
        }
        return finish();
    }

private:
    static constexpr double kUnpacking = 0.3;  // of the progress

    Result<Contents> open() {
        ArchiveLimits limits;
        limits.maxEntryBytes = m_options.maxFileBytes;
        auto unpacked = unpackArchive(m_path, limits, m_job.phase("unpacking", 0.0, kUnpacking));
        if (!unpacked)
            return tl::unexpected(unpacked.error());
        auto found = cityFilesIn(unpacked->folder, m_job);
        if (!found) {
            Error error = found.error();
            if (error.code == ErrorCode::Unreadable && !unpacked->remarks.empty())
                error.remedy = fmt::format("{}: {}", unpacked->remarks.front().text,
                                           unpacked->remarks.front().remedy);
            return tl::unexpected(own(std::move(error)));
        }
        return sortOut(*std::move(found), *std::move(unpacked));
    }

    /// Messages name the file as the user knows it.
    [[nodiscard]] Error own(Error error) const {
        const fs::path subject = error.subject;
        const bool inside = subject.is_absolute() && !m_contents.folder.empty();
        const fs::path name = inside ? subject.lexically_relative(m_contents.folder) : fs::path();
        error.subject = m_path.string();
        if (!name.empty() && !name.string().starts_with(".."))
            error.subject += ": " + name.string();
        return error;
    }

    [[nodiscard]] std::string nameOf(const fs::path& file) const {
        return file.lexically_relative(m_contents.folder).string();
    }

    Result<Imported<Value>> read(const Part& part, const JobContext& job) const;
    void merge(Imported<Value>& part);

    Result<void> add(const Part& part, const JobContext& job) {
        auto imported = read(part, job);
        const std::string name = nameOf(part.files.front());
        if (!imported) {
            const Error error = own(imported.error());
            const bool goesOn =
                error.code == ErrorCode::Unreadable || error.code == ErrorCode::Refused;
            if (!goesOn || m_options.strict || m_contents.parts.size() == 1)
                return tl::unexpected(error);
            m_lastError = error;
            m_out.diagnostics.push_back({Severity::Error, "file-skipped", name,
                                         error.what + "; the file was left out", error.remedy});
            return {};
        }
        m_partRemarks = m_out.diagnostics.size();
        for (Diagnostic& diagnostic : imported->diagnostics) {
            if (diagnostic.object.empty())
                diagnostic.object = name;
            m_out.diagnostics.push_back(std::move(diagnostic));
        }
        m_out.counts.loaded += imported->counts.loaded;
        m_out.counts.repaired += imported->counts.repaired;
        m_out.counts.skipped += imported->counts.skipped;
        merge(*imported);
        m_any = true;
        return {};
    }

    void addSource(SourceSummary& sum, const SourceSummary& part) {
        m_formats.insert(part.format);
        m_versions.insert(part.version);
        addSummary(sum, part);
        sum.texturesReferenced += part.texturesReferenced;
        sum.texturesResolved += part.texturesResolved;
        sum.texturesMissing.insert(sum.texturesMissing.end(), part.texturesMissing.begin(),
                                   part.texturesMissing.end());
        for (ObjectAccount account : part.remarked) {
            account.firstRemark += m_partRemarks;
            sum.remarked.push_back(std::move(account));
        }
        if (!m_any) {
            sum.crsAccount = part.crsAccount;
            sum.crsHorizontal = part.crsHorizontal;
            sum.crsVertical = part.crsVertical;
        }
        if (sum.crsHorizontal != part.crsHorizontal)
            sum.crsHorizontal.reset();
        if (sum.crsVertical != part.crsVertical)
            sum.crsVertical.reset();
    }
    [[nodiscard]] SourceSummary& summary();
    [[nodiscard]] std::size_t orthophotos() const;

    Result<Imported<Value>> finish() {
        if (!m_any && m_lastError)
            return tl::unexpected(*m_lastError);
        if (!m_any)
            return fail(ErrorCode::Unreadable, "has no city models in it", m_path.string(),
                        "Archives in the archive are not opened: unpack it and import the folder.");
        summary().format = fmt::format("ZIP archive of {}", fmt::join(m_formats, " and "));
        summary().version = fmt::format("{}", fmt::join(m_versions, ", "));
        if (const std::size_t count = orthophotos(); count > 0)
            m_out.diagnostics.push_back(
                {Severity::Warning, "archive-orthophoto", m_path.filename().string(),
                 fmt::format("{} orthophotos in the archive are not laid on the ground", count),
                 "Unpack them and name them with --ortho, or drop them into the window."});
        return std::move(m_out);
    }

    const fs::path& m_path;
    const ImportOptions& m_options;
    const JobContext& m_job;
    Contents m_contents;
    Imported<Value> m_out;
    std::optional<Error> m_lastError;
    bool m_any = false;
    std::size_t m_partRemarks = 0;  ///< where those of the part begin
    std::set<std::string> m_formats, m_versions;
};

// ---- import ----

template <>
Result<Imported<CityImport>> Reading<CityImport>::read(const Part& part,
                                                       const JobContext& job) const {
    ImportOptions options = m_options;
    if (m_any)
        options.frame = m_out.value.city.frame;
    if (part.terrain)
        return importTerrain(part.files, options, {}, job);
    const auto format = cityFormatOf(part.files.front());
    if (!format)
        return tl::unexpected(format.error());
    return (*format)->read(part.files.front(), options, job);
}

template <>
void Reading<CityImport>::merge(Imported<CityImport>& part) {
    CityImport& value = m_out.value;
    if (!m_any)
        value.city.frame = part.value.city.frame;
    const auto first = std::uint32_t(value.city.objects.size());
    for (const std::uint32_t object : part.value.aboveGround)
        value.aboveGround.push_back(first + object);
    append(value.city, part.value.city);
    addSource(value.summary, part.value.summary);
}

template <>
SourceSummary& Reading<CityImport>::summary() {
    return m_out.value.summary;
}

/// A picture that a model names is on one of its walls.
template <>
std::size_t Reading<CityImport>::orthophotos() const {
    std::set<std::string> named;
    for (const CityTexture& texture : m_out.value.city.textures)
        named.insert(fs::path(texture.path).lexically_normal().string());
    return std::size_t(
        std::count_if(m_contents.pictures.begin(), m_contents.pictures.end(),
                      [&](const fs::path& picture) { return !named.contains(picture.string()); }));
}

// ---- inspection ----

template <>
Result<Imported<SourceSummary>> Reading<SourceSummary>::read(const Part& part,
                                                             const JobContext& job) const {
    if (part.terrain)
        return summaryOnly(importTerrain(part.files, m_options, {}, job));
    const auto format = cityFormatOf(part.files.front());
    if (!format)
        return tl::unexpected(format.error());
    return (*format)->inspect(part.files.front(), m_options, job);
}

template <>
void Reading<SourceSummary>::merge(Imported<SourceSummary>& part) {
    addSource(m_out.value, part.value);
}

template <>
SourceSummary& Reading<SourceSummary>::summary() {
    return m_out.value;
}

template <>
std::size_t Reading<SourceSummary>::orthophotos() const {
    return 0;
}

}  // namespace

Result<Imported<CityImport>> importArchive(const fs::path& path, const ImportOptions& options,
                                           const JobContext& job) {
    return Reading<CityImport>(path, options, job).run();
}

Result<Imported<SourceSummary>> inspectArchive(const fs::path& path, const ImportOptions& options,
                                               const JobContext& job) {
    return Reading<SourceSummary>(path, options, job).run();
}

}  // namespace reflet
