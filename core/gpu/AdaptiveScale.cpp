// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/AdaptiveScale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr std::array<double, 6> kSteps{1.0, 0.84, 0.7, 0.6, 0.5, AdaptiveScale::kSmallest};
constexpr double kTooSlow = 1.15;     // times the budget: noise is let pass
constexpr double kMuchTooSlow = 1.6;  // no second look
constexpr double kRoom = 0.85;        // of the budget, as predicted for the larger size
constexpr int kEasyFrames = 8;
constexpr int kHardFrames = 3;

double area(int step) {
    return kSteps[std::size_t(step)] * kSteps[std::size_t(step)];
}

}  // namespace

void AdaptiveScale::setTarget(double framesPerSecond) {
    m_budget = 1000.0 / std::clamp(framesPerSecond, 5.0, 120.0);
}

double AdaptiveScale::scale() const {
    return kSteps[std::size_t(m_step)];
}

void AdaptiveScale::took(double milliseconds, double atScale) {
    if (std::abs(atScale - scale()) > 1e-6 || !(milliseconds >= 0.0)) {
        return;
    }
    const int last = int(kSteps.size()) - 1;
    m_hard = milliseconds > kTooSlow * m_budget ? m_hard + 1 : 0;
    if (m_step < last && (milliseconds > kMuchTooSlow * m_budget || m_hard >= kHardFrames)) {
        // Straight to where it would fit if all of the cost went with the area.
        const int from = m_step;
        while (m_step < last &&
               (m_step == from || milliseconds * area(m_step) / area(from) > m_budget)) {
            ++m_step;
        }
        m_easy = m_hard = 0;
        return;
    }
    const bool roomAbove =
        m_step > 0 && milliseconds * area(m_step - 1) / area(m_step) < kRoom * m_budget;
    m_easy = roomAbove ? m_easy + 1 : 0;
    if (m_easy >= kEasyFrames) {
        --m_step;
        m_easy = 0;
    }
}

}  // namespace reflet
