// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/CityJsonImporter.h"

#include "importers/cityjson/GeometryReader.h"
#include "importers/common/ByteSource.h"
#include "importers/common/CityBuilder.h"

#include <fmt/core.h>

#include <utility>

namespace reflet {

namespace {

using namespace cityjson;

Result<std::string> textOf(const std::filesystem::path& path, std::size_t limit,
                           const JobContext& job) {
    const auto source = openFile(path, limit);
    if (!source)
        return tl::unexpected<Error>(source.error());
    return readAll(**source, job);
}

void noteTransform(const SourceCity& file, std::vector<Diagnostic>& diagnostics) {
    if (file.transform || file.version.starts_with("1.0"))
        return;
    diagnostics.push_back({Severity::Warning, "no-transform", "",
                           "there is no \"transform\", which this version of CityJSON requires; "
                           "the vertices were taken as they are",
                           ""});
}

/// From bytes to a model. The whole file is one piece: its vertices may come last.
Result<Imported<CityImport>> run(Purpose purpose, std::string text,
                                 const std::filesystem::path& path, const ImportOptions& options,
                                 const JobContext& job) {
    const std::string subject = path.string();
    if (text.size() > options.maxFileBytes) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("is larger than the limit of {} bytes", options.maxFileBytes),
                    subject, "Split it into tiles.");
    }
    CityBuilder builder(purpose, path, options, text.size());
    auto document = JsonDocument::open(std::move(text), subject);
    if (job.cancelled())
        return tl::unexpected<Error>(JobContext::cancelledError());
    if (!document)
        return tl::unexpected<Error>(document.error());
    auto file = readCityJsonFile(*document, subject, job.phase("reading objects", 0.05, 0.3));
    if (!file)
        return tl::unexpected<Error>(file.error());
    CityPiece piece = builder.begin(*std::move(file));
    auto geometry = readCityGeometry(*document, piece.file, piece.chosen, piece.report,
                                     job.phase("reading geometry", 0.3, 0.5));
    if (!geometry)
        return tl::unexpected<Error>(geometry.error());
    piece.geometry = *std::move(geometry);
    document = tl::unexpected<Error>(Error{});  // its memory is of no more use
    noteTransform(piece.file, builder.fileDiagnostics());
    Extent extent;
    addTo(extent, piece);
    if (auto done = builder.place(piece.file.referenceSystem, AxisOrder::EastNorth, extent); !done)
        return tl::unexpected<Error>(done.error());
    if (auto done = builder.add(std::move(piece), job.phase("building", 0.5, 1.0)); !done)
        return tl::unexpected<Error>(done.error());
    auto result = builder.finish();
    job.progress(1.0);
    return result;
}

}  // namespace

Result<Imported<CityImport>> importCityJson(const std::filesystem::path& path,
                                            const ImportOptions& options, const JobContext& job) {
    auto text = textOf(path, options.maxFileBytes, job);
    if (!text)
        return tl::unexpected<Error>(text.error());
    return run(Purpose::Import, *std::move(text), path, options, job);
}

Result<Imported<CityImport>> importCityJsonText(std::string_view text,
                                                const std::filesystem::path& path,
                                                const ImportOptions& options,
                                                const JobContext& job) {
    return run(Purpose::Import, std::string(text), path, options, job);
}

Result<Imported<SourceSummary>> inspectCityJson(const std::filesystem::path& path,
                                                const ImportOptions& options,
                                                const JobContext& job) {
    auto text = textOf(path, options.maxFileBytes, job);
    if (!text)
        return tl::unexpected<Error>(text.error());
    return summaryOnly(run(Purpose::Inspect, *std::move(text), path, options, job));
}

Result<void> parseCityJson(const std::filesystem::path& path, const JobContext& job) {
    auto text = textOf(path, ImportOptions{}.maxFileBytes, job);
    if (!text)
        return tl::unexpected<Error>(text.error());
    const auto document = JsonDocument::open(*std::move(text), path.string());
    if (!document)
        return tl::unexpected<Error>(document.error());
    job.progress(0.5);
    if (auto fault = document->findSyntaxError())
        return tl::unexpected<Error>(*std::move(fault));
    return {};
}

}  // namespace reflet
