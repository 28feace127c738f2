// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/coverage/ChosenPlaces.h"
#include "core/coverage/Placement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace reflet {

namespace {

constexpr std::size_t kMostPrefixes = 24;
constexpr std::size_t kRowsPerTask = 16;
/// Subgradient steps, and steps through the table that they may take together.
constexpr int kMostSteps = 250;
constexpr double kMostWork = 5e9;
constexpr int kPatience = 12;          // steps without a better bound until they get shorter
constexpr double kShortest = 0.01;     // of a full step
constexpr double kCloseEnough = 5e-4;  // of the bound

constexpr double kWorkOfGuess = 5e8;  // for a number of places that is tried
/// Of the way gone so far that goes on in the next step: what alternates cancels out. Measured on
/// 500 candidates: the bound of 400 plain steps after 200.
constexpr double kMomentum = 0.85;
/// It ends when so many steps together have won less than this of the bound.
constexpr int kLookBack = 40;
constexpr double kStandstill = 3e-4;
/// Of a worth that is asked for: what the steps head for where no set is known.
constexpr double kNear = 0.98;

/// The Lagrangian dual for one table and number of places. Sums are over samples.
class Dual {
public:
    Dual(const ServiceTable& table, std::span<const std::size_t> fixed, double secondShare)
        : m_table(table), m_first(1.0 - secondShare), m_next(secondShare) {
        m_isFixed.resize(table.rows.size(), 0);
        for (const std::size_t row : fixed)
            m_isFixed[row] = 1;
    }

    /// Starts from what the samples get of a set of places: the bound is then that of its gains.
    void startFrom(const ChosenPlaces& places) {
        m_pay.resize(m_table.samples);
        for (std::size_t i = 0; i < m_pay.size(); ++i)
            m_pay[i] = {m_first * double(places.best(i)), m_next * double(places.second(i))};
    }

    /// The least bound found for `count` places; ends early when it is below `enough`, or so close
    /// above `reached`, a worth that some set has, that no more is to be won.
    [[nodiscard]] Result<double> improve(std::size_t count, double reached, double enough,
                                         double work, const JobContext& job) {
        std::size_t entries = 0;
        for (const ServiceRow& row : m_table.rows)
            entries += row.entries.size();
        const int steps =
            int(std::min(double(kMostSteps), work / double(std::max<std::size_t>(entries, 1))));
        double least = bound(count);
        std::vector<Pay> bestPay = m_pay;
        double length = 1.0;
        double before = least;  // kLookBack steps ago, or fewer
        int patience = kPatience;
        for (int step = 0; step < steps && length > kShortest; ++step) {
            if (job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            job.progress(double(step) / double(steps));
            if (least < enough || least - reached <= kCloseEnough * least)
                break;
            if (step % kLookBack == kLookBack - 1) {
                if (before - least < kStandstill * least)
                    break;
                before = least;
            }
            descend(length, reached);
            const double now = bound(count);
            if (now < least) {
                if (least - now > kCloseEnough * 0.1 * least)
                    patience = kPatience;
                least = now;
                bestPay = m_pay;
            } else if (--patience == 0) {
                length *= 0.5;
                patience = kPatience;
                m_pay = bestPay;
                m_way.clear();
                static_cast<void>(bound(count));
            }
        }
        m_pay = std::move(bestPay);
        return least;
    }

private:
    /// What a sample pays for its best service and for its second best.
    struct Pay {
        double first = 0.0, second = 0.0;
    };

    [[nodiscard]] double earned(const ServiceRow::Entry& entry) const {
        const Pay& pay = m_pay[entry.sample];
        const double q = double(entry.service);
        return std::max(0.0, std::max(m_first * q - pay.first, m_next * q - pay.second));
    }

    /// The bound at the pays of now; remembers which places earn most.
    [[nodiscard]] double bound(std::size_t count) {
        std::vector<double> earnings(m_table.rows.size(), 0.0);
        parallelFor(0, earnings.size(), kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t row = first; row < last; ++row) {
                for (const ServiceRow::Entry& entry : m_table.rows[row].entries)
                    earnings[row] += earned(entry);
            }
        });
        double sum = 0.0;
        for (const Pay& pay : m_pay)
            sum += pay.first + pay.second;
        m_open.clear();
        std::vector<std::size_t> others;
        for (std::size_t row = 0; row < earnings.size(); ++row) {
            if (m_isFixed[row] != 0) {
                sum += earnings[row];
                m_open.push_back(row);
            } else {
                others.push_back(row);
            }
        }
        const auto end = others.begin() + std::ptrdiff_t(std::min(count, others.size()));
        std::partial_sort(others.begin(), end, others.end(), [&](std::size_t x, std::size_t y) {
            return earnings[x] != earnings[y] ? earnings[x] > earnings[y] : x < y;
        });
        for (auto row = others.begin(); row != end; ++row) {
            sum += earnings[*row];
            m_open.push_back(*row);
        }
        m_value = sum;
        return sum;
    }

    /// A step against the subgradient: samples that are served too often pay more, those that are
    /// not served pay less. Its length after Polyak, towards `reached`.
    void descend(double length, double reached) {
        std::vector<Pay> slope(m_pay.size(), Pay{1.0, m_next > 0.0 ? 1.0 : 0.0});
        for (const std::size_t row : m_open) {
            for (const ServiceRow::Entry& entry : m_table.rows[row].entries) {
                const Pay& pay = m_pay[entry.sample];
                const double q = double(entry.service);
                const double first = m_first * q - pay.first, second = m_next * q - pay.second;
                if (first > 0.0 && first >= second)
                    slope[entry.sample].first -= 1.0;
                else if (second > 0.0)
                    slope[entry.sample].second -= 1.0;
            }
        }
        m_way.resize(slope.size());
        for (std::size_t i = 0; i < slope.size(); ++i) {
            slope[i].first += kMomentum * m_way[i].first;
            slope[i].second += kMomentum * m_way[i].second;
        }
        m_way = slope;
        double squares = 0.0;
        for (std::size_t i = 0; i < slope.size(); ++i) {
            // Pays are not negative: where they cannot fall they do not count.
            if (m_pay[i].first <= 0.0 && slope[i].first > 0.0)
                slope[i].first = 0.0;
            if (m_pay[i].second <= 0.0 && slope[i].second > 0.0)
                slope[i].second = 0.0;
            squares += slope[i].first * slope[i].first + slope[i].second * slope[i].second;
        }
        if (!(squares > 0.0))
            return;
        const double step = length * std::max(0.0, m_value - reached) / squares;
        for (std::size_t i = 0; i < slope.size(); ++i) {
            m_pay[i].first = std::max(0.0, m_pay[i].first - step * slope[i].first);
            m_pay[i].second = std::max(0.0, m_pay[i].second - step * slope[i].second);
        }
    }

    const ServiceTable& m_table;
    double m_first, m_next;
    std::vector<unsigned char> m_isFixed;
    std::vector<Pay> m_pay;
    std::vector<Pay> m_way;           ///< gone in the steps so far
    std::vector<std::size_t> m_open;  ///< the fixed places and those that earn most
    double m_value = 0.0;             ///< the bound at m_pay
};

/// Bounds by the gains at prefixes of an order, for any number of places.
class PrefixBounds {
public:
    /// Leaves `places` with all of the order.
    PrefixBounds(ChosenPlaces& places, std::span<const std::size_t> order) {
        note(places);
        const std::size_t step = std::max<std::size_t>(1, order.size() / kMostPrefixes);
        for (std::size_t i = 0; i < order.size(); ++i) {
            places.add(order[i]);
            if ((i + 1) % step == 0 || i + 1 == order.size())
                note(places);
        }
    }
    [[nodiscard]] double bound(std::size_t count) const {
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<double>& sums : m_sums)
            least = std::min(least, sums[std::min(count, sums.size() - 1)]);
        return least;
    }

private:
    /// The worth, and what the 1, 2, 3 ... places of the largest gains add to it at most.
    void note(const ChosenPlaces& places) {
        std::vector<double> gains = places.gains();
        std::sort(gains.begin(), gains.end(), std::greater<>());
        std::vector<double> sums{places.worth()};
        for (const double gain : gains)
            sums.push_back(sums.back() + gain);
        m_sums.push_back(std::move(sums));
    }
    std::vector<std::vector<double>> m_sums;
};

}  // namespace

Result<Certificate> certify(const ServiceTable& table, std::span<const std::size_t> fixed,
                            std::span<const std::size_t> order, std::size_t count,
                            double secondShare, const JobContext& job) {
    const double samples = double(std::max<std::size_t>(table.samples, 1));
    ChosenPlaces places(table, secondShare);
    for (const std::size_t row : fixed)
        places.add(row);
    Certificate certificate;
    certificate.prefix = PrefixBounds(places, order).bound(count) / samples;

    Dual dual(table, fixed, secondShare);
    dual.startFrom(places);
    const double reached = order.size() <= count ? places.worth() : 0.0;
    const auto least = dual.improve(count, reached, 0.0, kMostWork, job);
    if (!least)
        return tl::unexpected(least.error());
    certificate.dual = *least / samples;

    std::vector<std::size_t> all(table.rows.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    certificate.everything = worthOf(table, all, secondShare);
    return certificate;
}

Result<std::size_t> leastCount(const ServiceTable& table, std::span<const std::size_t> fixed,
                               std::span<const std::size_t> order, double coverage,
                               std::size_t enough, const JobContext& job) {
    const double samples = double(std::max<std::size_t>(table.samples, 1));
    const double wanted = coverage * samples * (1.0 - 1e-12);
    ChosenPlaces places(table, 0.0);
    for (const std::size_t row : fixed)
        places.add(row);
    const PrefixBounds prefixes(places, order);
    const auto cannot = [&](std::size_t count) -> Result<bool> {
        if (prefixes.bound(count) < wanted)
            return true;
        Dual dual(table, fixed, 0.0);
        dual.startFrom(places);
        const auto least = dual.improve(count, kNear * wanted, wanted, kWorkOfGuess, job);
        if (!least)
            return tl::unexpected(least.error());
        return *least < wanted;
    };
    // Fewer than `low` cannot reach it. The answer is mostly near `enough`: down from there by
    // growing steps, then between.
    std::size_t low = 0, high = enough;
    for (std::size_t step = 1; low == 0 && high > 0; step *= 2) {
        const std::size_t count = high - std::min(step, high);
        const auto answer = cannot(count);
        if (!answer)
            return tl::unexpected(answer.error());
        if (*answer)
            low = count + 1;
        else
            high = count;
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        const auto answer = cannot(middle);
        if (!answer)
            return tl::unexpected(answer.error());
        if (*answer)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

}  // namespace reflet
