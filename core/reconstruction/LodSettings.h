// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace reflet {

/// How much of a picture's time is spent on reflections while something moves (DESIGN 5.4). A
/// picture of what stands is never affected.
struct LodSettings {
    static constexpr double kLeastBudget = 4.0, kMostBudget = 500.0;  ///< milliseconds

    bool on = true;
    /// Milliseconds that a picture of a movement may take. Infinity: all that is due is drawn.
    double frameBudget = 33.0;
    /// How far reflections smear along the movement, as a share of the way between two pictures:
    /// 0 sharp, 0.5 as with a film camera, 1 at most.
    double blur = 0.0;

    friend bool operator==(const LodSettings&, const LodSettings&) = default;
};

}  // namespace reflet
