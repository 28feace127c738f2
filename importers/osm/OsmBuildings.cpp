// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmBuildings.h"

#include "importers/osm/OsmHeights.h"
#include "importers/osm/Rings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace reflet::osm {

namespace {

using extrusion::Building;
using importers::Issue;

constexpr std::size_t kNoOwner = std::size_t(-1);

/// A building or a part of one, before it is known whose.
struct Candidate {
    Building building;
    bool isPart = false;
    double area = 0.0;  ///< square metres
    std::size_t owner = kNoOwner;
    double partsArea = 0.0;
    Box box;  ///< degrees
};

const extrusion::MetricScale& degrees() {
    static const extrusion::MetricScale scale(*Crs::parse("EPSG:4326"));
    return scale;
}

bool contains(const std::vector<glm::dvec2>& ring, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const glm::dvec2 a = ring[i], b = ring[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

/// A point well inside a counter-clockwise ring: beside the middle of its longest edge.
glm::dvec2 innerPoint(const std::vector<glm::dvec2>& ring) {
    constexpr double kInward = 0.02;  // of the edge
    std::size_t longest = 0;
    double length = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double l = glm::distance(ring[i], ring[(i + 1) % ring.size()]);
        if (l > length) {
            length = l;
            longest = i;
        }
    }
    const glm::dvec2 a = ring[longest], edge = ring[(longest + 1) % ring.size()] - a;
    return a + 0.5 * edge + kInward * glm::dvec2(-edge.y, edge.x);
}

/// Finds the building around a point by a grid of cells.
class OutlineIndex {
public:
    explicit OutlineIndex(const std::vector<Candidate>& candidates) : m_candidates(candidates) {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (!candidates[i].isPart && !candidates[i].building.polygons.empty())
                add(i);
        }
    }
    /// The smallest around a point.
    [[nodiscard]] std::size_t around(const glm::dvec2& p) const {
        std::size_t best = kNoOwner;
        const auto found = m_cells.find(key(cell(p.x), cell(p.y)));
        if (found == m_cells.end())
            return best;
        for (const std::size_t i : found->second) {
            const auto& polygons = m_candidates[i].building.polygons;
            const bool inside = std::any_of(
                polygons.begin(), polygons.end(),
                [&](const PlanPolygon& polygon) { return contains(polygon.rings.front(), p); });
            if (inside && (best == kNoOwner || m_candidates[i].area < m_candidates[best].area))
                best = i;
        }
        return best;
    }

private:
    static constexpr double kCell = 0.002;  // degrees
    static constexpr std::int64_t kWidest = 16;

    static std::int64_t cell(double degrees) { return std::int64_t(std::floor(degrees / kCell)); }
    static std::int64_t key(std::int64_t x, std::int64_t y) { return x * 1'000'003 + y; }
    void add(std::size_t i) {
        const Box& box = m_candidates[i].box;
        const std::int64_t x1 = std::min(cell(box.max.x), cell(box.min.x) + kWidest);
        const std::int64_t y1 = std::min(cell(box.max.y), cell(box.min.y) + kWidest);
        for (std::int64_t x = cell(box.min.x); x <= x1; ++x) {
            for (std::int64_t y = cell(box.min.y); y <= y1; ++y)
                m_cells[key(x, y)].push_back(i);
        }
    }

    const std::vector<Candidate>& m_candidates;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> m_cells;
};

class Collector {
public:
    Collector(const OsmData& data, double defaultHeight)
        : m_data(data), m_defaultHeight(defaultHeight) {}

    OsmBuildings run(const JobContext& job) {
        for (const Way& way : m_data.ways) {
            if (job.cancelled())
                return {};
            if (isBuilding(way.tags) || isBuildingPart(way.tags))
                add(fmt::format("way/{}", way.id), way.tags, areaOf(m_data, way));
        }
        for (const Relation& relation : m_data.relations) {
            if (job.cancelled())
                return {};
            // A relation of the type "building" only ties an outline to its parts.
            const bool isArea = relation.tags["type"] != "building";
            if (isArea && (isBuilding(relation.tags) || isBuildingPart(relation.tags)))
                add(fmt::format("relation/{}", relation.id), relation.tags,
                    areaOf(m_data, relation));
        }
        giveParts();
        return ordered();
    }

private:
    void add(std::string id, const Tags& tags, OsmArea area) {
        Candidate candidate;
        Building& building = candidate.building;
        candidate.isPart = isBuildingPart(tags) && !isBuilding(tags);
        building.outline.id = std::move(id);
        if (isUnderground(tags)) {
            building.notes.emplace_back(Issue::Underground, "");
        } else if (area.polygons.empty()) {
            building.notes.emplace_back(Issue::NoArea, area.problem);
        } else {
            if (area.repaired)
                building.notes.emplace_back(Issue::FootprintMended, area.problem);
            building.polygons = std::move(area.polygons);
            shape(candidate, tags);
        }
        m_candidates.push_back(std::move(candidate));
    }

    void shape(Candidate& candidate, const Tags& tags) {
        Building& building = candidate.building;
        const PlanPolygon& largest = building.polygons.front();
        const glm::dvec2 origin = largest.rings.front().front();
        const glm::dvec2 metres = degrees().at(origin);
        const OsmShape shape =
            shapeOf(tags, extrusion::inMetres(largest, origin, metres), m_defaultHeight);
        building.levels = shape.levels;
        building.roof = shape.roof;
        m_tally.assumed += shape.assumed ? 1 : 0;
        m_tally.unreadable += shape.unreadable ? 1 : 0;
        m_tally.unknownRoofs += shape.unknownRoof ? 1 : 0;
        ++m_tally.buildings;
        for (const PlanPolygon& polygon : building.polygons) {
            candidate.area += 0.5 * doubleArea(polygon.rings.front()) * metres.x * metres.y;
            for (const glm::dvec2& p : polygon.rings.front())
                candidate.box.add(glm::dvec3(p, 0.0));
        }
    }

    void giveParts() {
        const OutlineIndex outlines(m_candidates);
        for (Candidate& part : m_candidates) {
            if (!part.isPart || part.building.polygons.empty())
                continue;
            part.owner = outlines.around(innerPoint(part.building.polygons.front().rings.front()));
            if (part.owner != kNoOwner)
                m_candidates[part.owner].partsArea += part.area;
        }
    }

    OsmBuildings ordered() {
        std::unordered_map<std::size_t, std::vector<std::size_t>> partsOf;
        for (std::size_t i = 0; i < m_candidates.size(); ++i) {
            if (m_candidates[i].owner != kNoOwner)
                partsOf[m_candidates[i].owner].push_back(i);
        }
        OsmBuildings result;
        for (std::size_t i = 0; i < m_candidates.size(); ++i) {
            Candidate& candidate = m_candidates[i];
            if (candidate.owner != kNoOwner)
                continue;
            const std::string id = candidate.building.outline.id;
            const auto parts = partsOf.find(i);
            const bool hasParts = parts != partsOf.end();
            if (hasParts && 2.0 * candidate.partsArea >= candidate.area) {
                candidate.building.polygons.clear();
                candidate.building.notes.emplace_back(Issue::ShownByParts, "");
            }
            emit(result, std::move(candidate), CityObjectType::Building, {}, hasParts);
            for (std::size_t k = 0; hasParts && k < parts->second.size(); ++k)
                emit(result, std::move(m_candidates[parts->second[k]]),
                     CityObjectType::BuildingPart, id, false);
        }
        result.tally = m_tally;
        return result;
    }

    static void emit(OsmBuildings& result, Candidate candidate, CityObjectType type,
                     const std::string& parent, bool hasParts) {
        importers::ObjectOutline& outline = candidate.building.outline;
        outline.type = type;
        outline.typeName = toString(type);
        outline.hasChildren = hasParts;
        if (!parent.empty())
            outline.parentIds.push_back(parent);
        result.buildings.push_back(std::move(candidate.building));
    }

    const OsmData& m_data;
    double m_defaultHeight;
    std::vector<Candidate> m_candidates;
    OsmTally m_tally;
};

}  // namespace

OsmBuildings buildingsOf(const OsmData& data, double defaultHeight, const JobContext& job) {
    return Collector(data, defaultHeight).run(job);
}

}  // namespace reflet::osm
