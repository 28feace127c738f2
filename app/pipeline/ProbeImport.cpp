// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Edit.h"
#include "app/pipeline/ProbeFiles.h"
#include "core/baking/EnvironmentBaker.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace reflet {

namespace {

constexpr double kSamePlace = 0.01;  // metres

/// Places to a centimetre, to find one again. Two that lie within it may fall into neighbouring
/// cells: those are asked too.
class Places {
public:
    [[nodiscard]] bool has(const glm::dvec3& place) const {
        const Cell cell = cellOf(place);
        for (int k = 0; k < 27; ++k) {
            const auto found = m_places.lower_bound(
                {cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
            if (found != m_places.end() &&
                *found == Cell{cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1})
                return true;
        }
        return false;
    }
    void add(const glm::dvec3& place) { m_places.insert(cellOf(place)); }

private:
    using Cell = std::array<std::int64_t, 3>;
    static Cell cellOf(const glm::dvec3& p) {
        return {std::llround(p.x / kSamePlace), std::llround(p.y / kSamePlace),
                std::llround(p.z / kSamePlace)};
    }
    std::set<Cell> m_places;
};

bool inCity(const GridSpec& grid, const glm::dvec3& local) {
    return grid.contains(grid.column(local.x), grid.row(local.y));
}

/// Adds probes one by one, and tells what became of them.
class Importer {
public:
    Importer(const PreparedCity& city, const RadianceScene& scene, bool movable)
        : m_city(city), m_scene(scene), m_locked(!movable) {
        m_out.project = city.project();
        for (const Probe& probe : m_out.project.probes) {
            m_ids.insert(probe.id);
            m_places.add(probe.position);
        }
    }

    void add(const ImportedProbe& read) {
        glm::dvec3 local = m_city.inFrame(read.position);
        if (!inCity(m_city.heightfield().grid, local)) {
            ++outside;
            tell("probe-outside", read, "It lies outside of the city; it was left out.",
                 "Check its coordinates, and which system they are in.");
            return;
        }
        glm::dvec3 position = read.position;
        if (std::isnan(position.z)) {
            ++m_out.withoutHeight;
            position.z =
                m_city.groundHeight(local.x, local.y) + kProbeHeight + m_out.project.frame.origin.z;
            local = m_city.inFrame(position);
        }
        if (m_places.has(position)) {
            tell("probe-twice", read, "A probe stands there already; it was left out.", "");
            return;
        }
        put(read, position, local);
    }

    std::size_t outside = 0;
    [[nodiscard]] ProbeImport take() && { return std::move(m_out); }

private:
    void put(const ImportedProbe& read, const glm::dvec3& position, const glm::dvec3& local) {
        const std::string id = freeId(read.id);
        if (!read.id.empty() && id != read.id)
            tell("probe-renamed", read,
                 fmt::format("There is a probe {} already; it is called {} now.", read.id, id), "",
                 Severity::Info);
        if (const auto wrong = placeError(m_scene, &m_city.heightfield(), id, local)) {
            ++m_out.inSolids;
            m_out.remarks.push_back({Severity::Warning, "probe-in-solid", id,
                                     wrong->what + ": it cannot be baked there.", wrong->remedy});
        }
        m_out.project.probes.push_back({id, position, read.resolution, m_locked});
        m_out.added.push_back(id);
        m_places.add(position);
    }

    std::string freeId(const std::string& wish) {
        std::string id = wish;
        while (id.empty() || !m_ids.insert(id).second) {
            const std::size_t n = ++m_numbers[wish];
            id = wish.empty() ? fmt::format("probe-{}", n) : fmt::format("{}-{}", wish, n + 1);
        }
        return id;
    }

    void tell(const char* code, const ImportedProbe& read, std::string text, std::string remedy,
              Severity severity = Severity::Warning) {
        m_out.remarks.push_back({severity, code,
                                 read.id.empty() ? read.where : read.id + " (" + read.where + ")",
                                 std::move(text), std::move(remedy)});
    }

    const PreparedCity& m_city;
    const RadianceScene& m_scene;
    bool m_locked;
    ProbeImport m_out;
    std::set<std::string> m_ids;
    std::map<std::string, std::size_t> m_numbers;
    Places m_places;
};

}  // namespace

Result<ProbeImport> withProbes(const PreparedCity& city, const std::vector<ImportedProbe>& probes,
                               bool movable, const JobContext& job) {
    const auto scene = city.scene(job.phase("reading the city", 0.0, 0.5));
    if (!scene)
        return tl::unexpected(scene.error());
    Importer importer(city, **scene, movable);
    for (const ImportedProbe& probe : probes) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        importer.add(probe);
    }
    if (!probes.empty() && importer.outside == probes.size())
        return fail(ErrorCode::Refused,
                    fmt::format("all {} probes lie outside of the city", probes.size()),
                    city.project().name,
                    "Check which coordinate reference system they are in: name it in the file, "
                    "e.g. by a column epsg.");
    return std::move(importer).take();
}

}  // namespace reflet
