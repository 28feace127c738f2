// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/CityGmlImporter.h"

#include "importers/citygml/FeatureReader.h"
#include "importers/citygml/MemberReader.h"
#include "importers/citygml/SurfaceReader.h"
#include "importers/citygml/Survey.h"
#include "importers/common/CityBuilder.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

namespace reflet {

namespace {

using namespace importers;
using namespace citygml;

constexpr std::size_t kBatchBytes = std::size_t(4) << 20;

class CityGmlImport {
public:
    CityGmlImport(Purpose purpose, const ByteSource& source, const std::filesystem::path& path,
                  const ImportOptions& options, const JobContext& job)
        : m_source(source),
          m_subject(path.string()),
          m_job(job),
          m_builder(purpose, path, options, source.size()),
          m_images(path) {}

    Result<Imported<CityImport>> run() {
        auto survey = surveyFile(m_source, m_subject, m_builder.needsWholeExtent(),
                                 m_job.phase("looking through the file", 0.0, 0.3));
        if (!survey)
            return tl::unexpected<Error>(survey.error());
        noteSystems(*survey);
        if (auto placed = m_builder.place(survey->srsName, AxisOrder::OfAuthority, survey->extent);
            !placed)
            return tl::unexpected<Error>(placed.error());
        if (auto read = readMembers(*survey); !read)
            return tl::unexpected<Error>(read.error());
        auto result = m_builder.finish();
        if (result) {
            result->value.summary.format = "CityGML";
            result->value.summary.version = Namespaces(survey->root).version();
        }
        m_job.progress(1.0);
        return result;
    }

private:
    /// Geometries in another CRS than the file's envelope would come to lie at the wrong place.
    void noteSystems(const Survey& survey) {
        const auto horizontal = [](const std::string& name) {
            const auto crs = Crs::parse(name);
            return crs ? crs->horizontal() : name;
        };
        if (!survey.srsName)
            return;
        const std::string first = horizontal(*survey.srsName);
        for (const std::string& name : survey.srsNames) {
            if (horizontal(name) == first)
                continue;
            m_builder.fileDiagnostics().push_back(
                {Severity::Warning, "crs-mixed", "",
                 fmt::format(
                     "some geometries name the coordinate reference system {:.120}; all were "
                     "read as {:.120}",
                     name, *survey.srsName),
                 "Bring the file into one coordinate reference system, e.g. with citygml-tools."});
            return;
        }
    }

    Result<void> readMembers(const Survey& survey) {
        const auto bytes = m_source.again();
        if (!bytes)
            return tl::unexpected<Error>(bytes.error());
        MemberReader reader(**bytes, m_subject);
        if (auto read = reader.readRoot(); !read)
            return read;
        Namespaces namespaces(reader.root());
        FeatureReader features(namespaces);
        const JobContext job = m_job.phase("reading objects", 0.3, 1.0);
        CityPiece batch;
        std::size_t bytesInBatch = 0;
        std::string text;
        for (bool more = true; more;) {
            if (job.cancelled())
                return tl::unexpected<Error>(JobContext::cancelledError());
            const auto any = reader.next(text);
            if (!any)
                return tl::unexpected<Error>(any.error());
            more = *any;
            if (more) {
                bytesInBatch += text.size();
                auto piece = readMember(text, reader.line(), survey, namespaces, features);
                if (!piece)
                    return tl::unexpected<Error>(piece.error());
                append(batch, *std::move(piece));
            }
            if (bytesInBatch < kBatchBytes && more)
                continue;
            if (auto added = addBatch(std::exchange(batch, {})); !added)
                return added;
            bytesInBatch = 0;
            job.progress(double(reader.position()) / double(m_source.size() + 1));
        }
        noteForeign(features.foreignElements());
        return {};
    }

    Result<void> addBatch(CityPiece batch) {
        if (batch.geometry.templateBegin.empty())
            batch.geometry.templateBegin.push_back(0);
        noteTemplates(batch.geometry, batch.report);
        return m_builder.add(std::move(batch), JobContext({}, m_job.stopToken()));
    }

    Result<CityPiece> readMember(std::string& text, std::size_t line, const Survey& survey,
                                 Namespaces& namespaces, FeatureReader& features) {
        const std::string_view name = localNameOfTag(text);
        if (name == "boundedBy" || name == "appearanceMember" || name == "appearance")
            return CityPiece{};
        pugi::xml_document document;
        if (auto parsed = parseMember(text, line, m_subject, document); !parsed)
            return tl::unexpected<Error>(parsed.error());
        namespaces.lookInside(text.find("xmlns") != std::string::npos);
        const pugi::xml_node root = firstElement(document);
        Member member = features.read(root);
        CityPiece piece = m_builder.begin(std::move(member.file));
        const bool looksInside = hasAttribute(text, "href");
        SurfaceReader(root, member,
                      {namespaces, survey.appearances, survey.definitions, m_images, looksInside},
                      piece)
            .read();
        return piece;
    }

    void noteForeign(std::size_t elements) {
        if (elements == 0)
            return;
        m_builder.fileDiagnostics().push_back(
            {Severity::Info, "extensions", "",
             fmt::format("{} elements of extensions (ADE) were passed over", elements), ""});
    }

    const ByteSource& m_source;
    std::string m_subject;
    const JobContext& m_job;
    CityBuilder m_builder;
    ImagePlaces m_images;
};

Result<Imported<CityImport>> runOnFile(Purpose purpose, const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    const auto source = openFile(path, options.maxFileBytes);
    if (!source)
        return tl::unexpected<Error>(source.error());
    return CityGmlImport(purpose, **source, path, options, job).run();
}

}  // namespace

Result<Imported<CityImport>> importCityGml(const std::filesystem::path& path,
                                           const ImportOptions& options, const JobContext& job) {
    return runOnFile(Purpose::Import, path, options, job);
}

Result<Imported<CityImport>> importCityGmlText(std::string_view text,
                                               const std::filesystem::path& path,
                                               const ImportOptions& options,
                                               const JobContext& job) {
    const auto source = openBytes(text);
    return CityGmlImport(Purpose::Import, *source, path, options, job).run();
}

Result<Imported<SourceSummary>> inspectCityGml(const std::filesystem::path& path,
                                               const ImportOptions& options,
                                               const JobContext& job) {
    return summaryOnly(runOnFile(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
