// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace reflet {

/// Chooses at what share of the full size to draw while something moves, so that pictures come at
/// a steady pace. Goes down at once when a picture took much too long, goes up only when several
/// pictures in a row left room for the larger size: it does not flicker between two sizes.
class AdaptiveScale {
public:
    static constexpr double kSmallest = 0.4;

    explicit AdaptiveScale(double framesPerSecond = 30.0) { setTarget(framesPerSecond); }

    /// Clamped to 5..120.
    void setTarget(double framesPerSecond);
    /// Edge of the next picture as a share of the full one, kSmallest..1: one of a few fixed steps.
    [[nodiscard]] double scale() const;
    /// Tells what a picture at that scale cost; figures of other scales are ignored.
    void took(double milliseconds, double atScale);
    /// Milliseconds that a picture may take.
    [[nodiscard]] double budget() const { return m_budget; }

private:
    double m_budget = 33.3;
    int m_step = 0;  ///< index into the steps, 0 = full size
    int m_easy = 0;  ///< pictures in a row that left room
    int m_hard = 0;  ///< pictures in a row that were somewhat too slow
};

}  // namespace reflet
