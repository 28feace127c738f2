// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/GeometryReader.h"

#include "importers/cityjson/SurfaceBuilder.h"
#include "importers/common/CityPiece.h"

#include <fmt/core.h>

#include <algorithm>

namespace reflet::cityjson {

namespace {

/// The walk over the boundaries. Objects and geometries come in the order in which the outline met
/// them, so that counting along is enough to know which is which.
class GeometryWalk {
public:
    GeometryWalk(JsonDocument& document, const SourceCity& file, const std::vector<bool>& chosen,
                 ImportReport& report, const JobContext& job)
        : m_document(document),
          m_file(file),
          m_chosen(chosen),
          m_report(report),
          m_job(job),
          m_surfaces(file, file.vertices.size(), m_city.surfaces),
          m_templates(file, file.templateVertices.size(), m_city.templates) {}

    Result<CityGeometry> read() {
        bool seenObjects = false;
        bool seenTemplates = false;
        auto walked = m_document.walk(m_job, [&](std::string_view key, JsonValue value) {
            if (key == "CityObjects" && !seenObjects) {
                seenObjects = true;
                value.forEachMember(
                    [&](std::string_view, JsonValue object) { readObject(object); });
            } else if (key == "geometry-templates" && !seenTemplates) {
                seenTemplates = true;
                readTemplates(value);
            }
        });
        if (!walked)
            return tl::unexpected<Error>(walked.error());
        finish();
        return std::move(m_city);
    }

private:
    void readObject(JsonValue value) {
        const auto object = m_object++;
        if (object >= m_file.objects.size() || m_job.cancelled())
            return;
        std::uint32_t geometry = m_file.objects[object].firstGeometry;
        const auto note = [&](Issue issue, std::string detail, std::size_t count) {
            m_report.note(object, issue, std::move(detail), count);
        };
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key != "geometry")
                return;
            member.forEachElement([&](JsonValue entry) {
                const std::uint32_t index = geometry++;
                if (index >= m_chosen.size() || !m_chosen[index])
                    return;
                const GeometryOutline& outline = m_file.geometries[index];
                readGeometryText(entry, m_file, outline.type, note, m_text);
                if (outline.type == GeometryType::Instance)
                    addInstance(object, outline.templateIndex, note);
                else
                    m_surfaces.add(m_text, object, note);
            });
        });
        if (m_object % 1024 == 0)
            m_job.progress(m_document.fractionWalked());
    }

    void addInstance(std::uint32_t object, std::uint32_t templateIndex, Noter note) {
        if (templateIndex >= m_file.templates.size()) {
            note(Issue::NoTemplate,
                 templateIndex == kBadIndex ? "no template is named"
                                            : fmt::format("template {}, counted from 0, of {}",
                                                          templateIndex, m_file.templates.size()),
                 1);
            return;
        }
        const auto& anchors = m_text.boundaries.leaves;
        if (anchors.size() != 1 || anchors.front() >= m_file.vertices.size()) {
            note(Issue::BadInstance, "the anchor is not one existing vertex", 1);
            return;
        }
        if (!m_text.matrix) {
            note(Issue::BadInstance, "the matrix is not 16 numbers", 1);
            return;
        }
        m_city.instances.push_back({object, templateIndex, anchors.front(), *m_text.matrix});
    }

    void readTemplates(JsonValue value) {
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key != "templates")
                return;
            member.forEachElement([&](JsonValue entry) { readTemplate(entry); });
        });
    }

    void readTemplate(JsonValue value) {
        const auto index = static_cast<std::uint32_t>(m_city.templateNotes.size());
        m_city.templateBegin.push_back(
            static_cast<std::uint32_t>(m_city.templates.surfaces.size()));
        m_city.templateNotes.emplace_back();
        if (index >= m_file.templates.size())
            return;
        const auto note = [&](Issue issue, std::string detail, std::size_t count) {
            auto& notes = m_city.templateNotes[index];
            const auto known = std::find_if(notes.begin(), notes.end(), [&](const TemplateNote& n) {
                return n.issue == issue;
            });
            if (known != notes.end())
                known->count += count;
            else
                notes.push_back({issue, std::move(detail), count});
        };
        const GeometryType type = m_file.templates[index].type;
        if (boundaryDepth(type) == 0) {
            note(Issue::BadGeometry, fmt::format("template {} has no surfaces", index), 1);
            return;
        }
        readGeometryText(value, m_file, type, note, m_text);
        m_templates.add(m_text, index, note);
    }

    void finish() {
        m_city.templateBegin.push_back(
            static_cast<std::uint32_t>(m_city.templates.surfaces.size()));
        noteTemplates(m_city, m_report);
        m_city.writtenSurfaces = m_surfaces.writtenSurfaces();
        m_city.writtenTriangles = m_surfaces.writtenTriangles();
        m_city.withoutAppearance =
            m_surfaces.withoutAppearance() || m_templates.withoutAppearance();
        m_city.usedBySurface.assign(m_file.vertices.size(), false);
        for (const std::uint32_t point : m_city.surfaces.points)
            m_city.usedBySurface[point] = true;
    }

    JsonDocument& m_document;
    const SourceCity& m_file;
    const std::vector<bool>& m_chosen;
    ImportReport& m_report;
    const JobContext& m_job;
    CityGeometry m_city;
    SurfaceBuilder m_surfaces;
    SurfaceBuilder m_templates;
    GeometryText m_text;
    std::uint32_t m_object = 0;
};

}  // namespace

Result<CityGeometry> readCityGeometry(JsonDocument& document, const SourceCity& file,
                                      const std::vector<bool>& chosen, ImportReport& report,
                                      const JobContext& job) {
    return GeometryWalk(document, file, chosen, report, job).read();
}

}  // namespace reflet::cityjson
