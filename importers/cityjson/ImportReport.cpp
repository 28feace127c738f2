// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/ImportReport.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace reflet::cityjson {

namespace {

struct IssueText {
    Issue issue;
    Severity severity;
    const char* code;
    Fate fate;
    const char* text;  ///< {0}: number of cases, {1}: detail of the first
    const char* remedy;
};

using I = Issue;
constexpr const char* kExport = "Export the object again, or check the file with cjval.";
constexpr const char* kGeometry = "Check the object's geometry with val3dity.";

constexpr std::array<IssueText, 24> kTexts{{
    {I::NotAnObject, Severity::Error, "not-an-object", Fate::Skipped,
     "is no JSON object and was skipped", kExport},
    {I::DuplicateId, Severity::Error, "duplicate-id", Fate::Skipped,
     "has the id of an earlier object and was skipped", "Give each city object an id of its own."},
    {I::NoType, Severity::Warning, "no-type", Fate::Repaired,
     "has no type and was loaded as an object of unknown kind", kExport},
    {I::UnknownType, Severity::Info, "unknown-type", Fate::Loaded,
     "has the type {1}, which CityJSON does not define, and was loaded as an object of unknown "
     "kind",
     ""},
    {I::ParentMissing, Severity::Warning, "parent-missing", Fate::Loaded,
     "names a parent that is not in the file: {1}", kExport},
    {I::ParentCycle, Severity::Warning, "parent-cycle", Fate::Repaired,
     "is its own ancestor; it was loaded without a parent", kExport},
    {I::NoGeometry, Severity::Info, "no-geometry", Fate::Loaded, "has no geometry", ""},
    {I::NoSurfaces, Severity::Info, "no-surfaces", Fate::Loaded,
     "has points or lines only, which show nothing", ""},
    {I::BadGeometry, Severity::Warning, "bad-geometry", Fate::Repaired,
     "{0} geometries could not be read: {1}", kExport},
    {I::UnknownGeometryType, Severity::Warning, "unknown-geometry-type", Fate::Repaired,
     "{0} geometries of a type that CityJSON does not define were left out: {1}", kExport},
    {I::EmptyGeometry, Severity::Warning, "empty-geometry", Fate::Repaired,
     "{0} solids, shells or geometries have no surface", kGeometry},
    {I::IndexOutOfRange, Severity::Warning, "index-out-of-range", Fate::Repaired,
     "{0} surfaces use a vertex that does not exist and were left out: {1}", kExport},
    {I::BadVertex, Severity::Error, "bad-vertex", Fate::Skipped,
     "uses {1}, which is no usable point, and was skipped", kExport},
    {I::DegenerateSurface, Severity::Warning, "degenerate-surface", Fate::Repaired,
     "{0} surfaces enclose no area and were left out: {1}", kGeometry},
    {I::RepairedPolygon, Severity::Info, "polygon-repaired", Fate::Repaired,
     "{0} surfaces with repeated points, crossing edges or odd rings were mended", kGeometry},
    {I::SemanticsBroken, Severity::Warning, "semantics-malformed", Fate::Repaired,
     "semantics of {0} geometries do not fit their surfaces: {1}", kExport},
    {I::SemanticsIndex, Severity::Warning, "semantics-index-out-of-range", Fate::Repaired,
     "{0} surfaces name semantics that do not exist: {1}", kExport},
    {I::MaterialBroken, Severity::Warning, "material-malformed", Fate::Repaired,
     "materials of {0} geometries do not fit their surfaces: {1}", kExport},
    {I::MaterialIndex, Severity::Warning, "material-index-out-of-range", Fate::Repaired,
     "{0} surfaces name a material that does not exist and have none: {1}", kExport},
    {I::TextureBroken, Severity::Warning, "texture-malformed", Fate::Repaired,
     "textures of {0} surfaces do not fit their rings and were left out: {1}", kExport},
    {I::TextureIndex, Severity::Warning, "texture-index-out-of-range", Fate::Repaired,
     "{0} surfaces name a texture or texture coordinate that does not exist and have none: {1}",
     kExport},
    {I::NoTemplate, Severity::Warning, "template-out-of-range", Fate::Repaired,
     "{0} instances of templates that do not exist were left out: {1}", kExport},
    {I::BadInstance, Severity::Warning, "bad-instance", Fate::Repaired,
     "{0} instances were left out: {1}", kExport},
    {I::NothingUsable, Severity::Error, "no-usable-geometry", Fate::Skipped,
     "was skipped: nothing of its geometry can be used", kExport},
}};

const IssueText& textOf(Issue issue) {
    return kTexts[static_cast<std::size_t>(issue)];
}

constexpr bool inOrder() {
    for (std::size_t i = 0; i < kTexts.size(); ++i) {
        if (kTexts[i].issue != static_cast<Issue>(i))
            return false;
    }
    return true;
}
static_assert(inOrder());

}  // namespace

void ImportReport::note(std::uint32_t object, Issue issue, std::string detail, std::size_t count) {
    auto& notes = m_notes[object];
    const auto known = std::find_if(notes.begin(), notes.end(),
                                    [&](const Note& note) { return note.issue == issue; });
    if (known != notes.end())
        known->count += count;
    else
        notes.push_back({issue, count, std::move(detail)});
}

Fate ImportReport::fate(std::uint32_t object) const {
    if (m_leftOut[object])
        return Fate::LeftOut;
    Fate fate = Fate::Loaded;
    for (const Note& note : m_notes[object])
        fate = std::max(fate, textOf(note.issue).fate);
    return fate;
}

ImportCounts ImportReport::counts() const {
    ImportCounts counts;
    for (std::uint32_t i = 0; i < m_notes.size(); ++i) {
        const Fate f = fate(i);
        counts.loaded += f == Fate::Loaded ? 1 : 0;
        counts.repaired += f == Fate::Repaired ? 1 : 0;
        counts.skipped += f == Fate::Skipped ? 1 : 0;
    }
    return counts;
}

std::vector<Diagnostic> ImportReport::diagnostics(const std::vector<ObjectOutline>& objects) const {
    std::vector<Diagnostic> all = m_file;
    for (std::size_t i = 0; i < m_notes.size(); ++i) {
        if (m_leftOut[i])
            continue;
        for (const Note& note : m_notes[i]) {
            const IssueText& text = textOf(note.issue);
            all.push_back({text.severity, text.code, objects[i].id,
                           fmt::format(fmt::runtime(text.text), note.count, note.detail),
                           text.remedy});
        }
    }
    return all;
}

std::string ImportReport::firstFault(const std::vector<ObjectOutline>& objects) const {
    for (std::size_t i = 0; i < m_notes.size(); ++i) {
        if (m_leftOut[i])
            continue;
        for (const Note& note : m_notes[i]) {
            const IssueText& text = textOf(note.issue);
            if (text.fate == Fate::Repaired || text.fate == Fate::Skipped)
                return fmt::format("object {:.80}: {}", objects[i].id,
                                   fmt::format(fmt::runtime(text.text), note.count, note.detail));
        }
    }
    return {};
}

}  // namespace reflet::cityjson
