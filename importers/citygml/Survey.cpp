// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/Survey.h"

#include "importers/citygml/GmlPoints.h"
#include "importers/citygml/MemberReader.h"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace reflet::citygml {

using namespace importers;

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

/// Calls `visit` with the values of all attributes of a local name, as they are written.
template <class Visit>
void forAttributes(std::string_view text, std::string_view name, const Visit& visit) {
    for (std::size_t at = text.find(name); at != std::string_view::npos;
         at = text.find(name, at + name.size())) {
        if (at == 0 || (text[at - 1] != ':' && !isBlank(text[at - 1])))
            continue;
        std::size_t next = at + name.size();
        while (next < text.size() && isBlank(text[next]))
            ++next;
        if (next >= text.size() || text[next] != '=')
            continue;
        ++next;
        while (next < text.size() && isBlank(text[next]))
            ++next;
        if (next >= text.size() || (text[next] != '"' && text[next] != '\''))
            continue;
        const std::size_t end = text.find(text[next], next + 1);
        if (end == std::string_view::npos)
            return;
        visit(text.substr(next + 1, end - next - 1));
    }
}

/// Adds the positions of all geometries below a node; templates are in coordinates of their own.
void addPositions(pugi::xml_node node, int dimension, Extent& extent) {
    std::vector<glm::dvec3> points;
    std::vector<std::pair<pugi::xml_node, int>> open{{node, dimension}};
    while (!open.empty()) {
        const auto [next, size] = open.back();
        open.pop_back();
        for (const pugi::xml_node child : next.children()) {
            if (child.type() != pugi::node_element)
                continue;
            const std::string_view name = localNameOf(child);
            if (name == "LinearRing" || name == "referencePoint") {
                points.clear();
                if (readPoints(child, size, points).empty()) {
                    for (const glm::dvec3& point : points)
                        extent.add(point);
                }
            } else if (name != "relativeGMLGeometry" && name != "relativeGeometry" &&
                       name != "Appearance") {
                open.emplace_back(child, dimensionOf(child, size));
            }
        }
    }
}

bool isCity(const std::string& root, const Namespaces& namespaces) {
    const std::string_view name = localNameOfTag(root);
    return !namespaces.version().empty() && (name == "CityModel" || name == "FeatureCollection");
}

class Surveyor {
public:
    Surveyor(const std::string& subject, bool wholeExtent, const JobContext& job)
        : m_subject(subject), m_wholeExtent(wholeExtent), m_job(job) {}

    Result<Survey> run(const ByteSource& source) {
        for (const bool definitions : {false, true}) {
            if (definitions && m_wanted.empty())
                break;
            auto bytes = source.again();
            if (!bytes)
                return tl::unexpected<Error>(bytes.error());
            auto walked = walk(**bytes, definitions);
            if (!walked)
                return tl::unexpected<Error>(walked.error());
        }
        return std::move(m_survey);
    }

private:
    Result<void> walk(ByteSource& source, bool definitions) {
        MemberReader reader(source, m_subject);
        if (auto read = reader.readRoot(); !read)
            return read;
        m_survey.root = reader.root();
        if (const Namespaces namespaces(reader.root()); !isCity(reader.root(), namespaces)) {
            return fail(ErrorCode::Unreadable,
                        fmt::format("is no CityGML: its root is <{:.60}>, without a namespace of "
                                    "CityGML 1.0, 2.0 or 3.0",
                                    localNameOfTag(reader.root())),
                        m_subject, "Check that this is the right file.");
        }
        std::string member;
        for (;;) {
            if (m_job.cancelled())
                return tl::unexpected<Error>(JobContext::cancelledError());
            const auto any = reader.next(member);
            if (!any)
                return tl::unexpected<Error>(any.error());
            if (!*any)
                return {};
            m_job.progress(double(reader.position()) / double(source.size() + 1));
            auto seen = definitions ? define(member, reader.line()) : look(member, reader.line());
            if (!seen)
                return seen;
        }
    }

    Result<void> look(std::string& member, std::size_t line) {
        const std::string_view name = localNameOfTag(member);
        if (name == "boundedBy") {
            forAttributes(member, "srsName", [&](std::string_view value) {
                if (!m_fromEnvelope && !value.empty())
                    m_survey.srsName = value;
                m_fromEnvelope = m_fromEnvelope || !value.empty();
            });
            return {};
        }
        if (name == "appearanceMember" || name == "appearance") {
            pugi::xml_document document;
            if (auto parsed = parseMember(member, line, m_subject, document); !parsed)
                return parsed;
            m_survey.appearances.addAllOf(document);
            return {};
        }
        ++m_survey.members;
        noteSystems(member);
        noteReferences(member);
        constexpr std::size_t kSample = 64;
        if (!m_wholeExtent && m_survey.members > kSample)
            return {};
        pugi::xml_document document;
        if (auto parsed = parseMember(member, line, m_subject, document); !parsed)
            return parsed;
        addPositions(document, 3, m_survey.extent);
        return {};
    }

    void noteSystems(std::string_view member) {
        constexpr std::size_t kMost = 1000;
        forAttributes(member, "srsName", [&](std::string_view value) {
            if (value.empty() || m_survey.srsNames.size() >= kMost)
                return;
            if (!m_survey.srsName)
                m_survey.srsName = value;
            m_survey.srsNames.insert(std::string(value));
        });
    }

    /// What a member names and does not have.
    void noteReferences(std::string_view member) {
        if (!hasAttribute(member, "href"))
            return;
        std::unordered_set<std::string_view> ids;
        forAttributes(member, "id", [&](std::string_view value) { ids.insert(value); });
        forAttributes(member, "href", [&](std::string_view value) {
            const std::string_view id = idOfReference(value);
            if (!id.empty() && !ids.contains(id))
                m_wanted.insert(std::string(id));
        });
    }

    Result<void> define(std::string& member, std::size_t line) {
        bool any = false;
        forAttributes(member, "id", [&](std::string_view value) {
            any = any || m_wanted.contains(std::string(value));
        });
        if (!any)
            return {};
        pugi::xml_document document;
        if (auto parsed = parseMember(member, line, m_subject, document); !parsed)
            return parsed;
        Namespaces namespaces(m_survey.root);
        namespaces.lookInside(true);
        std::vector<pugi::xml_node> open{document};
        while (!open.empty()) {
            const pugi::xml_node node = open.back();
            open.pop_back();
            const std::string id(attributeOf(node, "id"));
            if (!id.empty() && m_wanted.contains(id) &&
                namespaces.nameOf(node).vocabulary == Vocabulary::Gml) {
                auto copy = std::make_unique<pugi::xml_document>();
                copy->append_copy(node);
                m_survey.definitions.try_emplace(id, std::move(copy));
            }
            for (const pugi::xml_node child : node.children()) {
                if (child.type() == pugi::node_element)
                    open.push_back(child);
            }
        }
        return {};
    }

    const std::string& m_subject;
    bool m_wholeExtent;
    const JobContext& m_job;
    Survey m_survey;
    bool m_fromEnvelope = false;
    std::unordered_set<std::string> m_wanted;
};

}  // namespace

bool hasAttribute(std::string_view text, std::string_view name) {
    bool any = false;
    forAttributes(text, name, [&](std::string_view) { any = true; });
    return any;
}

Result<void> parseMember(std::string& text, std::size_t line, const std::string& subject,
                         pugi::xml_document& into) {
    const pugi::xml_parse_result parsed =
        into.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (parsed)
        return {};
    const auto end =
        text.begin() + std::min(parsed.offset, static_cast<std::ptrdiff_t>(text.size()));
    return fail(ErrorCode::Unreadable,
                fmt::format("is no valid XML at line {}: {}",
                            line + static_cast<std::size_t>(std::count(text.begin(), end, '\n')),
                            parsed.description()),
                subject, "Get the file again, or check it with an XML validator.");
}

Result<Survey> surveyFile(const ByteSource& source, const std::string& subject, bool wholeExtent,
                          const JobContext& job) {
    return Surveyor(subject, wholeExtent, job).run(source);
}

}  // namespace reflet::citygml
