// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/SpanBuilder.h"

#include "core/heightfield/CenterCrossing.h"
#include "core/heightfield/ClosedHollows.h"
#include "core/heightfield/ColumnSolids.h"
#include "core/heightfield/RowProfile.h"
#include "core/heightfield/TriangleJobs.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kMostRecords = 4'000'000;  // at a time
constexpr std::size_t kColumnsPerTask = 1024;

/// Ranks of candidates: [first, last).
struct Band {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

bool facesDown(const TriangleCorners& t) {
    return glm::cross(t[1] - t[0], t[2] - t[0]).z < 0.0;
}

/// The spans of consecutive candidates.
struct SpanList {
    std::vector<std::uint32_t> cells;
    std::vector<std::uint32_t> first{0};
    std::vector<HeightSpan> spans;

    void add(std::uint32_t cell, const std::vector<HeightSpan>& column) {
        if (column.empty())
            return;
        cells.push_back(cell);
        spans.insert(spans.end(), column.begin(), column.end());
        first.push_back(std::uint32_t(spans.size()));
    }
    void append(const SpanList& other) {
        for (std::size_t n = 0; n < other.cells.size(); ++n) {
            cells.push_back(other.cells[n]);
            first.push_back(std::uint32_t(spans.size()) + other.first[n + 1]);
        }
        spans.insert(spans.end(), other.spans.begin(), other.spans.end());
    }
    [[nodiscard]] CellSpans taken(std::size_t cellCount) {
        return {cellCount, cells, std::move(first), std::move(spans)};
    }
};

class SpanBuilder {
public:
    SpanBuilder(Heightfield& field, const CityModel& city, const HeightRules& rules,
                const JobContext& job)
        : m_field(field),
          m_city(city),
          m_rules(rules),
          m_job(job),
          m_plan(field.grid, city.frame) {}

    Result<void> build() {
        if (!markCandidates(m_job.phase("overhead", 0.0, 0.4)))
            return tl::unexpected(JobContext::cancelledError());
        if (m_candidates.count() == 0)
            return {};
        m_counts.assign(m_candidates.count(), 0);
        const Band all{0, m_candidates.count()};
        if (!visitRecords(all, m_job.phase("overhead", 0.4, 0.6),
                          [&](std::uint32_t n, const SpanRecord&) {
                              std::atomic_ref(m_counts[n]).fetch_add(1, std::memory_order_relaxed);
                          }))
            return tl::unexpected(JobContext::cancelledError());
        for (Band band{0, 0}; band.last < all.last;) {
            band = bandFrom(band.last);
            if (!buildBand(band))
                return tl::unexpected(JobContext::cancelledError());
            m_job.progress(0.6 + 0.4 * double(band.last) / double(all.last));
        }
        m_field.spans = m_maximum.taken(m_field.grid.cellCount());
        m_field.centerSpans = m_center.taken(m_field.grid.cellCount());
        fillClosedHollows(m_field, m_rules.clearance, m_tunnels);
        return {};
    }

private:
    [[nodiscard]] HeightPolicy policy(std::size_t triangle) const {
        return policyOf(m_city, m_rules, m_city.triangles[triangle].surface);
    }

    template <class Visit>
    bool rasterize(const Visit& visit, const JobContext& job) {
        const auto cornersAt = [&](std::size_t n) {
            return cornersOf(m_city, m_city.triangles[n]);
        };
        return Rasterizer(m_plan, cornersAt, visit, job).run(m_city.triangles.size());
    }

    /// Columns with a surface above the ground that may be an underside.
    bool markCandidates(const JobContext& job) {
        const GridSpec& grid = m_field.grid;
        std::vector<std::uint64_t> words(grid.cellCount() / 64 + 1, 0);
        const auto mark = [&](std::size_t n, const TriangleCorners& corners, CellRange rows) {
            const HeightPolicy policy = this->policy(n);
            if (policy < HeightPolicy::Solid)
                return;
            if (policy == HeightPolicy::Solid && !facesDown(corners))
                return;
            const bool buried = policy == HeightPolicy::Tunnel;
            const double top = std::max({corners[0].z, corners[1].z, corners[2].z});
            const auto above = [&](int i, int j, double height) {
                const float ground = m_field.ground[grid.index(i, j)];
                return !isMissing(ground) &&
                       (buried || height > double(ground) + m_rules.clearance);
            };
            visitPieces(
                m_plan, corners, rows, [&](int i, int j) { return above(i, j, top); },
                [&](int i, int j, double, double highest) {
                    const std::size_t cell = grid.index(i, j);
                    if (above(i, j, highest))
                        std::atomic_ref(words[cell / 64])
                            .fetch_or(std::uint64_t(1) << (cell % 64), std::memory_order_relaxed);
                });
        };
        const bool done = rasterize(mark, job);
        m_candidates = CellMask(std::move(words));
        return done;
    }

    /// As many candidates as the limit allows, one at least.
    [[nodiscard]] Band bandFrom(std::uint32_t first) const {
        Band band{first, first};
        std::size_t records = 0;
        do
            records += m_counts[band.last++];
        while (band.last < m_counts.size() && records + m_counts[band.last] <= kMostRecords);
        return band;
    }

    /// Calls use(rank, record) for what every triangle leaves in the candidates of the band.
    template <class Use>
    bool visitRecords(const Band& band, const JobContext& job, const Use& use) {
        const GridSpec& grid = m_field.grid;
        const auto visit = [&](std::size_t n, const TriangleCorners& corners, CellRange rows) {
            const CitySurface& surface = m_city.surfaces[m_city.triangles[n].surface];
            SpanRecord record{surface.object, {}, policy(n), 0, 0, 0.0F, 0.0F};
            const bool plate = surface.type == SurfaceType::Ground;
            if (record.policy == HeightPolicy::None ||
                (record.policy == HeightPolicy::Column && plate))
                return;
            if (m_candidates.rank(grid.index(0, rows.last - 1) + std::size_t(grid.columns)) <=
                    band.first ||
                m_candidates.rank(grid.index(0, rows.first)) >= band.last)
                return;
            const auto wanted = [&](int i, int j) {
                const std::size_t cell = grid.index(i, j);
                if (!m_candidates.has(cell))
                    return false;
                const std::uint32_t rank = m_candidates.rank(cell);
                return rank >= band.first && rank < band.last;
            };
            visitPieces(m_plan, corners, rows, wanted, [&](int i, int j, double low, double high) {
                const std::uint32_t rank = m_candidates.rank(grid.index(i, j));
                record.kind = SpanRecord::Kind::Piece;
                record.beside = 0;
                record.facing = 0;
                record.low = roundedDown(low) + 0.0F;
                record.high = roundedUp(high) + 0.0F;
                use(rank, record);
                const auto crossing = crossingAt(corners, m_plan.columns.center[std::size_t(i)],
                                                 m_plan.rows.center[std::size_t(j)]);
                if (!crossing)
                    return;
                record.kind = SpanRecord::Kind::Crossing;
                record.beside = crossing->beside;
                record.facing = crossing->facing;
                record.low = record.high = float(crossing->z) + 0.0F;
                use(rank, record);
            });
        };
        return rasterize(visit, job);
    }

    bool buildBand(const Band& band) {
        std::vector<std::size_t> first(band.last - band.first + 1, 0);
        for (std::uint32_t n = band.first; n < band.last; ++n)
            first[n - band.first + 1] = first[n - band.first] + m_counts[n];
        std::vector<std::size_t> next(first.begin(), first.end() - 1);
        std::vector<SpanRecord> records(first.back());
        const bool done = visitRecords(
            band, JobContext({}, m_job.stopToken()),
            [&](std::uint32_t n, const SpanRecord& record) {
                std::size_t& place = next[n - band.first];
                records[std::atomic_ref(place).fetch_add(1, std::memory_order_relaxed)] = record;
            });
        if (done)
            solveBand(band, first, records);
        return done && !m_job.cancelled();
    }

    void solveBand(const Band& band, const std::vector<std::size_t>& first,
                   std::vector<SpanRecord>& records) {
        if (m_cells.empty())
            m_cells = m_candidates.cells();
        const std::size_t columns = band.last - band.first;
        struct Lists {
            SpanList center, maximum;
            std::vector<std::uint32_t> tunnels;
        };
        std::vector<Lists> lists(columns / kColumnsPerTask + 1);
        parallelFor(0, lists.size(), 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t task = from; task < to && !m_job.cancelled(); ++task) {
                const std::size_t end = std::min(columns, (task + 1) * kColumnsPerTask);
                for (std::size_t n = task * kColumnsPerTask; n < end; ++n) {
                    const std::span of(records.data() + first[n], first[n + 1] - first[n]);
                    std::sort(of.begin(), of.end());
                    const std::uint32_t cell = m_cells[band.first + n];
                    const ColumnSpans column = solidsOf(
                        of, {m_field.ground[cell], m_field.topMax[cell], m_field.topCenter[cell]},
                        m_city, m_rules.clearance);
                    lists[task].center.add(cell, column.center);
                    lists[task].maximum.add(cell, column.maximum);
                    if (column.tunnel)
                        lists[task].tunnels.push_back(cell);
                }
            }
        });
        for (const Lists& list : lists) {
            m_center.append(list.center);
            m_maximum.append(list.maximum);
            m_tunnels.insert(m_tunnels.end(), list.tunnels.begin(), list.tunnels.end());
        }
    }

    Heightfield& m_field;
    const CityModel& m_city;
    const HeightRules& m_rules;
    const JobContext& m_job;
    GridPlan m_plan;
    CellMask m_candidates;
    std::vector<std::uint32_t> m_cells;   ///< the candidates
    std::vector<std::uint32_t> m_counts;  ///< records, by candidate
    SpanList m_center;
    SpanList m_maximum;
    std::vector<std::uint32_t> m_tunnels;
};

}  // namespace

Result<void> addSpans(Heightfield& field, const CityModel& city, const HeightRules& rules,
                      const JobContext& job) {
    return SpanBuilder(field, city, rules, job).build();
}

}  // namespace reflet
