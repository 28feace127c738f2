// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/Placement.h"

#include "core/coverage/ChosenPlaces.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace reflet {

namespace {

constexpr double kNothing = 1e-9;  // of a share: rounding, no loss
constexpr int kExchangeRounds = 3;
/// Steps through the table that exchanges may take; beyond, the greedy answer stands.
constexpr double kMostExchangeWork = 4e9;

std::size_t entriesOf(const ServiceTable& table) {
    std::size_t entries = 0;
    for (const ServiceRow& row : table.rows)
        entries += row.entries.size();
    return entries;
}

/// A gain as it was when it was last looked at; it can only have become smaller.
struct Promise {
    double gain = 0.0;
    std::size_t row = 0;
    std::size_t age = 0;  ///< how many had been chosen then
    bool operator<(const Promise& other) const {
        return gain != other.gain ? gain < other.gain : row > other.row;
    }
};

class Planner {
public:
    Planner(const ServiceTable& table, std::span<const std::size_t> fixed,
            const PlacementGoal& goal)
        : m_table(table),
          m_fixed(fixed),
          m_goal(goal),
          m_places(table, kSecondShare),
          m_samples(double(std::max<std::size_t>(table.samples, 1))) {
        for (const std::size_t row : fixed)
            m_places.add(row);
        refresh();
    }

    [[nodiscard]] double coverage() const { return m_coverage; }
    [[nodiscard]] double worth() const { return m_places.worth() / m_samples; }
    [[nodiscard]] bool reached() const {
        return (m_goal.count && m_chosen.size() >= *m_goal.count) ||
               (m_goal.coverage && coverage() >= *m_goal.coverage);
    }
    [[nodiscard]] const std::vector<PlacedRow>& chosen() const { return m_chosen; }

    /// Adds from `pool` until the goal is reached or nothing is gained.
    [[nodiscard]] bool greedy(const std::vector<std::size_t>& pool, const JobContext& job) {
        const std::vector<double> gains = m_places.gains();
        std::priority_queue<Promise> promises;
        for (const std::size_t row : pool) {
            if (!m_places.contains(row))
                promises.push({gains[row], row, m_chosen.size()});
        }
        while (!promises.empty() && !reached()) {
            if (job.cancelled())
                return false;
            Promise top = promises.top();
            promises.pop();
            if (top.age != m_chosen.size()) {
                top = {m_places.gain(top.row), top.row, m_chosen.size()};
                promises.push(top);
                continue;
            }
            if (!(top.gain / m_samples > std::max(m_goal.leastGain, kNothing)))
                break;
            m_places.add(top.row);
            refresh();
            m_chosen.push_back({top.row, top.gain / m_samples, coverage()});
            job.progress(progressed());
        }
        return true;
    }

    /// Gives back what the goal does not need, the least loss first. Whether it gave any back.
    bool giveBack() {
        bool any = false;
        while (true) {
            double least = std::numeric_limits<double>::infinity();
            std::size_t which = m_chosen.size();
            const double spare = m_goal.coverage ? coverage() - *m_goal.coverage : -1.0;
            for (std::size_t k = 0; k < m_chosen.size(); ++k) {
                const ChosenPlaces::Loss loss = m_places.loss(m_chosen[k].row);
                const bool bearable =
                    loss.worth / m_samples <= kNothing || loss.coverage / m_samples <= spare;
                if (bearable && loss.worth < least) {
                    least = loss.worth;
                    which = k;
                }
            }
            if (which == m_chosen.size())
                return any;
            drop(which);
            any = true;
        }
    }

    /// Exchanges each chosen place for the best other one, where that gains. Whether any was.
    bool exchange() {
        bool any = false;
        for (std::size_t k = 0; k < m_chosen.size(); ++k) {
            const std::size_t row = m_chosen[k].row;
            m_places.remove(row);
            const double own = m_places.gain(row);
            const std::vector<double> gains = m_places.gains();
            const auto best = std::max_element(gains.begin(), gains.end());
            const bool better = best != gains.end() && *best > own + kNothing * m_samples;
            const std::size_t next = better ? std::size_t(best - gains.begin()) : row;
            m_places.add(next);
            m_chosen[k].row = next;
            any = any || better;
        }
        refresh();
        return any;
    }

    /// The same places in the order of their gains, which are told anew.
    [[nodiscard]] bool reorder(const JobContext& job) {
        std::vector<std::size_t> pool;
        for (const PlacedRow& placed : m_chosen)
            pool.push_back(placed.row);
        std::sort(pool.begin(), pool.end());
        for (const std::size_t row : pool)
            m_places.remove(row);
        for (const std::size_t row : m_fixed)
            m_places.add(row);
        refresh();
        m_chosen.clear();
        PlacementGoal all;
        all.count = pool.size();
        std::swap(m_goal, all);
        const bool done = greedy(pool, job);
        std::swap(m_goal, all);
        return done;
    }

private:
    void drop(std::size_t k) {
        m_places.remove(m_chosen[k].row);
        m_chosen.erase(m_chosen.begin() + std::ptrdiff_t(k));
        refresh();
    }
    void refresh() { m_coverage = m_places.coverage() / m_samples; }
    [[nodiscard]] double progressed() const {
        const double byCount =
            m_goal.count ? double(m_chosen.size()) / double(std::max<std::size_t>(*m_goal.count, 1))
                         : 0.0;
        const double byCoverage =
            m_goal.coverage && *m_goal.coverage > 0.0 ? coverage() / *m_goal.coverage : 0.0;
        return std::min(1.0, std::max(byCount, byCoverage));
    }

    const ServiceTable& m_table;
    std::span<const std::size_t> m_fixed;
    PlacementGoal m_goal;
    ChosenPlaces m_places;
    std::vector<PlacedRow> m_chosen;
    double m_samples;
    double m_coverage = 0.0;
};

}  // namespace

double worthOf(const ServiceTable& table, std::span<const std::size_t> places, double secondShare) {
    std::vector<float> best(table.samples, 0.0F), second(table.samples, 0.0F);
    for (const std::size_t row : places) {
        for (const ServiceRow::Entry& entry : table.rows[row].entries) {
            float& first = best[entry.sample];
            float& next = second[entry.sample];
            next = std::max(next, std::min(first, entry.service));
            first = std::max(first, entry.service);
        }
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < best.size(); ++i)
        sum += (1.0 - secondShare) * double(best[i]) + secondShare * double(second[i]);
    return sum / double(std::max<std::size_t>(table.samples, 1));
}

std::vector<std::size_t> Placement::all(std::span<const std::size_t> fixed) const {
    std::vector<std::size_t> rows(fixed.begin(), fixed.end());
    for (const PlacedRow& placed : chosen)
        rows.push_back(placed.row);
    return rows;
}

Result<Placement> place(const ServiceTable& table, std::span<const std::size_t> fixed,
                        const PlacementGoal& goal, const JobContext& job) {
    Planner planner(table, fixed, goal);
    Placement placement;
    placement.before = planner.coverage();
    std::vector<std::size_t> pool(table.rows.size());
    for (std::size_t row = 0; row < pool.size(); ++row)
        pool[row] = row;
    if (!planner.greedy(pool, job.phase("choosing", 0.0, 0.6)))
        return tl::unexpected(JobContext::cancelledError());
    const JobContext improving = job.phase("improving", 0.6, 1.0);
    const double work = double(entriesOf(table)) * double(planner.chosen().size());
    planner.giveBack();
    for (int round = 0; round < kExchangeRounds && work * (round + 1) < kMostExchangeWork;
         ++round) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const bool exchanged = planner.exchange();
        const bool gaveBack = planner.giveBack();
        improving.progress(double(round + 1) / kExchangeRounds);
        if (!exchanged && !gaveBack)
            break;
    }
    // What was given back makes room for others; an exchange may have cost coverage for worth.
    if (!planner.greedy(pool, improving))
        return tl::unexpected(JobContext::cancelledError());
    if (!planner.reorder(improving))
        return tl::unexpected(JobContext::cancelledError());
    placement.chosen = planner.chosen();
    placement.coverage = planner.coverage();
    placement.worth = planner.worth();
    placement.reached = planner.reached();
    return placement;
}

}  // namespace reflet
