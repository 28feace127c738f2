// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/CityJsonFile.h"

#include "importers/cityjson/AppearanceReader.h"
#include "importers/common/ObjectNames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <unordered_set>

namespace reflet::cityjson {

namespace {

constexpr const char* kCheckFile = "Check that this is the right file, e.g. with cjval.";

/// "City Objects" and "cityobjects" are "CityObjects" misspelled.
std::string lettersOf(std::string_view key) {
    std::string letters;
    for (const char c : key) {
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return letters;
}

/// The walk that fills a CityJsonFile. Remembers which members it has met, so that what is missing
/// can be told at the end.
class FileReader {
public:
    enum class Kind { City, SequenceHeader, Feature };

    FileReader(Kind kind, const std::string& subject, const JobContext& job)
        : m_kind(kind), m_subject(subject), m_job(job) {
        m_file.format = kind == Kind::City ? "CityJSON" : "CityJSONSeq";
    }

    void inherit(const SourceCity& header) {
        m_file.version = header.version;
        m_file.referenceSystem = header.referenceSystem;
        m_file.transform = header.transform;
        m_file.lodNames = header.lodNames;
        m_file.templates = header.templates;
        for (std::uint32_t i = 0; i < header.lodNames.size(); ++i)
            m_lods.emplace(header.lodNames[i], i);
    }

    Result<SourceCity> read(JsonDocument& document) {
        m_document = &document;
        auto walked = document.walk(
            m_job, [&](std::string_view key, JsonValue value) { member(key, value); });
        if (!walked && m_type == "CityJSON" && document.isSequence())
            return unreadable("is a CityJSON text sequence (one object a line), not a single city",
                              "Collect its features into one file, e.g. with cjseq.");
        if (!walked)
            return tl::unexpected<Error>(walked.error());
        if (auto whole = checkWhole(); !whole) {
            // What is missing may be missing because the text is damaged.
            const auto damage = document.findSyntaxError();
            return tl::unexpected<Error>(damage ? *damage : whole.error());
        }
        return std::move(m_file);
    }

private:
    void member(std::string_view key, JsonValue value) {
        if (m_job.cancelled() || !m_seen.insert(std::string(key)).second)
            return;  // of members that are there twice the first counts
        if (key == "type")
            m_type = value.text();
        else if (key == "version")
            readVersion(value);
        else if (key == "metadata")
            readMetadata(value);
        else if (key == "transform")
            readTransform(value);
        else if (key == "vertices")
            m_hasVertices = value.points(m_file.vertices, m_job);
        else if (key == "appearance")
            readAppearance(value, m_file, m_job);
        else if (key == "geometry-templates" && m_kind != Kind::Feature)
            readTemplates(value);
        else if (key == "CityObjects")
            readObjects(value);
        else if (lettersOf(key) == "cityobjects")
            m_misspelled = std::string(key);
    }

    void readVersion(JsonValue value) {
        m_hasVersion = true;
        if (const auto number = value.number())
            m_file.version = fmt::format("{:.1f}", *number);
        else
            m_file.version = value.text();
    }

    void readMetadata(JsonValue value) {
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "referenceSystem") {
                auto text = member.string();
                if (text && !text->empty())
                    m_file.referenceSystem = std::move(text);
            } else if (key == "crs" && !m_file.referenceSystem) {
                member.forEachMember([&](std::string_view name, JsonValue code) {
                    if (name != "epsg")
                        return;
                    if (const auto number = code.index())
                        m_file.referenceSystem = fmt::format("EPSG:{}", *number);
                });
            }
        });
    }

    void readTransform(JsonValue value) {
        std::optional<std::array<double, 3>> scale;
        std::optional<std::array<double, 3>> translate;
        const bool isNull = value.isNull();
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "scale")
                scale = member.numbers<3>();
            else if (key == "translate")
                translate = member.numbers<3>();
        });
        const bool sound =
            scale && translate && (*scale)[0] != 0.0 && (*scale)[1] != 0.0 && (*scale)[2] != 0.0;
        m_badTransform = !sound && !isNull;
        if (sound) {
            m_file.transform = VertexTransform{{(*scale)[0], (*scale)[1], (*scale)[2]},
                                               {(*translate)[0], (*translate)[1], (*translate)[2]}};
        }
    }

    void readTemplates(JsonValue value) {
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "templates") {
                member.forEachElement(
                    [&](JsonValue geometry) { m_file.templates.push_back(readOutline(geometry)); });
            } else if (key == "vertices-templates") {
                member.points(m_file.templateVertices, m_job);
            }
        });
    }

    void readObjects(JsonValue value) {
        m_hasObjects = value.forEachMember([&](std::string_view id, JsonValue object) {
            if (m_job.cancelled())
                return;
            readObject(std::string(id), object);
            if (m_file.objects.size() % 1024 == 0)
                m_job.progress(m_document->fractionWalked());
        });
    }

    void readObject(std::string id, JsonValue value) {
        ObjectOutline object;
        object.id = std::move(id);
        object.duplicate = !m_ids.insert(object.id).second;
        object.firstGeometry = static_cast<std::uint32_t>(m_file.geometries.size());
        object.isObject = value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "type") {
                object.typeName = member.text();
                object.type = cityObjectType(object.typeName);
                object.isKnown = isKnownCityObjectType(object.typeName);
            } else if (key == "parents") {
                member.forEachElement([&](JsonValue parent) {
                    if (auto name = parent.string())
                        object.parentIds.push_back(std::move(*name));
                });
            } else if (key == "children" || key == "members") {
                member.forEachElement([&](JsonValue) { object.hasChildren = true; });
            } else if (key == "geometry") {
                const bool isNull = member.isNull();
                const bool isList = member.forEachElement([&](JsonValue geometry) {
                    m_file.geometries.push_back(readOutline(geometry));
                });
                object.badGeometry = !isList && !isNull;
            }
        });
        object.geometryCount =
            static_cast<std::uint32_t>(m_file.geometries.size()) - object.firstGeometry;
        m_file.objects.push_back(std::move(object));
    }

    GeometryOutline readOutline(JsonValue value) {
        GeometryOutline outline;
        std::string lod;
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "type") {
                outline.typeName = member.text();
                outline.type = geometryType(outline.typeName);
                if (outline.type != GeometryType::Unknown)
                    outline.typeName.clear();
            } else if (key == "lod") {
                lod = readLod(member);
            } else if (key == "template") {
                outline.templateIndex = member.index().value_or(kBadIndex);
            }
        });
        const auto next = static_cast<std::uint32_t>(m_file.lodNames.size());
        const auto [entry, isNew] = m_lods.try_emplace(lod, next);
        if (isNew)
            m_file.lodNames.push_back(lod);
        outline.lod = entry->second;
        return outline;
    }

    /// CityJSON 1.0 has numbers: 2 and 2.0 are "2", 2.1 is "2.1". Null and the like: "".
    static std::string readLod(JsonValue value) {
        if (const auto number = value.number())
            return fmt::format("{}", *number == std::floor(*number) && std::abs(*number) < 1e6
                                         ? fmt::format("{:.0f}", *number)
                                         : fmt::format("{}", *number));
        return value.string().value_or("");
    }

    [[nodiscard]] tl::unexpected<Error> unreadable(std::string what, std::string remedy) const {
        return fail(ErrorCode::Unreadable, std::move(what), m_subject, std::move(remedy));
    }

    [[nodiscard]] Result<void> checkWhole() const {
        if (m_kind == Kind::Feature && m_type != "CityJSONFeature")
            return unreadable(
                fmt::format("is no CityJSONFeature: its \"type\" is \"{:.60}\"", m_type),
                kCheckFile);
        if (m_kind == Kind::Feature)
            return checkContent();
        if (m_kind == Kind::SequenceHeader && m_type == "CityJSONFeature")
            return unreadable(
                "begins with a feature; the line with the transform is missing before it",
                "Export it again as CityJSONSeq, e.g. with cjseq.");
        if (!m_seen.contains("type"))
            return unreadable("is no CityJSON: \"type\" is missing at its root", kCheckFile);
        if (m_type == "CityJSONFeature")
            return unreadable("holds one CityJSONFeature, not a CityJSON city model",
                              "Collect the features into one file, e.g. with cjseq.");
        if (m_type != "CityJSON")
            return unreadable(fmt::format("is no CityJSON: its \"type\" is \"{:.60}\"", m_type),
                              kCheckFile);
        if (auto version = checkVersion(); !version)
            return version;
        return checkContent();
    }

    [[nodiscard]] Result<void> checkContent() const {
        if (m_badTransform)
            return unreadable(
                "has a \"transform\" whose scale and translate are not three numbers each",
                "Without them no coordinate is known: export the file again.");
        if (m_kind == Kind::SequenceHeader)
            return {};
        if (!m_hasObjects && !m_misspelled.empty())
            return unreadable(
                fmt::format("has no \"CityObjects\"; \"{:.60}\" stands in its place", m_misspelled),
                "Rename that member to CityObjects.");
        if (!m_hasObjects)
            return unreadable("has no \"CityObjects\" object", kCheckFile);
        if (!m_hasVertices)
            return unreadable("has no \"vertices\" array", kCheckFile);
        return {};
    }

    [[nodiscard]] Result<void> checkVersion() const {
        const char* upgrade = "Convert it to 1.0, 1.1 or 2.0, e.g. with cjio's upgrade.";
        if (!m_hasVersion)
            return unreadable("is no CityJSON: \"version\" is missing at its root", kCheckFile);
        const std::string& version = m_file.version;
        for (const std::string_view known : {"1.0", "1.1", "2.0"}) {
            if (version == known || version.starts_with(std::string(known) + '.'))
                return {};
        }
        return unreadable(
            fmt::format("is CityJSON of version \"{:.40}\", which is unknown", version), upgrade);
    }

    Kind m_kind;
    const std::string& m_subject;
    const JobContext& m_job;
    JsonDocument* m_document = nullptr;
    SourceCity m_file;
    std::unordered_set<std::string> m_seen;
    std::unordered_set<std::string> m_ids;
    std::unordered_map<std::string, std::uint32_t> m_lods;
    std::string m_type;
    std::string m_misspelled;
    bool m_hasVersion = false;
    bool m_hasVertices = false;
    bool m_hasObjects = false;
    bool m_badTransform = false;
};

}  // namespace

Result<SourceCity> readCityJsonFile(JsonDocument& document, const std::string& subject,
                                    const JobContext& job) {
    return FileReader(FileReader::Kind::City, subject, job).read(document);
}

Result<SourceCity> readSequenceHeader(JsonDocument& document, const std::string& subject,
                                      const JobContext& job) {
    return FileReader(FileReader::Kind::SequenceHeader, subject, job).read(document);
}

Result<SourceCity> readSequenceFeature(JsonDocument& document, const SourceCity& header,
                                       const std::string& subject, const JobContext& job) {
    FileReader reader(FileReader::Kind::Feature, subject, job);
    reader.inherit(header);
    return reader.read(document);
}

}  // namespace reflet::cityjson
