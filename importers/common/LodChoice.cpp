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

/// The object that a surface bounds, each other object itself: they show one level together.
std::vector<std::uint32_t> hostsOf(const SourceCity& file, const ObjectTree& tree) {
    std::vector<std::uint32_t> host(file.objects.size());
    for (auto i = tree.childrenFirst.rbegin(); i != tree.childrenFirst.rend(); ++i) {
        const std::uint32_t parent = tree.parent[*i];
        host[*i] = file.objects[*i].isBoundary && parent != kNone ? host[parent] : *i;
    }
    return host;
}

/// The highest level of each host among those that `accept` takes.
template <class Accept>
std::vector<std::optional<std::uint32_t>> highestOfHosts(const SourceCity& file,
                                                         const std::vector<std::uint32_t>& host,
                                                         const Accept& accept) {
    std::vector<std::optional<std::uint32_t>> best(host.size());
    for (std::size_t i = 0; i < host.size(); ++i) {
        const auto own = ObjectGeometries(file, i).highest(accept);
        auto& known = best[host[i]];
        if (own && (!known || lodRank(file.lodNames[*own]) > lodRank(file.lodNames[*known])))
            known = own;
    }
    return best;
}

std::vector<bool> chooseHighest(const SourceCity& file, const ObjectTree& tree) {
    const std::size_t count = file.objects.size();
    const auto host = hostsOf(file, tree);
    const auto best = highestOfHosts(file, host, [](std::uint32_t, LodRank) { return true; });

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
        const auto& level = best[host[i]];
        if (level && lodRank(file.lodNames[*level]) >= ofParts[host[i]])
            ObjectGeometries(file, i).take(*level, chosen);
    }
    return chosen;
}

std::vector<bool> chooseValue(const SourceCity& file, const ObjectTree& tree,
                              const std::string& lod) {
    const LodRank wanted = lodRank(lod);
    const bool whole = lod.find('.') == std::string::npos;
    const auto host = hostsOf(file, tree);
    const auto exact = highestOfHosts(
        file, host, [&](std::uint32_t index, LodRank) { return file.lodNames[index] == lod; });
    const auto like = highestOfHosts(file, host, [&](std::uint32_t, LodRank rank) {
        return wanted.major >= 0 && (rank == wanted || (whole && rank.major == wanted.major));
    });
    std::vector<bool> chosen(file.geometries.size(), false);
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
        const auto& level = exact[host[i]] ? exact[host[i]] : like[host[i]];
        if (level)
            ObjectGeometries(file, i).take(*level, chosen);
    }
    return chosen;
}

}  // namespace

bool isOneLevel(const std::string& lod) {
    return lod != "highest" && lod != "all" && !lod.empty();
}

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

std::string lodOfObject(const SourceCity& file, const std::vector<bool>& chosen,
                        std::uint32_t object) {
    const ObjectOutline& outline = file.objects[object];
    for (std::uint32_t g = outline.firstGeometry; g < outline.firstGeometry + outline.geometryCount;
         ++g) {
        if (chosen[g])
            return file.lodNames[lodOf(file.geometries[g], file)];
    }
    return {};
}

std::vector<bool> chooseGeometries(const SourceCity& file, const ObjectTree& tree,
                                   const std::string& lod) {
    if (lod == "highest" || lod.empty())
        return chooseHighest(file, tree);
    if (lod != "all")
        return chooseValue(file, tree, lod);
    std::vector<bool> chosen(file.geometries.size());
    for (std::size_t g = 0; g < chosen.size(); ++g)
        chosen[g] = hasSurfaces(file.geometries[g].type);
    return chosen;
}

}  // namespace reflet::importers
