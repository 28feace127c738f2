// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "importers/osm/OsmImporter.h"
#include "importers/osm/OsmReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace reflet {

namespace {

constexpr double kShortest = 50.0;  // metres

bool isTram(const osm::Tags& tags) {
    return (tags["railway"] == "tram" || tags["railway"] == "light_rail") &&
           tags["service"].empty();
}

bool isStreet(const osm::Tags& tags) {
    static constexpr std::array<std::string_view, 9> kStreets{
        "motorway",     "trunk",       "primary",       "secondary", "tertiary",
        "unclassified", "residential", "living_street", "busway"};
    return std::find(kStreets.begin(), kStreets.end(), tags["highway"]) != kStreets.end() &&
           tags["area"] != "yes";
}

bool isDriven(const osm::Tags& tags) {
    return isTram(tags) || isStreet(tags);
}

bool nothing(const osm::Tags& /*tags*/) {
    return false;
}

using Nodes = std::vector<std::int64_t>;

/// Ways of one line, put together end to end as far as they follow each other.
class Chains {
public:
    explicit Chains(const std::vector<const osm::Way*>& ways) {
        for (const osm::Way* way : ways) {
            if (way->nodes.size() < 2)
                continue;
            m_ends.emplace(way->nodes.front(), m_ways.size());
            m_ends.emplace(way->nodes.back(), m_ways.size());
            m_ways.push_back(way->nodes);
        }
        m_used.assign(m_ways.size(), false);
    }

    std::vector<Nodes> all() {
        std::vector<Nodes> chains;
        for (std::size_t i = 0; i < m_ways.size(); ++i) {
            if (m_used[i])
                continue;
            m_used[i] = true;
            Nodes chain = m_ways[i];
            extend(chain);
            std::reverse(chain.begin(), chain.end());
            extend(chain);
            std::reverse(chain.begin(), chain.end());
            chains.push_back(std::move(chain));
        }
        return chains;
    }

private:
    /// At the back. Where a line forks, any of its branches goes on.
    void extend(Nodes& chain) {
        while (chain.front() != chain.back()) {
            const auto [first, last] = m_ends.equal_range(chain.back());
            const auto found =
                std::find_if(first, last, [&](const auto& end) { return !m_used[end.second]; });
            if (found == last)
                return;
            m_used[found->second] = true;
            Nodes more = m_ways[found->second];
            if (more.front() != chain.back())
                std::reverse(more.begin(), more.end());
            chain.insert(chain.end(), more.begin() + 1, more.end());
        }
    }

    std::vector<Nodes> m_ways;
    std::unordered_multimap<std::int64_t, std::size_t> m_ends;
    std::vector<bool> m_used;
};

double lengthOf(const GeoLine& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
        length += std::hypot(line.points[i].x - line.points[i - 1].x,
                             line.points[i].y - line.points[i - 1].y);
    return length;
}

std::string nameOf(const osm::Way& way) {
    const std::string_view name = way.tags.first({"name", "ref"});
    return name.empty() ? fmt::format("way {}", way.id) : std::string(name);
}

Result<GeoLine> lineOf(const osm::OsmData& data, const Nodes& nodes, const std::string& name,
                       const CrsTransform& transform) {
    GeoLine line{name, {}};
    for (const std::int64_t node : nodes) {
        if (const auto place = data.place(node))
            line.points.emplace_back(*place, 0.0);
    }
    if (auto done = transform.apply(line.points); !done)
        return tl::unexpected(done.error());
    for (glm::dvec3& p : line.points)
        p.z = std::numeric_limits<double>::quiet_NaN();
    return line;
}

/// The longest first; further lines of one name get numbers.
Result<std::vector<GeoLine>> linesOf(const osm::OsmData& data, bool trams,
                                     const CrsTransform& transform) {
    std::map<std::string, std::vector<const osm::Way*>> byName;
    for (const osm::Way& way : data.ways) {
        if (isTram(way.tags) == trams)
            byName[nameOf(way)].push_back(&way);
    }
    std::vector<std::pair<double, GeoLine>> lines;
    for (const auto& [name, ways] : byName) {
        for (const Nodes& chain : Chains(ways).all()) {
            auto line = lineOf(data, chain, name, transform);
            if (!line)
                return tl::unexpected(line.error());
            const double length = lengthOf(*line);
            if (length >= kShortest)
                lines.emplace_back(length, *std::move(line));
        }
    }
    std::stable_sort(lines.begin(), lines.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<GeoLine> sorted;
    std::map<std::string, int> seen;
    for (auto& [length, line] : lines) {
        const int number = ++seen[line.name];
        if (number > 1)
            line.name += fmt::format(" ({})", number);
        sorted.push_back(std::move(line));
    }
    return sorted;
}

}  // namespace

Result<OsmRoutes> readOsmRoutes(const std::filesystem::path& path, const ProjectFrame& frame,
                                const JobContext& job) {
    if (!frame.crs)
        return fail(ErrorCode::Refused,
                    "its lines have a place on the Earth, and the project is in local metres",
                    path.string(), "Give the project a coordinate reference system.");
    const auto degrees = Crs::parse("EPSG:4326"), target = Crs::parse(*frame.crs);
    if (!degrees || !target)
        return tl::unexpected(degrees ? target.error() : degrees.error());
    const auto transform = CrsTransform::create(*degrees, *target);
    if (!transform)
        return tl::unexpected(transform.error());
    const auto data = osm::readOsm({path}, {isDriven, nothing}, job);
    if (!data)
        return tl::unexpected(data.error());
    auto trams = linesOf(*data, true, *transform), streets = linesOf(*data, false, *transform);
    if (!trams || !streets)
        return tl::unexpected(trams ? streets.error() : trams.error());
    OsmRoutes routes{*std::move(trams), 0};
    routes.trams = routes.lines.size();
    std::move(streets->begin(), streets->end(), std::back_inserter(routes.lines));
    if (routes.lines.empty())
        return fail(ErrorCode::Unreadable, "it holds no tram line and no street", path.string(),
                    "Choose an extract that has them, or draw the route as a line.");
    return routes;
}

bool isOsmFile(const std::filesystem::path& path) {
    constexpr std::size_t kHead = 1024;
    std::ifstream file(path, std::ios::binary);
    std::string head(kHead, '\0');
    file.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(std::max<std::streamsize>(file.gcount(), 0)));
    return osm::looksLikeOsmXml(head) || osm::looksLikeOsmPbf(head);
}

}  // namespace reflet
