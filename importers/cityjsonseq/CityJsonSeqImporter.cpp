// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjsonseq/CityJsonSeqImporter.h"

#include "importers/cityjson/GeometryReader.h"
#include "importers/cityjsonseq/LineReader.h"
#include "importers/common/CityBuilder.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>

namespace reflet {

namespace {

using namespace importers;
using cityjson::JsonDocument;
using cityjson::JsonValue;
using cityjsonseq::LineReader;

constexpr std::size_t kBatchBytes = std::size_t(4) << 20;

/// A document knows its own text only: its line 1 is line `number` of the file.
std::string inLine(std::size_t number, std::string what) {
    constexpr std::string_view kFirst = "line 1, ";
    if (const std::size_t at = what.find(kFirst); at != std::string::npos)
        return what.replace(at, kFirst.size(), fmt::format("line {}, ", number));
    return fmt::format("{} (line {})", what, number);
}

class SequenceImport {
public:
    SequenceImport(Purpose purpose, ByteSource& source, const std::filesystem::path& path,
                   const ImportOptions& options, const JobContext& job)
        : m_source(source),
          m_subject(path.string()),
          m_job(job),
          m_builder(purpose, path, options, source.size()),
          m_lines(source) {}

    Result<Imported<CityImport>> run() {
        if (auto read = readHeader(); !read)
            return tl::unexpected<Error>(read.error());
        for (bool first = true; !m_atEnd; first = false) {
            auto batch = readBatch();
            if (!batch)
                return tl::unexpected<Error>(batch.error());
            if (first) {
                if (auto placed = place(*batch); !placed)
                    return tl::unexpected<Error>(placed.error());
            }
            auto added = m_builder.add(*std::move(batch), JobContext({}, m_job.stopToken()));
            if (!added)
                return tl::unexpected<Error>(added.error());
            m_job.progress(fraction());
        }
        auto result = m_builder.finish();
        if (result)
            result->counts.skipped += m_badLines;
        m_job.progress(1.0);
        return result;
    }

private:
    [[nodiscard]] double fraction() const {
        return std::min(1.0, double(m_lines.position()) / double(m_source.size() + 1));
    }

    [[nodiscard]] Error inThisLine(Error error) const {
        error.what = inLine(m_lines.number(), std::move(error.what));
        error.subject = m_subject;
        return error;
    }

    Result<void> readHeader() {
        std::string line;
        const auto any = m_lines.next(line);
        if (!any)
            return tl::unexpected<Error>(any.error());
        if (!*any)
            return fail(ErrorCode::Unreadable, "is empty", m_subject, "Check the name.");
        auto document = JsonDocument::open(std::move(line), m_subject);
        if (!document)
            return tl::unexpected<Error>(inThisLine(document.error()));
        auto header = cityjson::readSequenceHeader(*document, m_subject, JobContext());
        if (!header)
            return tl::unexpected<Error>(inThisLine(header.error()));
        if (!header->objects.empty())
            m_builder.fileDiagnostics().push_back(
                {Severity::Warning, "header-objects", "",
                 fmt::format("{} objects stand in the first line, where none belong; they were "
                             "left out",
                             header->objects.size()),
                 "Write them as features, e.g. with cjseq."});
        header->objects.clear();
        header->geometries.clear();
        header->vertices.clear();
        if (!header->transform)
            m_builder.fileDiagnostics().push_back(
                {Severity::Warning, "no-transform", "",
                 "there is no \"transform\" in the first line; the vertices were taken as they are",
                 ""});
        m_header = m_builder.begin(*std::move(header));
        auto geometry =
            cityjson::readCityGeometry(*document, m_header.file, {}, m_header.report, JobContext());
        if (!geometry)
            return tl::unexpected<Error>(inThisLine(geometry.error()));
        m_header.geometry = *std::move(geometry);
        return {};
    }

    /// Features until there are enough bytes; one with a transform of its own begins another batch.
    Result<CityPiece> readBatch() {
        CityPiece batch = m_header;
        std::size_t bytes = 0;
        if (m_waiting) {
            batch.file.transform = m_waiting->file.transform;
            append(batch, *std::exchange(m_waiting, std::nullopt));
        }
        std::string line;
        while (bytes < kBatchBytes) {
            if (m_job.cancelled())
                return tl::unexpected<Error>(JobContext::cancelledError());
            const auto any = m_lines.next(line);
            if (!any)
                return tl::unexpected<Error>(any.error());
            m_atEnd = !*any;
            if (m_atEnd)
                break;
            bytes += line.size();
            auto feature = readFeature(std::move(line));
            if (!feature) {
                noteBadLine(feature.error());
                continue;
            }
            if (!sameTransform(feature->file, batch.file)) {
                m_waiting = *std::move(feature);
                break;
            }
            append(batch, *std::move(feature));
        }
        noteTemplates(batch.geometry, batch.report);
        return batch;
    }

    static bool sameTransform(const SourceCity& a, const SourceCity& b) {
        if (!a.transform || !b.transform)
            return !a.transform == !b.transform;
        return a.transform->scale == b.transform->scale &&
               a.transform->translate == b.transform->translate;
    }

    Result<CityPiece> readFeature(std::string line) {
        auto document = JsonDocument::open(std::move(line), m_subject);
        if (!document)
            return tl::unexpected<Error>(document.error());
        auto file =
            cityjson::readSequenceFeature(*document, m_header.file, m_subject, JobContext());
        if (!file)
            return tl::unexpected<Error>(file.error());
        for (ObjectOutline& object : file->objects)
            object.duplicate = !m_ids.insert(object.id).second || object.duplicate;
        CityPiece piece = m_builder.begin(*std::move(file));
        auto geometry = cityjson::readCityGeometry(*document, piece.file, piece.chosen,
                                                   piece.report, JobContext());
        if (!geometry)
            return tl::unexpected<Error>(geometry.error());
        piece.geometry = *std::move(geometry);
        return piece;
    }

    void noteBadLine(const Error& error) {
        constexpr std::size_t kTold = 100;
        if (++m_badLines <= kTold)
            m_builder.fileDiagnostics().push_back(
                {Severity::Error, "line-unreadable", "",
                 "skipped: " + inLine(m_lines.number(), error.what), "Export the feature again."});
    }

    /// A frame is made from all vertices of the file; a second walk reads nothing else.
    Result<void> place(const CityPiece& first) {
        Extent extent;
        addTo(extent, first);
        if (m_builder.needsWholeExtent() && !m_atEnd) {
            if (auto walked = walkVertices(extent); !walked)
                return walked;
        }
        return m_builder.place(first.file.referenceSystem, AxisOrder::EastNorth, extent);
    }

    Result<void> walkVertices(Extent& extent) {
        const auto second = m_source.again();
        if (!second)
            return tl::unexpected<Error>(second.error());
        LineReader lines(**second);
        std::string line;
        SourceCity file;
        for (;;) {
            const auto any = lines.next(line);
            if (!any)
                return tl::unexpected<Error>(any.error());
            if (!*any)
                return {};
            if (m_job.cancelled())
                return tl::unexpected<Error>(JobContext::cancelledError());
            auto document = JsonDocument::open(std::move(line), m_subject);
            if (!document)
                continue;  // it is reported when it is read
            file.transform = m_header.file.transform;
            file.vertices.clear();
            (void)document->walk(m_job, [&](std::string_view key, JsonValue value) {
                if (key == "vertices")
                    value.points(file.vertices, m_job);
            });
            for (std::size_t v = 0; v < file.vertices.size(); ++v)
                extent.add(sourceVertex(file, v));
        }
    }

    ByteSource& m_source;
    std::string m_subject;
    const JobContext& m_job;
    CityBuilder m_builder;
    LineReader m_lines;
    CityPiece m_header;  ///< without objects
    std::optional<CityPiece> m_waiting;
    std::unordered_set<std::string> m_ids;
    std::size_t m_badLines = 0;
    bool m_atEnd = false;
};

Result<Imported<CityImport>> runOnFile(Purpose purpose, const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    const auto source = openFile(path, options.maxFileBytes);
    if (!source)
        return tl::unexpected<Error>(source.error());
    return SequenceImport(purpose, **source, path, options, job).run();
}

}  // namespace

Result<Imported<CityImport>> importCityJsonSeq(const std::filesystem::path& path,
                                               const ImportOptions& options,
                                               const JobContext& job) {
    return runOnFile(Purpose::Import, path, options, job);
}

Result<Imported<CityImport>> importCityJsonSeqText(std::string_view text,
                                                   const std::filesystem::path& path,
                                                   const ImportOptions& options,
                                                   const JobContext& job) {
    const auto source = openBytes(text);
    return SequenceImport(Purpose::Import, *source, path, options, job).run();
}

Result<Imported<SourceSummary>> inspectCityJsonSeq(const std::filesystem::path& path,
                                                   const ImportOptions& options,
                                                   const JobContext& job) {
    return summaryOnly(runOnFile(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
