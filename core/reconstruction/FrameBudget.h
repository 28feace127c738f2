// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/LevelOfDetail.h"

#include <array>
#include <cstddef>
#include <deque>
#include <span>

namespace reflet {

/// Keeps pictures of a movement within a budget by what it lets reflections cost. From what
/// pictures took it learns how long everything else takes and what a unit of work (unitsOf) is
/// worth here, by the second worst of the last pictures: one hiccup counts for nothing, and what
/// comes twice is expected again. From this it says
///
/// - how many units the next picture may draw, so that even the worst one keeps the budget, and
/// - how coarse all maps are made, so that in the long run those drawn are enough. It goes coarser
///   when more is asked for than may be drawn, at once if it is much more; finer only when that
///   would leave room for many pictures in a row, and ever more hesitantly when it did not hold.
///
/// Knows no clock and no OpenGL.
class FrameBudget {
public:
    explicit FrameBudget(double milliseconds = 33.0) { setBudget(milliseconds); }

    /// At least LodSettings::kLeastBudget; infinity: nothing is ever held back.
    void setBudget(double milliseconds);
    [[nodiscard]] double budget() const { return m_budget; }
    /// Forgets what was learned: another city, or a long pause.
    void reset();

    /// Units that a picture asks for in the long run at each step of coarseness. `largest` is the
    /// dearest single map. Once before each picture.
    struct Demand {
        std::array<double, kMostCoarse + 1> units{};
        std::array<double, kMostCoarse + 1> largest{};
    };
    /// shrunk: the picture itself is drawn smaller to keep its pace; then reflections get a small
    /// share, and the rest goes to the picture's size.
    void plan(const Demand& demand, bool shrunk = false);

    [[nodiscard]] int coarse() const { return m_coarse; }
    [[nodiscard]] double allowedUnits() const;         ///< for the next picture
    [[nodiscard]] double allowedMilliseconds() const;  ///< the same, as time
    [[nodiscard]] double millisecondsPerUnit() const { return m_perUnit; }

    /// Units of maps that one of drawing other vehicles into a map (unitsOfOthers) is worth here.
    [[nodiscard]] double othersWeight() const { return m_perOther / m_perUnit; }

    /// Milliseconds, and the units that were drawn in them.
    struct Cost {
        double milliseconds = 0.0;
        double units = 0.0;
    };
    /// What a picture took: all of it, its maps, and other vehicles in these. Senseless figures are
    /// ignored.
    void took(double all, const Cost& maps, const Cost& others);
    void took(double all, const Cost& maps) { took(all, maps, Cost()); }

private:
    [[nodiscard]] double need(int coarse) const;
    [[nodiscard]] int coarseEnough() const;
    void goCoarser(int to);

    static constexpr std::size_t kRemembered = 16;  ///< pictures
    double m_budget = 33.0;
    std::deque<double> m_rests, m_costs, m_otherCosts;
    std::deque<Demand> m_demands;
    double m_rest = 0.0;
    double m_perUnit = 5e-5;   ///< milliseconds; until the first picture was measured
    double m_perOther = 4e-4;  ///< the same of other vehicles in maps
    bool m_shrunk = false;
    int m_coarse = 0;
    int m_hard = 0;              ///< pictures in a row that asked for too much
    int m_easy = 0;              ///< pictures in a row that left room for a finer step
    int m_patience = 0;          ///< how many of those it takes
    int m_sinceFiner = 1 << 20;  ///< pictures
    int m_sinceCoarser = 1 << 20;
};

}  // namespace reflet
