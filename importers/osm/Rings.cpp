// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/Rings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace reflet::osm {

namespace {

using Nodes = std::vector<std::int64_t>;
using Ring = std::vector<glm::dvec2>;

/// The places of nodes; those that are missing are left out and counted.
Ring placesOf(const OsmData& data, const Nodes& nodes, std::size_t& missing) {
    Ring ring;
    ring.reserve(nodes.size());
    for (const std::int64_t node : nodes) {
        if (const auto place = data.place(node))
            ring.push_back(*place);
        else
            ++missing;
    }
    return ring;
}

bool isClosed(const Nodes& nodes) {
    return nodes.size() >= 4 && nodes.front() == nodes.back();
}

/// Joins ways at their ends to closed rings; what stays open is counted.
std::vector<Nodes> joined(std::vector<Nodes> ways, std::size_t& open) {
    std::vector<Nodes> rings;
    std::unordered_multimap<std::int64_t, std::size_t> ends;
    std::vector<bool> used(ways.size(), false);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (isClosed(ways[i])) {
            used[i] = true;
            rings.push_back(ways[i]);
        } else if (ways[i].size() >= 2) {
            ends.emplace(ways[i].front(), i);
            ends.emplace(ways[i].back(), i);
        } else {
            used[i] = true;
        }
    }
    const auto next = [&](std::int64_t node) -> std::optional<std::size_t> {
        const auto [first, last] = ends.equal_range(node);
        for (auto it = first; it != last; ++it) {
            if (!used[it->second])
                return it->second;
        }
        return std::nullopt;
    };
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (used[i])
            continue;
        used[i] = true;
        Nodes ring = ways[i];
        while (ring.front() != ring.back()) {
            const auto way = next(ring.back());
            if (!way)
                break;
            used[*way] = true;
            Nodes& more = ways[*way];
            if (more.front() != ring.back())
                std::reverse(more.begin(), more.end());
            ring.insert(ring.end(), more.begin() + 1, more.end());
        }
        if (isClosed(ring))
            rings.push_back(std::move(ring));
        else
            ++open;
    }
    return rings;
}

bool contains(const Ring& ring, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const glm::dvec2 a = ring[i], b = ring[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

/// Where most points of a hole lie: a corner may touch the outer ring.
bool liesIn(const Ring& outer, const Ring& hole) {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < hole.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (hole[i] + hole[(i + 1) % hole.size()]);
        inside += contains(outer, middle) ? 1 : 0;
    }
    return 2 * inside > hole.size();
}

void mendInto(OsmArea& area, PlanPolygon polygon) {
    MendedPolygons mended = mendPolygon(std::move(polygon));
    area.repaired = area.repaired || mended.repaired || mended.polygons.empty();
    if (!mended.problem.empty())
        area.problem = mended.problem;
    std::move(mended.polygons.begin(), mended.polygons.end(), std::back_inserter(area.polygons));
}

void noteMissing(OsmArea& area, std::size_t nodes, std::size_t ways, std::size_t open) {
    const auto say = [&](std::size_t count, const char* what) {
        if (count == 0)
            return;
        area.repaired = true;
        area.problem =
            fmt::format("{}{}{} {}", area.problem, area.problem.empty() ? "" : "; ", count, what);
    };
    say(nodes, "of its nodes are not in the file");
    say(ways, "of its ways are not in the file");
    say(open, "of its rings cannot be closed");
}

}  // namespace

OsmArea areaOf(const OsmData& data, const Way& way) {
    OsmArea area;
    if (!isClosed(way.nodes)) {
        area.problem = "its line is not closed";
        return area;
    }
    std::size_t missing = 0;
    PlanPolygon polygon{{placesOf(data, way.nodes, missing)}};
    mendInto(area, std::move(polygon));
    noteMissing(area, missing, 0, 0);
    return area;
}

OsmArea areaOf(const OsmData& data, const Relation& relation) {
    std::vector<Nodes> outer, inner;
    std::size_t missingWays = 0, missingNodes = 0, open = 0;
    for (const Member& member : relation.members) {
        if (member.isRelation || (member.role != "inner" && member.role != "outer" &&
                                  member.role != "outline" && !member.role.empty()))
            continue;
        const Way* const way = data.way(member.way);
        if (way == nullptr)
            ++missingWays;
        else
            (member.role == "inner" ? inner : outer).push_back(way->nodes);
    }
    std::vector<PlanPolygon> polygons;
    for (const Nodes& ring : joined(std::move(outer), open))
        polygons.push_back({{placesOf(data, ring, missingNodes)}});
    std::size_t strays = 0;
    for (const Nodes& ring : joined(std::move(inner), open)) {
        Ring hole = placesOf(data, ring, missingNodes);
        const auto around = std::find_if(
            polygons.begin(), polygons.end(),
            [&](const PlanPolygon& polygon) { return liesIn(polygon.rings.front(), hole); });
        if (around != polygons.end())
            around->rings.push_back(std::move(hole));
        else
            ++strays;
    }
    OsmArea area;
    for (PlanPolygon& polygon : polygons)
        mendInto(area, std::move(polygon));
    noteMissing(area, missingNodes, missingWays, open + strays);
    if (area.polygons.empty() && area.problem.empty())
        area.problem = "it has no outer ring";
    return area;
}

}  // namespace reflet::osm
