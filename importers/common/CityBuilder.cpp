// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/CityBuilder.h"

#include "importers/common/Instances.h"
#include "importers/common/LodChoice.h"
#include "importers/common/ModelAssembly.h"
#include "importers/common/ObjectSelection.h"
#include "importers/common/Summary.h"
#include "importers/common/TextureFiles.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace reflet::importers {

namespace {

ImportOptions optionsFor(Purpose purpose, ImportOptions options) {
    if (purpose == Purpose::Inspect) {
        options.lod = "all";
        options.frame.reset();
        options.types.clear();
        options.bbox.reset();
        options.strict = false;
    }
    return options;
}

/// Objects whose surfaces need no triangles.
std::vector<bool> withoutUse(const CityPiece& piece) {
    std::vector<bool> without(piece.file.objects.size());
    for (std::uint32_t i = 0; i < without.size(); ++i)
        without[i] = piece.report.leftOut(i) || piece.report.fate(i) == Fate::Skipped;
    return without;
}

std::string keyOf(const CityMaterial& m) {
    return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", m.name, m.diffuse.x, m.diffuse.y,
                       m.diffuse.z, m.emission.x, m.emission.y, m.emission.z, m.shininess,
                       m.transparency, m.tint.x, m.tint.y, m.tint.z);
}

std::uint32_t mapped(const std::vector<std::uint32_t>& map, std::uint32_t index) {
    return index < map.size() ? map[index] : kNone;
}

}  // namespace

/// The stages of one piece.
struct CityBuilder::Work {
    CityPiece piece;
    std::vector<glm::dvec3> source = {};
    std::vector<glm::dvec3> local = {};
    SoupTriangles triangles = {};
    std::vector<TemplateMesh> meshes = {};
    std::vector<PlacedInstance> instances = {};
};

CityBuilder::CityBuilder(Purpose purpose, const std::filesystem::path& path,
                         const ImportOptions& options, std::size_t fileBytes)
    : m_purpose(purpose),
      m_path(path),
      m_subject(path.string()),
      m_options(optionsFor(purpose, options)),
      m_bytes(fileBytes) {}

bool CityBuilder::needsWholeExtent() const {
    return m_purpose == Purpose::Import && !m_options.frame;
}

Result<void> CityBuilder::place(const std::optional<std::string>& declared, AxisOrder order,
                                Extent extent) {
    auto crs =
        sourceCrs(declared, m_options, m_purpose == Purpose::Inspect, m_subject, m_diagnostics);
    if (!crs)
        return tl::unexpected<Error>(crs.error());
    // A format that fixes its CRS fixes the order of its axes, too.
    const std::string asked = m_crsOfFormat ? std::string() : m_options.axisOrder;
    checkAxes(extent.middle(), order, asked, *crs, m_diagnostics);
    m_swapAxes = crs->swapAxes;
    if (m_swapAxes)
        extent.swapAxes();
    m_crs = crs->crs;
    const CrsRule rule = crs->rule;
    auto placement =
        Placement::create(*std::move(crs), extent, m_options, m_subject, m_diagnostics);
    if (!placement)
        return tl::unexpected<Error>(placement.error());
    m_placement = *std::move(placement);
    m_result.value.city.frame = m_placement->frame();
    noteCrs(declared, rule);
    return {};
}

void CityBuilder::noteCrs(const std::optional<std::string>& declared, CrsRule rule) {
    CrsAccount& account = m_result.value.summary.crsAccount;
    const bool ofFormat = m_crsOfFormat && rule == CrsRule::Declared;
    account.rule = ofFormat ? CrsRule::Format : rule;
    if (!m_crsOfFormat)
        account.written = declared;
    account.operation = m_placement->operation();
    account.accuracy = m_placement->accuracy();
}

CityPiece CityBuilder::begin(SourceCity file) {
    CityPiece piece;
    piece.file = std::move(file);
    piece.report = ImportReport(piece.file.objects.size());
    noteOddObjects(piece.file, piece.report);
    piece.tree = makeObjectTree(piece.file.objects, piece.report);
    piece.chosen = selectGeometries(piece.file, piece.tree, m_options, piece.report, m_tallies);
    return piece;
}

Result<void> CityBuilder::add(CityPiece piece, const JobContext& job) {
    Work work{std::move(piece)};
    CityPiece& p = work.piece;
    work.source = sourceVertices(p.file);
    auto local = m_placement->vertices(p.file, work.source, m_swapAxes, job);
    if (!local)
        return tl::unexpected<Error>(local.error());
    if (m_swapAxes) {
        for (glm::dvec3& point : work.source)
            std::swap(point.x, point.y);
    }
    work.local = *std::move(local);
    p.file.vertices = std::vector<glm::dvec3>(0);
    leaveOutUnwanted(p.file, p.tree, p.geometry, p.chosen, work.local, m_placement->frame().origin,
                     m_options, p.report, m_tallies);
    if (auto done = triangulate(work, job); !done)
        return done;
    if (auto done = placeInstances(work, job); !done)
        return done;
    if (job.cancelled())
        return tl::unexpected<Error>(JobContext::cancelledError());
    return take(work);
}

Result<void> CityBuilder::triangulate(Work& work, const JobContext& job) {
    const CityPiece& p = work.piece;
    auto surfaces = triangulateSoup(p.geometry.surfaces, work.local, p.file.textureVertices,
                                    withoutUse(p), m_subject, job.phase("triangulating", 0.1, 0.8));
    if (!surfaces)
        return tl::unexpected<Error>(surfaces.error());
    work.triangles = *std::move(surfaces);
    noteSurfaces(work);
    auto templates = triangulateSoup(
        p.geometry.templates, p.file.templateVertices, p.file.textureVertices,
        std::vector<bool>(p.file.templates.size(), false), m_subject, job.phase("", 0.8, 0.84));
    if (!templates)
        return tl::unexpected<Error>(templates.error());
    work.meshes = templateMeshes(p.file, p.geometry, *templates);
    return {};
}

void CityBuilder::noteSurfaces(Work& work) {
    using State = SoupTriangles::State;
    const SoupTriangles& triangles = work.triangles;
    ImportReport& report = work.piece.report;
    const auto& surfaces = work.piece.geometry.surfaces.surfaces;
    for (const SoupTriangles::Problem& problem : triangles.problems) {
        const bool vertex = triangles.states[problem.surface] == State::BadVertex;
        report.note(surfaces[problem.surface].owner,
                    vertex ? Issue::BadVertex : Issue::DegenerateSurface, problem.text);
    }
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        if (triangles.states[s] == State::Repaired)
            report.note(surfaces[s].owner, Issue::RepairedPolygon);
    }
    m_tallies.notPlanar += triangles.notPlanar;
    if (triangles.notPlanar > 0 && triangles.worstDeviation > m_tallies.worstDeviation) {
        m_tallies.worstDeviation = triangles.worstDeviation;
        m_tallies.worstObject = work.piece.file.objects[surfaces[triangles.worstSurface].owner].id;
    }
}

Result<void> CityBuilder::placeInstances(Work& work, const JobContext& job) {
    if (m_purpose == Purpose::Inspect)
        return {};  // counted, not placed
    CityPiece& p = work.piece;
    const auto& instances = p.geometry.instances;
    const std::vector<bool> without = withoutUse(p);
    auto within = checkInstanceLimit(instances, work.meshes, without, m_bytes, m_subject,
                                     m_instanceTriangles);
    if (!within)
        return within;
    const JobContext phase = job.phase("placing instances", 0.84, 0.95);
    constexpr std::size_t kReport = 256;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const InstanceRecord& instance = instances[i];
        if (i % kReport == 0)
            phase.progress(static_cast<double>(i) / static_cast<double>(instances.size()));
        if (phase.cancelled())
            return {};
        if (without[instance.object])
            continue;
        auto placed =
            placeInstance(instance, work.meshes[instance.templateIndex], *m_placement,
                          work.source[instance.anchor], work.local[instance.anchor], p.report);
        if (!placed)
            return tl::unexpected<Error>(placed.error());
        if (*placed)
            work.instances.push_back(**std::move(placed));
    }
    return {};
}

/// Adds what came of a piece to the result, and its account.
Result<void> CityBuilder::take(Work& work) {
    CityPiece& p = work.piece;
    std::vector<bool> shows(p.file.objects.size(), false);
    for (const SoupTriangles::Triangle& triangle : work.triangles.triangles)
        shows[p.geometry.surfaces.surfaces[triangle.surface].owner] = true;
    if (m_purpose == Purpose::Inspect) {
        for (const InstanceRecord& instance : p.geometry.instances)
            shows[instance.object] = true;
    }
    for (const PlacedInstance& instance : work.instances)
        shows[instance.object] = shows[instance.object] || !instance.points.empty();
    skipWhatShowsNothing(p.file, p.tree, p.chosen, shows, p.report);

    if (m_options.strict && m_firstFault.empty())
        m_firstFault = p.report.firstFault(p.file.objects);
    m_tallies.withoutAppearance = m_tallies.withoutAppearance || p.geometry.withoutAppearance;
    const SummaryParts parts{p.file, p.geometry, p.report, p.chosen, work.source};
    PieceSummary summary = m_purpose == Purpose::Inspect ? summaryOfFile(parts)
                                                         : summaryOfImport(parts, work.triangles);
    for (std::size_t i = 0; i < summary.usedTextures.size(); ++i) {
        if (summary.usedTextures[i])
            m_images.insert(p.file.textures[i].image);
    }
    addSummary(m_result.value.summary, summary.counts);
    const ImportCounts counts = p.report.counts();
    m_result.counts.loaded += counts.loaded;
    m_result.counts.repaired += counts.repaired;
    m_result.counts.skipped += counts.skipped;
    noteRemarked(work);
    for (Diagnostic& diagnostic : p.report.diagnostics(p.file.objects))
        m_result.diagnostics.push_back(std::move(diagnostic));
    addModel(work);
    return {};
}

/// The accounts of the objects whose remarks are about to be added.
void CityBuilder::noteRemarked(const Work& work) {
    const CityPiece& p = work.piece;
    std::vector<std::uint32_t> indices;
    auto accounts = p.report.remarked(p.file.objects, m_result.diagnostics.size(), indices);
    for (std::size_t i = 0; i < accounts.size(); ++i) {
        if (m_purpose == Purpose::Import && accounts[i].result != ObjectResult::Skipped)
            accounts[i].lod = lodOfObject(p.file, p.chosen, indices[i]);
    }
    auto& all = m_result.value.summary.remarked;
    std::move(accounts.begin(), accounts.end(), std::back_inserter(all));
}

void CityBuilder::addModel(Work& work) {
    const CityPiece& p = work.piece;
    const auto textureOf = addTextures(p.file);
    if (m_purpose == Purpose::Inspect)
        return;
    CityModel& city = m_result.value.city;
    const auto materialOf = addMaterials(p.file);
    CityModel model = assembleModel({p.file, p.tree, p.report, p.geometry, p.chosen, work.local,
                                     work.triangles, work.meshes, work.instances});
    for (CitySurface& surface : model.surfaces) {
        surface.material = mapped(materialOf, surface.material);
        surface.texture = mapped(textureOf, surface.texture);
    }
    model.materials.clear();
    model.textures.clear();
    model.frame = city.frame;
    auto next = static_cast<std::uint32_t>(city.objects.size());
    for (std::uint32_t i = 0; i < p.file.objects.size(); ++i) {
        const Fate fate = p.report.fate(i);
        if (fate == Fate::Skipped || fate == Fate::LeftOut)
            continue;
        if (p.file.objects[i].aboveGround)
            m_result.value.aboveGround.push_back(next);
        ++next;
    }
    // append() moves indices on behind the lists that are there: they are the result's already.
    std::vector<CityMaterial> materials = std::exchange(city.materials, {});
    if (city.objects.empty())
        city = std::move(model);
    else
        append(city, model);
    city.materials = std::move(materials);
}

/// Puts the textures of a piece among those of the city: their numbers there. Those of the first
/// piece keep theirs.
std::vector<std::uint32_t> CityBuilder::addTextures(const SourceCity& file) {
    const bool first = m_textures.empty();
    std::vector<std::uint32_t> numbers;
    for (const TextureEntry& texture : file.textures) {
        const auto next = static_cast<std::uint32_t>(m_textures.size());
        const auto [known, isNew] =
            m_textureOf.try_emplace({texture.image, texture.repeat, texture.alpha}, next);
        if (isNew || first)
            m_textures.push_back(texture);
        numbers.push_back(first ? next : known->second);
    }
    return numbers;
}

std::vector<std::uint32_t> CityBuilder::addMaterials(const SourceCity& file) {
    auto& materials = m_result.value.city.materials;
    const bool first = materials.empty();
    std::vector<std::uint32_t> numbers;
    for (const CityMaterial& material : file.materials) {
        const auto next = static_cast<std::uint32_t>(materials.size());
        const auto [known, isNew] = m_materialOf.try_emplace(keyOf(material), next);
        if (isNew || first)
            materials.push_back(material);
        numbers.push_back(first ? next : known->second);
    }
    return numbers;
}

/// What is said once about the whole file.
void CityBuilder::noteTallies() {
    const auto say = [&](Severity severity, const char* code, std::string text,
                         const char* remedy = "") {
        m_diagnostics.push_back({severity, code, "", std::move(text), remedy});
    };
    const Tallies& t = m_tallies;
    if (t.otherTypes > 0)
        say(Severity::Info, "filtered-by-type",
            fmt::format("{} objects of other types were left out", t.otherTypes));
    if (t.offLevel > 0)
        say(Severity::Info, "filtered-by-lod",
            fmt::format("{} objects have nothing at level of detail {} and were left out",
                        t.offLevel, m_options.lod));
    if (t.outOfBox > 0)
        say(Severity::Info, "filtered-by-box",
            fmt::format("{} objects outside the box were left out", t.outOfBox));
    if (t.notPlanar > 0)
        say(Severity::Info, "not-planar",
            fmt::format("{} surfaces are more than 1 cm out of plane, one of {:.80} the most "
                        "with {:.3f} m; their points were kept",
                        t.notPlanar, t.worstObject, t.worstDeviation));
    m_result.value.city.textures = resolveTextures(m_textures, m_path, m_diagnostics);
    if (t.withoutAppearance)
        say(Severity::Warning, "no-appearance",
            "surfaces name textures or materials, but the file lists none; they were loaded "
            "without",
            "Export the file again with its appearance.");
}

Result<Imported<CityImport>> CityBuilder::finish() {
    if (m_tallies.missesLevel(m_options.lod)) {
        return fail(ErrorCode::Usage,
                    fmt::format("has no geometry of level of detail {:.20}", m_options.lod),
                    m_subject, fmt::format("It has: {}.", m_tallies.levels()));
    }
    if (!m_firstFault.empty())
        return fail(ErrorCode::Refused, "is not sound, which --strict asks for: " + m_firstFault,
                    m_subject, "Mend the file, or import it without --strict.");
    noteTallies();
    SourceSummary& summary = m_result.value.summary;
    std::set<std::string> found;
    for (const CityTexture& texture : m_result.value.city.textures) {
        if (!texture.path.empty() && m_images.contains(texture.reference))
            found.insert(texture.reference);
    }
    std::set_difference(m_images.begin(), m_images.end(), found.begin(), found.end(),
                        std::back_inserter(summary.texturesMissing));
    for (ObjectAccount& account : summary.remarked)
        account.firstRemark += m_diagnostics.size();
    summary.texturesReferenced = m_images.size();
    summary.texturesResolved = found.size();
    if (m_crs) {
        summary.crsHorizontal = m_crs->horizontal();
        summary.crsVertical = m_crs->vertical();
    }
    m_result.diagnostics.insert(m_result.diagnostics.begin(),
                                std::make_move_iterator(m_diagnostics.begin()),
                                std::make_move_iterator(m_diagnostics.end()));
    return std::move(m_result);
}

Result<Imported<SourceSummary>> summaryOnly(Result<Imported<CityImport>> result) {
    if (!result)
        return tl::unexpected<Error>(result.error());
    return Imported<SourceSummary>{std::move(result->value.summary), result->counts,
                                   std::move(result->diagnostics)};
}

}  // namespace reflet::importers
