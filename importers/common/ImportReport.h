// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "importers/common/SourceCity.h"

#include <cstddef>
#include <cstdint>
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
};

enum class Fate : std::uint8_t { Loaded, Repaired, Skipped, LeftOut };

/// Collects what is said about the objects of a file, once for each object and issue, and how each
/// of them fared.
class ImportReport {
public:
    explicit ImportReport(std::size_t objects) : m_notes(objects), m_leftOut(objects, false) {}

    /// `count` more cases of an issue; the detail of the first is kept.
    void note(std::uint32_t object, Issue issue, std::string detail = {}, std::size_t count = 1);
    /// Takes an object out of the account: the caller did not ask for it.
    void leaveOut(std::uint32_t object) { m_leftOut[object] = true; }
    void file(Diagnostic diagnostic) { m_file.push_back(std::move(diagnostic)); }
    [[nodiscard]] std::vector<Diagnostic>& fileDiagnostics() { return m_file; }

    [[nodiscard]] Fate fate(std::uint32_t object) const;
    [[nodiscard]] bool leftOut(std::uint32_t object) const { return m_leftOut[object]; }
    [[nodiscard]] ImportCounts counts() const;
    /// About the file first, then object by object in the order of the file.
    [[nodiscard]] std::vector<Diagnostic> diagnostics(
        const std::vector<ObjectOutline>& objects) const;
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
    std::vector<Diagnostic> m_file;
};

}  // namespace reflet::importers
