// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/CityJsonImporter.h"

#include "core/base/Files.h"
#include "importers/cityjson/GeometryReader.h"
#include "importers/common/Instances.h"
#include "importers/common/LodChoice.h"
#include "importers/common/ModelAssembly.h"
#include "importers/common/ObjectSelection.h"
#include "importers/common/Placement.h"
#include "importers/common/SoupTriangulation.h"
#include "importers/common/SourceCrs.h"
#include "importers/common/Summary.h"
#include "importers/common/TextureFiles.h"

#include <fmt/core.h>

#include <limits>
#include <optional>
#include <utility>

namespace reflet {

namespace {

using namespace cityjson;

enum class Purpose { Import, Inspect };

/// One import from bytes to model. The members are the stages' results, in the order in which they
/// come about; each stage returns the error that ends the import.
class Import {
public:
    Import(Purpose purpose, const std::filesystem::path& path, const ImportOptions& options,
           const JobContext& job)
        : m_purpose(purpose),
          m_path(path),
          m_subject(path.string()),
          m_options(options),
          m_job(job) {}

    Result<Imported<CityImport>> run(std::string text) {
        for (const auto stage : {&Import::readFile, &Import::readGeometry, &Import::place,
                                 &Import::triangulate, &Import::placeInstances}) {
            if (auto done = (this->*stage)(text); !done)
                return tl::unexpected<Error>(done.error());
            if (m_job.cancelled())
                return tl::unexpected<Error>(JobContext::cancelledError());
        }
        return finish();
    }

private:
    Result<void> readFile(std::string& text);
    Result<void> readGeometry(std::string&);
    Result<void> place(std::string&);
    Result<void> triangulate(std::string&);
    Result<void> placeInstances(std::string&);
    Result<Imported<CityImport>> finish();

    void noteSurfaces();
    void noteOutOfPlane();
    void noteTextures();
    [[nodiscard]] std::vector<bool> withoutUse() const;

    Purpose m_purpose;
    const std::filesystem::path& m_path;
    std::string m_subject;
    const ImportOptions& m_options;
    const JobContext& m_job;

    std::optional<JsonDocument> m_document;
    std::size_t m_bytes = 0;
    SourceCity m_file;
    ImportReport m_report{0};
    ObjectTree m_tree;
    std::vector<bool> m_chosen;
    CityGeometry m_geometry;
    std::vector<glm::dvec3> m_source;
    std::vector<glm::dvec3> m_local;
    std::optional<Crs> m_crs;
    std::optional<Placement> m_placement;
    std::vector<CityTexture> m_textures;
    SoupTriangles m_triangles;
    std::vector<TemplateMesh> m_meshes;
    std::vector<PlacedInstance> m_instances;
};

Result<void> Import::readFile(std::string& text) {
    m_bytes = text.size();
    auto document = JsonDocument::open(std::move(text), m_subject);
    if (!document)
        return tl::unexpected<Error>(document.error());
    m_document = *std::move(document);
    auto file = readCityJsonFile(*m_document, m_subject, m_job.phase("reading objects", 0.05, 0.3));
    if (!file)
        return tl::unexpected<Error>(file.error());
    m_file = *std::move(file);
    return {};
}

Result<void> Import::readGeometry(std::string&) {
    m_report = ImportReport(m_file.objects.size());
    noteOddObjects(m_file, m_report);
    m_tree = makeObjectTree(m_file.objects, m_report);
    auto chosen = selectGeometries(m_file, m_tree, m_options, m_subject, m_report);
    if (!chosen)
        return tl::unexpected<Error>(chosen.error());
    m_chosen = *std::move(chosen);
    auto geometry = readCityGeometry(*m_document, m_file, m_chosen, m_report,
                                     m_job.phase("reading geometry", 0.3, 0.5));
    if (!geometry)
        return tl::unexpected<Error>(geometry.error());
    m_geometry = *std::move(geometry);
    m_document.reset();
    return {};
}

Result<void> Import::place(std::string&) {
    m_job.phase("placing", 0.5, 0.55).progress(0.0);
    auto& diagnostics = m_report.fileDiagnostics();
    auto crs = sourceCrs(m_file, m_options, m_purpose == Purpose::Inspect, m_subject, diagnostics);
    if (!crs)
        return tl::unexpected<Error>(crs.error());
    m_source = sourceVertices(m_file);
    std::vector<bool> used = m_geometry.usedBySurface;
    for (const InstanceRecord& instance : m_geometry.instances)
        used[instance.anchor] = true;
    std::vector<Diagnostic> once;  // the placement will say it again
    checkAxes(centreOf(m_source, used, std::numeric_limits<double>::infinity(), once), *crs,
              diagnostics);
    if (crs->swapAxes) {
        for (glm::dvec3& p : m_source)
            std::swap(p.x, p.y);
    }
    m_crs = crs->crs;
    auto placement = Placement::create(m_file, *std::move(crs), m_source, used, m_options,
                                       m_subject, diagnostics);
    if (!placement)
        return tl::unexpected<Error>(placement.error());
    m_placement = *std::move(placement);
    auto local = m_placement->vertices(m_file, m_source, m_job);
    if (!local)
        return tl::unexpected<Error>(local.error());
    m_local = *std::move(local);
    m_file.vertices = std::vector<glm::dvec3>(0);
    leaveOutUnwanted(m_file, m_tree, m_geometry, m_chosen, m_local, m_placement->frame().origin,
                     m_options, m_report);
    return {};
}

/// Objects whose surfaces need no triangles.
std::vector<bool> Import::withoutUse() const {
    std::vector<bool> without(m_file.objects.size());
    for (std::uint32_t i = 0; i < without.size(); ++i)
        without[i] = m_report.leftOut(i) || m_report.fate(i) == Fate::Skipped;
    return without;
}

Result<void> Import::triangulate(std::string&) {
    auto surfaces =
        triangulateSoup(m_geometry.surfaces, m_local, m_file.textureVertices, withoutUse(),
                        m_subject, m_job.phase("triangulating", 0.55, 0.9));
    if (!surfaces)
        return tl::unexpected<Error>(surfaces.error());
    m_triangles = *std::move(surfaces);
    noteSurfaces();
    noteOutOfPlane();
    auto templates =
        triangulateSoup(m_geometry.templates, m_file.templateVertices, m_file.textureVertices,
                        std::vector<bool>(m_file.templates.size(), false), m_subject,
                        m_job.phase("triangulating templates", 0.9, 0.92));
    if (!templates)
        return tl::unexpected<Error>(templates.error());
    m_meshes = templateMeshes(m_file, m_geometry, *templates);
    return {};
}

void Import::noteSurfaces() {
    using State = SoupTriangles::State;
    const auto& surfaces = m_geometry.surfaces.surfaces;
    for (const SoupTriangles::Problem& problem : m_triangles.problems) {
        const bool vertex = m_triangles.states[problem.surface] == State::BadVertex;
        m_report.note(surfaces[problem.surface].owner,
                      vertex ? Issue::BadVertex : Issue::DegenerateSurface, problem.text);
    }
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        if (m_triangles.states[s] == State::Repaired)
            m_report.note(surfaces[s].owner, Issue::RepairedPolygon);
    }
}

void Import::noteOutOfPlane() {
    if (m_triangles.notPlanar == 0)
        return;
    const auto& worst = m_geometry.surfaces.surfaces[m_triangles.worstSurface];
    m_report.file(
        {Severity::Info, "not-planar", "",
         fmt::format("{} surfaces are more than 1 cm out of plane, one of {:.80} the most "
                     "with {:.3f} m; their points were kept",
                     m_triangles.notPlanar, m_file.objects[worst.owner].id,
                     m_triangles.worstDeviation),
         ""});
}

Result<void> Import::placeInstances(std::string&) {
    if (m_purpose == Purpose::Inspect)
        return {};  // counted, not placed
    const std::vector<bool> without = withoutUse();
    auto within = checkInstanceLimit(m_geometry.instances, m_meshes, without, m_bytes, m_subject);
    if (!within)
        return within;
    const JobContext job = m_job.phase("placing instances", 0.92, 0.97);
    constexpr std::size_t kReport = 256;
    for (std::size_t i = 0; i < m_geometry.instances.size(); ++i) {
        const InstanceRecord& instance = m_geometry.instances[i];
        if (i % kReport == 0)
            job.progress(static_cast<double>(i) / static_cast<double>(m_geometry.instances.size()));
        if (job.cancelled())
            return {};
        if (without[instance.object])
            continue;
        auto placed = placeInstance(instance, m_meshes[instance.templateIndex], *m_placement,
                                    m_source[instance.anchor], m_local[instance.anchor], m_report);
        if (!placed)
            return tl::unexpected<Error>(placed.error());
        if (*placed)
            m_instances.push_back(**std::move(placed));
    }
    return {};
}

void Import::noteTextures() {
    m_textures = resolveTextures(m_file.textures, m_path, m_report.fileDiagnostics());
    if (m_geometry.withoutAppearance)
        m_report.file({Severity::Warning, "no-appearance", "",
                       "surfaces name textures or materials, but the file lists none; they were "
                       "loaded without",
                       "Export the file again with its appearance."});
}

Result<Imported<CityImport>> Import::finish() {
    noteTextures();
    std::vector<bool> shows(m_file.objects.size(), false);
    for (const SoupTriangles::Triangle& triangle : m_triangles.triangles)
        shows[m_geometry.surfaces.surfaces[triangle.surface].owner] = true;
    if (m_purpose == Purpose::Inspect) {
        for (const InstanceRecord& instance : m_geometry.instances)
            shows[instance.object] = true;
    }
    for (const PlacedInstance& instance : m_instances)
        shows[instance.object] = shows[instance.object] || !instance.points.empty();
    skipWhatShowsNothing(m_file, m_chosen, shows, m_report);

    if (m_options.strict) {
        const std::string fault = m_report.firstFault(m_file.objects);
        if (!fault.empty())
            return fail(ErrorCode::Refused, "is not sound, which --strict asks for: " + fault,
                        m_subject, "Mend the file, or import it without --strict.");
    }
    Imported<CityImport> result;
    const SummaryParts parts{m_file, m_geometry, m_report, m_chosen, m_source, m_textures};
    if (m_purpose == Purpose::Inspect) {
        result.value.summary = summaryOfFile(parts);
    } else {
        result.value.summary = summaryOfImport(parts, m_triangles);
        result.value.city = assembleModel({m_file, m_tree, m_report, m_geometry, m_chosen, m_local,
                                           m_triangles, m_meshes, m_instances});
        result.value.city.frame = m_placement->frame();
        result.value.city.textures = std::move(m_textures);
    }
    if (m_crs) {
        result.value.summary.crsHorizontal = m_crs->horizontal();
        result.value.summary.crsVertical = m_crs->vertical();
    }
    result.counts = m_report.counts();
    result.diagnostics = m_report.diagnostics(m_file.objects);
    m_job.progress(1.0);
    return result;
}

Result<Imported<CityImport>> runImport(Purpose purpose, std::string text,
                                       const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    if (text.size() > options.maxFileBytes) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("is larger than the limit of {} bytes", options.maxFileBytes),
                    path.string(), "Split it into tiles.");
    }
    return Import(purpose, path, options, job).run(std::move(text));
}

}  // namespace

Result<Imported<CityImport>> importCityJson(const std::filesystem::path& path,
                                            const ImportOptions& options, const JobContext& job) {
    auto text = readFile(path, options.maxFileBytes);
    if (!text)
        return tl::unexpected<Error>(text.error());
    return runImport(Purpose::Import, *std::move(text), path, options, job);
}

Result<Imported<CityImport>> importCityJsonText(std::string_view text,
                                                const std::filesystem::path& path,
                                                const ImportOptions& options,
                                                const JobContext& job) {
    return runImport(Purpose::Import, std::string(text), path, options, job);
}

Result<Imported<SourceSummary>> inspectCityJson(const std::filesystem::path& path,
                                                const ImportOptions& options,
                                                const JobContext& job) {
    auto text = readFile(path, options.maxFileBytes);
    if (!text)
        return tl::unexpected<Error>(text.error());
    ImportOptions whole = options;
    whole.lod = "all";
    whole.frame.reset();
    whole.types.clear();
    whole.bbox.reset();
    whole.strict = false;
    auto result = runImport(Purpose::Inspect, *std::move(text), path, whole, job);
    if (!result)
        return tl::unexpected<Error>(result.error());
    return Imported<SourceSummary>{std::move(result->value.summary), result->counts,
                                   std::move(result->diagnostics)};
}

}  // namespace reflet
