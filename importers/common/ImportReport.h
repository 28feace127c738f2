// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "importers/ImportTypes.h"
#include "importers/common/SourceCity.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace reflet::importers {

/// What can be odd about a city object. Each has a stable code, a text and a consequence.
enum class Issue : std::uint8_t {
    NotAnObject,
    DuplicateId,
    NoType,
    UnknownType,
    ParentMissing,
    ParentCycle,
    NoGeometry,
    NoSurfaces,
    BadGeometry,
    UnknownGeometryType,
    EmptyGeometry,
    IndexOutOfRange,
    BadVertex,
    DegenerateSurface,
    RepairedPolygon,
    SemanticsBroken,
    SemanticsIndex,
    MaterialBroken,
    MaterialIndex,
    TextureBroken,
    TextureIndex,
    NoTemplate,
    BadInstance,
    NothingUsable,
    NoArea,
    FootprintMended,
    Underground,
    ShownByParts,
    RoofSimplified,
    BadCoordinates,
    OpenRing,
    ReferenceMissing,
    LibraryObject,
};

enum class Fate : std::uint8_t { Loaded, Repaired, Skipped, LeftOut };

/// What is counted over all pieces of a file and said once.
struct Tallies {
    std::size_t otherTypes = 0;  ///< objects left out because of their type
    std::size_t offLevel = 0;    ///< because they have nothing at the level asked for
    std::size_t outOfBox = 0;
    std::size_t notPlanar = 0;  ///< surfaces more than 1 cm out of plane
    double worstDeviation = 0.0;
    std::string worstObject;
    bool withoutAppearance = false;
    bool anyGeometry = false;
    bool anyChosen = false;
    std::set<std::string> lods;  ///< of all geometries, chosen or not

    /// One level is asked for, and there is geometry, but none of that level.
    [[nodiscard]] bool missesLevel(const std::string& lod) const;
    /// "1, 1.2, 2": at most twelve, for a message.
    [[nodiscard]] std::string levels() const;
};

/// Collects what is said about the objects of a file, once for each object and issue, and how each
/// of them fared.
class ImportReport {
public:
    explicit ImportReport(std::size_t objects) : m_notes(objects), m_leftOut(objects, false) {}

    /// `count` more cases of an issue; the detail of the first is kept.
    void note(std::uint32_t object, Issue issue, std::string detail = {}, std::size_t count = 1);
    /// Puts the objects of another report behind those of this one.
    void append(ImportReport more);
    /// Takes an object out of the account: the caller did not ask for it.
    void leaveOut(std::uint32_t object) { m_leftOut[object] = true; }

    [[nodiscard]] Fate fate(std::uint32_t object) const;
    [[nodiscard]] bool leftOut(std::uint32_t object) const { return m_leftOut[object]; }
    [[nodiscard]] ImportCounts counts() const;
    /// Object by object in the order of the file.
    [[nodiscard]] std::vector<Diagnostic> diagnostics(
        const std::vector<ObjectOutline>& objects) const;
    /// The objects of diagnostics(), whose first is number `firstRemark`; levels are left empty,
    /// and `indices` takes the number of each.
    [[nodiscard]] std::vector<ObjectAccount> remarked(const std::vector<ObjectOutline>& objects,
                                                      std::size_t firstRemark,
                                                      std::vector<std::uint32_t>& indices) const;
    /// The first thing that a strict import does not let pass; empty when there is none.
    [[nodiscard]] std::string firstFault(const std::vector<ObjectOutline>& objects) const;

private:
    struct Note {
        Issue issue;
        std::size_t count;
        std::string detail;
    };
    std::vector<std::vector<Note>> m_notes;
    std::vector<bool> m_leftOut;
};

}  // namespace reflet::importers
