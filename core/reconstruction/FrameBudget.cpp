// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/FrameBudget.h"

#include "core/reconstruction/LodSettings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace reflet {

namespace {

constexpr double kAim = 0.87;          // of the budget: what is left is for what cannot be foreseen
constexpr double kLeastShare = 0.15;   // of the budget, for reflections, however slow the rest is
constexpr double kShrunkShare = 0.25;  // the most while the picture is drawn smaller
constexpr double kMuchTooMuch = 1.5;   // no second look
constexpr double kRoom = 0.8;          // of what is allowed, as foreseen for the finer step
constexpr double kLeastPerUnit = 1e-12;  // milliseconds
constexpr int kHardPictures = 4;
constexpr double kMuchRoom = 0.35;
constexpr int kPatience = 15, kMostPatience = 480;
constexpr int kHurry = 8;          // times faster where there is much room
constexpr int kProbation = 120;    // pictures after a finer step in which it must hold
constexpr double kCautious = 0.8;  // of the units, while smaller maps than before are new
constexpr int kForgive = 600;      // pictures after which patience starts anew

void remember(std::deque<double>& values, double value, std::size_t count) {
    values.push_back(value);
    if (values.size() > count)
        values.pop_front();
}

/// The second largest, the only one if there is no other.
double secondWorst(const std::deque<double>& values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    return sorted[std::min<std::size_t>(1, sorted.size() - 1)];
}

}  // namespace

void FrameBudget::setBudget(double milliseconds) {
    m_budget = std::isnan(milliseconds) ? LodSettings{}.frameBudget
                                        : std::max(milliseconds, LodSettings::kLeastBudget);
    m_patience = std::max(m_patience, kPatience);
}

void FrameBudget::reset() {
    *this = FrameBudget(m_budget);
}

double FrameBudget::allowedMilliseconds() const {
    if (std::isinf(m_budget))
        return m_budget;
    const double left = kAim * m_budget - m_rest;
    const double most = (m_shrunk ? kShrunkShare : kAim) * m_budget;
    return std::clamp(left, kLeastShare * m_budget, most);
}

double FrameBudget::allowedUnits() const {
    const bool isNew = m_sinceCoarser < int(kRemembered);
    return (isNew ? kCautious : 1.0) * allowedMilliseconds() / m_perUnit;
}

/// Milliseconds a picture in the long run, or of the dearest map if that is more.
double FrameBudget::need(int coarse) const {
    double units = 0.0;
    for (const Demand& demand : m_demands) {
        const auto at = std::size_t(coarse);
        units = std::max({units, demand.units[at], demand.largest[at]});
    }
    return units * m_perUnit;
}

int FrameBudget::coarseEnough() const {
    int coarse = m_coarse;
    while (coarse < kMostCoarse && need(coarse) > allowedMilliseconds())
        ++coarse;
    return coarse;
}

void FrameBudget::goCoarser(int to) {
    if (m_sinceFiner < kProbation)
        m_patience = std::min(2 * m_patience, kMostPatience);
    if (to > m_coarse)
        m_sinceCoarser = 0;
    m_coarse = std::min(to, kMostCoarse);
    m_hard = m_easy = 0;
}

void FrameBudget::plan(const Demand& demand, bool shrunk) {
    m_shrunk = shrunk;
    m_demands.push_back(demand);
    if (m_demands.size() > kRemembered / 2)
        m_demands.pop_front();
    ++m_sinceFiner;
    ++m_sinceCoarser;
    if (m_sinceFiner > kForgive)
        m_patience = kPatience;
    const double allowed = allowedMilliseconds();
    const double asked = need(m_coarse);
    m_hard = asked > allowed ? m_hard + 1 : 0;
    if (asked > kMuchTooMuch * allowed)
        return goCoarser(coarseEnough());
    if (m_hard >= kHardPictures)
        return goCoarser(m_coarse + 1);
    const double finer = m_coarse > 0 ? need(m_coarse - 1) : 0.0;
    if (m_coarse == 0 || finer > kRoom * allowed)
        m_easy = 0;
    else
        m_easy += finer <= kMuchRoom * allowed ? kHurry : 1;
    if (m_easy >= m_patience) {
        --m_coarse;
        m_easy = 0;
        m_sinceFiner = 0;
    }
}

void FrameBudget::took(double all, const Cost& maps, const Cost& others) {
    for (const double value :
         {all, maps.milliseconds, maps.units, others.milliseconds, others.units}) {
        if (!std::isfinite(value) || value < 0.0)
            return;
    }
    double rest = all;
    const auto learn = [&](const Cost& cost, std::deque<double>& costs, double& perUnit) {
        if (cost.units <= 0.0)
            return;
        rest -= cost.milliseconds;
        remember(costs, cost.milliseconds / cost.units, kRemembered);
        perUnit = std::max(secondWorst(costs), kLeastPerUnit);
    };
    learn(maps, m_costs, m_perUnit);
    learn(others, m_otherCosts, m_perOther);
    remember(m_rests, std::max(0.0, rest), kRemembered);
    m_rest = secondWorst(m_rests);
}

}  // namespace reflet
