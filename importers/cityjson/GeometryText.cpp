// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/GeometryText.h"

#include "importers/common/ObjectNames.h"

#include <fmt/core.h>

#include <algorithm>

namespace reflet::cityjson {

namespace {

class GeometryTextReader {
public:
    GeometryTextReader(const SourceCity& file, Noter note, GeometryText& into)
        : m_file(file), m_note(note), m_into(into), m_depth(boundaryDepth(into.type)) {}

    void read(JsonValue value) {
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "boundaries")
                member.nestedIndices(m_into.type == GeometryType::Instance ? 1 : m_depth,
                                     m_into.boundaries);
            else if (m_depth == 0)
                readMatrix(key, member);
            else if (key == "semantics")
                readSemantics(member);
            else if (key == "material")
                readMaterials(member);
            else if (key == "texture")
                readTextures(member);
        });
    }

private:
    void readMatrix(std::string_view key, JsonValue value) {
        if (key == "transformationMatrix")
            m_into.matrix = value.numbers<16>();
    }

    void readSemantics(JsonValue value) {
        value.forEachMember([&](std::string_view key, JsonValue member) {
            if (key == "values" && !member.isNull()) {
                member.nestedIndices(m_depth - 2, m_into.semantics);
            } else if (key == "surfaces") {
                member.forEachElement([&](JsonValue surface) {
                    std::string name;
                    surface.forEachMember([&](std::string_view part, JsonValue text) {
                        if (part == "type")
                            name = text.string().value_or("");
                    });
                    m_into.semanticTypes.push_back(surfaceType(name));
                });
            }
        });
    }

    /// Whether this theme replaces what was read before.
    bool prefer(std::string_view theme, std::string& chosen, bool& any,
                const std::string& standard) const {
        const bool better = !any || (theme == standard && chosen != standard);
        any = true;
        if (better)
            chosen = std::string(theme);
        return better;
    }

    void readMaterials(JsonValue value) {
        bool any = false;
        value.forEachMember([&](std::string_view theme, JsonValue member) {
            std::optional<std::uint32_t> single;
            m_scratch.clear();
            member.forEachMember([&](std::string_view key, JsonValue entry) {
                if (key == "value")
                    single = entry.isNull() ? std::nullopt
                                            : std::optional(entry.index().value_or(kBadIndex));
                else if (key == "values" && !entry.isNull())
                    entry.nestedIndices(m_depth - 2, m_scratch);
            });
            checkMaterials(theme, single);
            if (!prefer(theme, m_into.materialTheme, any, m_file.defaultMaterialTheme))
                return;
            m_into.material = single;
            std::swap(m_into.materials, m_scratch);
        });
    }

    void checkMaterials(std::string_view theme, const std::optional<std::uint32_t>& single) {
        const std::size_t known = m_file.materials.size();
        if (known == 0) {
            m_into.materialsWithoutAppearance = true;
            return;
        }
        std::uint32_t worst = kNullIndex;
        std::size_t bad = 0;
        const auto check = [&](std::uint32_t index) {
            if (index == kNullIndex || index < known)
                return;
            if (bad++ == 0)
                worst = index;
        };
        if (single)
            check(*single);
        for (const std::uint32_t leaf : m_scratch.leaves)
            check(leaf);
        if (bad > 0) {
            m_note(Issue::MaterialIndex,
                   worst == kBadIndex
                       ? fmt::format("theme {:.40}: an entry is no index", theme)
                       : fmt::format("theme {:.40}: material {}, counted from 0, of {}", theme,
                                     worst, known),
                   bad);
        }
    }

    void readTextures(JsonValue value) {
        bool any = false;
        value.forEachMember([&](std::string_view theme, JsonValue member) {
            m_scratch.clear();
            member.forEachMember([&](std::string_view key, JsonValue entry) {
                if (key == "values" && !entry.isNull())
                    entry.nestedIndices(m_depth, m_scratch);
            });
            if (prefer(theme, m_into.textureTheme, any, m_file.defaultTextureTheme))
                std::swap(m_into.textures, m_scratch);
        });
    }

    const SourceCity& m_file;
    Noter m_note;
    GeometryText& m_into;
    int m_depth;
    NestedIndices m_scratch;
};

}  // namespace

void readGeometryText(JsonValue value, const SourceCity& file, GeometryType type, Noter note,
                      GeometryText& into) {
    into.type = type;
    into.boundaries.clear();
    into.semanticTypes.clear();
    into.semantics.clear();
    into.material.reset();
    into.materials.clear();
    into.materialTheme.clear();
    into.materialsWithoutAppearance = false;
    into.textures.clear();
    into.textureTheme.clear();
    into.matrix.reset();
    GeometryTextReader(file, note, into).read(value);
}

}  // namespace reflet::cityjson
