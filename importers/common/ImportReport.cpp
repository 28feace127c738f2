// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ImportReport.h"

#include "importers/common/LodChoice.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace reflet::importers {

namespace {

struct IssueText {
    Issue issue;
    Severity severity;
    const char* code;
    Fate fate;
    const char* text;  ///< {0}: number of surfaces, {1}: detail of the first, {2}: plain number
    const char* remedy;
};

using I = Issue;
using enum Severity;
constexpr const char* kExport =
    "Export the object again, or check the file with a validator (cjval, citygml-tools).";
constexpr const char* kFootprint =
    "Mend the footprint where it was drawn, e.g. with QGIS (Fix geometries).";
constexpr const char* kGeometry = "Check the object's geometry with val3dity.";

constexpr std::array<IssueText, 33> kTexts{{
    {I::NotAnObject, Error, "not-an-object", Fate::Skipped, "skipped: it is no JSON object",
     kExport},
    {I::DuplicateId, Error, "duplicate-id", Fate::Skipped,
     "skipped: an earlier object has the same id", "Give each city object an id of its own."},
    {I::NoType, Warning, "no-type", Fate::Repaired,
     "has no type; it was loaded as an object of unknown kind", kExport},
    {I::UnknownType, Info, "unknown-type", Fate::Loaded,
     "has the type {1}, which the format does not define; it was loaded as an object of unknown "
     "kind",
     ""},
    {I::ParentMissing, Warning, "parent-missing", Fate::Loaded,
     "names a parent that is not in the file: {1}", kExport},
    {I::ParentCycle, Warning, "parent-cycle", Fate::Repaired,
     "is its own ancestor; it was loaded without a parent", kExport},
    {I::NoGeometry, Info, "no-geometry", Fate::Loaded, "has no geometry", ""},
    {I::NoSurfaces, Info, "no-surfaces", Fate::Loaded,
     "has points or lines only, which show nothing", ""},
    {I::BadGeometry, Warning, "bad-geometry", Fate::Repaired,
     "a geometry was left out ({2} in all): {1}", kExport},
    {I::UnknownGeometryType, Warning, "unknown-geometry-type", Fate::Repaired,
     "a geometry was left out ({2} in all): the format does not define its type \"{1}\"", kExport},
    {I::EmptyGeometry, Warning, "empty-geometry", Fate::Repaired,
     "a solid, shell or geometry has no surface ({2} in all)", kGeometry},
    {I::IndexOutOfRange, Warning, "index-out-of-range", Fate::Repaired,
     "left out: {0} with a vertex that does not exist ({1})", kExport},
    {I::BadVertex, Error, "bad-vertex", Fate::Skipped, "skipped: {1} is no usable point", kExport},
    {I::DegenerateSurface, Warning, "degenerate-surface", Fate::Repaired,
     "left out: {0} without area ({1})", kGeometry},
    {I::RepairedPolygon, Info, "polygon-repaired", Fate::Repaired,
     "mended: {0} with repeated points, crossing edges or odd rings", kGeometry},
    {I::SemanticsBroken, Warning, "semantics-malformed", Fate::Repaired,
     "the semantics of a geometry ({2} in all) do not fit its surfaces: {1}", kExport},
    {I::SemanticsIndex, Warning, "semantics-index-out-of-range", Fate::Repaired,
     "loaded without semantics: {0} ({1})", kExport},
    {I::MaterialBroken, Warning, "material-malformed", Fate::Repaired,
     "the materials of a geometry ({2} in all) do not fit its surfaces: {1}", kExport},
    {I::MaterialIndex, Warning, "material-index-out-of-range", Fate::Repaired,
     "loaded without material: {0} ({1})", kExport},
    {I::TextureBroken, Warning, "texture-malformed", Fate::Repaired,
     "loaded without texture: {0} ({1})", kExport},
    {I::TextureIndex, Warning, "texture-index-out-of-range", Fate::Repaired,
     "loaded without texture: {0} ({1})", kExport},
    {I::NoTemplate, Warning, "template-out-of-range", Fate::Repaired,
     "an instance was left out ({2} in all): {1}", kExport},
    {I::BadInstance, Warning, "bad-instance", Fate::Repaired,
     "an instance was left out ({2} in all): {1}", kExport},
    {I::NothingUsable, Error, "no-usable-geometry", Fate::Skipped,
     "skipped: nothing of its geometry can be used", kExport},
    {I::NoArea, Error, "no-area", Fate::Skipped, "skipped: there is no area to build on: {1}",
     kFootprint},
    {I::FootprintMended, Warning, "footprint-repaired", Fate::Repaired,
     "its footprint was mended: {1}", kFootprint},
    {I::Underground, Info, "underground", Fate::Skipped, "skipped: it lies below the ground", ""},
    {I::ShownByParts, Info, "shown-by-parts", Fate::Loaded, "is shown by its parts", ""},
    {I::RoofSimplified, Info, "roof-simplified", Fate::Loaded,
     "the footprint does not allow a roof of its shape; a simpler one was built", ""},
    {I::BadCoordinates, Warning, "bad-coordinates", Fate::Repaired,
     "left out: {0} whose coordinates cannot be read ({1})", kExport},
    {I::OpenRing, Info, "ring-closed", Fate::Repaired,
     "closed: {0} with a ring that does not end where it begins", kExport},
    {I::ReferenceMissing, Warning, "reference-missing", Fate::Repaired,
     "a surface or template that is named is not in the file ({2} in all): {1}", kExport},
    {I::LibraryObject, Warning, "library-object", Fate::Repaired,
     "an instance of a model in another file was left out ({2} in all): {1}",
     "Export the city with the model in it."},
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

std::string worded(const IssueText& text, std::size_t count, const std::string& detail) {
    return fmt::format(fmt::runtime(text.text),
                       count == 1 ? std::string("1 surface") : fmt::format("{} surfaces", count),
                       detail, count);
}

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

void ImportReport::append(ImportReport more) {
    m_notes.insert(m_notes.end(), std::make_move_iterator(more.m_notes.begin()),
                   std::make_move_iterator(more.m_notes.end()));
    m_leftOut.insert(m_leftOut.end(), more.m_leftOut.begin(), more.m_leftOut.end());
}

Fate ImportReport::fate(std::uint32_t object) const {
    if (m_leftOut[object])
        return Fate::LeftOut;
    Fate fate = Fate::Loaded;
    for (const Note& note : m_notes[object])
        fate = std::max(fate, textOf(note.issue).fate);
    return fate;
}

bool Tallies::missesLevel(const std::string& lod) const {
    return isOneLevel(lod) && anyGeometry && !anyChosen;
}

std::string Tallies::levels() const {
    std::vector<std::string> names;
    for (const std::string& lod : lods) {
        if (!lod.empty())
            names.push_back(lod);
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return std::pair(lodRank(a), a) < std::pair(lodRank(b), b);
    });
    constexpr std::size_t kEnough = 12;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kEnough); ++i)
        list += fmt::format("{}{:.20}", list.empty() ? "" : ", ", names[i]);
    return list.empty() ? "none" : list;
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
    std::vector<Diagnostic> all;
    for (std::size_t i = 0; i < m_notes.size(); ++i) {
        if (m_leftOut[i])
            continue;
        for (const Note& note : m_notes[i]) {
            const IssueText& text = textOf(note.issue);
            all.push_back({text.severity, text.code, objects[i].id,
                           worded(text, note.count, note.detail), text.remedy});
        }
    }
    return all;
}

std::vector<ObjectAccount> ImportReport::remarked(const std::vector<ObjectOutline>& objects,
                                                  std::size_t firstRemark,
                                                  std::vector<std::uint32_t>& indices) const {
    std::vector<ObjectAccount> all;
    for (std::uint32_t i = 0; i < m_notes.size(); ++i) {
        if (m_leftOut[i] || m_notes[i].empty())
            continue;
        const ObjectResult result = fate(i) == Fate::Skipped    ? ObjectResult::Skipped
                                    : fate(i) == Fate::Repaired ? ObjectResult::Repaired
                                                                : ObjectResult::Loaded;
        all.push_back(
            {objects[i].id, objects[i].typeName, {}, result, firstRemark, m_notes[i].size()});
        indices.push_back(i);
        firstRemark += m_notes[i].size();
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
                                   worded(text, note.count, note.detail));
        }
    }
    return {};
}

}  // namespace reflet::importers
