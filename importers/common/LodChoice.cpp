// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/LodChoice.h"

#include "importers/common/ObjectNames.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace reflet::importers {

namespace {

bool hasSurfaces(GeometryType type) {
    return boundaryDepth(type) > 0 || type == GeometryType::Instance;
}

bool parseWhole(std::string_view text, int& value) {
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && at == end && value >= 0;
}

/// The geometries of one object.
class ObjectGeometries {
public:
    ObjectGeometries(const SourceCity& file, std::size_t object) : m_file(file) {
        m_first = file.objects[object].firstGeometry;
        m_last = m_first + file.objects[object].geometryCount;
    }

    template <class Accept>
    [[nodiscard]] std::optional<std::uint32_t> highest(const Accept& accept) const {
        std::optional<std::uint32_t> best;
        for (std::uint32_t g = m_first; g < m_last; ++g) {
            if (!hasSurfaces(m_file.geometries[g].type))
                continue;
            const std::uint32_t lod = lodOf(m_file.geometries[g], m_file);
            const LodRank rank = lodRank(m_file.lodNames[lod]);
            if (accept(lod, rank) && (!best || rank > lodRank(m_file.lodNames[*best])))
                best = lod;
        }
        return best;
    }

    void take(std::uint32_t lod, std::vector<bool>& chosen) const {
        for (std::uint32_t g = m_first; g < m_last; ++g) {
            chosen[g] = hasSurfaces(m_file.geometries[g].type) &&
                        lodOf(m_file.geometries[g], m_file) == lod;
        }
    }

private:
    const SourceCity& m_file;
    std::uint32_t m_first = 0;
    std::uint32_t m_last = 0;
};

std::vector<bool> chooseHighest(const SourceCity& file, const ObjectTree& tree) {
    const std::size_t count = file.objects.size();
    std::vector<std::optional<std::uint32_t>> best(count);
    for (std::size_t i = 0; i < count; ++i)
        best[i] = ObjectGeometries(file, i).highest([](std::uint32_t, LodRank) { return true; });

    // A part speaks for its parent, and what speaks for a part speaks for the parent too.
    constexpr LodRank kNothing{-2, 0};
    std::vector<LodRank> ofParts(count, kNothing);
    for (const std::uint32_t i : tree.childrenFirst) {
        const std::uint32_t parent = tree.parent[i];
        if (parent == kNone || !isPart(file.objects[i].typeName))
            continue;
        const LodRank own = best[i] ? lodRank(file.lodNames[*best[i]]) : kNothing;
        ofParts[parent] = std::max({ofParts[parent], ofParts[i], own});
    }
    std::vector<bool> chosen(file.geometries.size(), false);
    for (std::size_t i = 0; i < count; ++i) {
        if (best[i] && lodRank(file.lodNames[*best[i]]) >= ofParts[i])
            ObjectGeometries(file, i).take(*best[i], chosen);
    }
    return chosen;
}

std::vector<bool> chooseValue(const SourceCity& file, const std::string& lod) {
    const LodRank wanted = lodRank(lod);
    const bool whole = lod.find('.') == std::string::npos;
    std::vector<bool> chosen(file.geometries.size(), false);
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
        const ObjectGeometries geometries(file, i);
        auto best = geometries.highest(
            [&](std::uint32_t index, LodRank) { return file.lodNames[index] == lod; });
        if (!best && wanted.major >= 0) {
            best = geometries.highest([&](std::uint32_t, LodRank rank) {
                return rank == wanted || (whole && rank.major == wanted.major);
            });
        }
        if (best)
            geometries.take(*best, chosen);
    }
    return chosen;
}

}  // namespace

LodRank lodRank(std::string_view lod) {
    LodRank rank;
    const std::size_t dot = lod.find('.');
    if (!parseWhole(lod.substr(0, dot), rank.major))
        return {};
    if (dot != std::string_view::npos && !parseWhole(lod.substr(dot + 1), rank.minor))
        return {};
    return rank;
}

std::uint32_t lodOf(const GeometryOutline& geometry, const SourceCity& file) {
    if (geometry.type == GeometryType::Instance && geometry.templateIndex < file.templates.size())
        return file.templates[geometry.templateIndex].lod;
    return geometry.lod;
}

std::vector<bool> chooseGeometries(const SourceCity& file, const ObjectTree& tree,
                                   const std::string& lod) {
    if (lod == "highest" || lod.empty())
        return chooseHighest(file, tree);
    if (lod != "all")
        return chooseValue(file, lod);
    std::vector<bool> chosen(file.geometries.size());
    for (std::size_t g = 0; g < chosen.size(); ++g)
        chosen[g] = hasSurfaces(file.geometries[g].type);
    return chosen;
}

}  // namespace reflet::importers
