// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/ViewIntents.h"

#include <functional>
#include <utility>

namespace reflet {

/// Turns presses, steps and releases of any control into the phases that DragPhase promises: Begin
/// once and only when something changes, then End or Cancel; a step outside of a press is a lone
/// End.
template <class T>
class DragSequence {
public:
    using Report = std::function<void(const T&, DragPhase)>;

    explicit DragSequence(Report report) : m_report(std::move(report)) {}

    [[nodiscard]] bool pressed() const { return m_pressed; }
    [[nodiscard]] bool begun() const { return m_begun; }
    [[nodiscard]] const T& before() const { return m_before; }

    void press(const T& before) {
        if (m_pressed)
            return;
        m_pressed = true;
        m_begun = false;
        m_before = before;
        m_last = before;
    }
    void step(const T& value) {
        if (!m_pressed) {
            m_report(value, DragPhase::End);
            return;
        }
        m_last = value;
        const bool begins = !std::exchange(m_begun, true);
        m_report(value, begins ? DragPhase::Begin : DragPhase::Move);
    }
    void release() {
        if (std::exchange(m_pressed, false) && std::exchange(m_begun, false))
            m_report(T(m_last), DragPhase::End);
    }
    /// Returns whether there was anything to take back.
    bool cancel() {
        m_pressed = false;
        if (!std::exchange(m_begun, false))
            return false;
        m_report(T(m_before), DragPhase::Cancel);
        return true;
    }

private:
    Report m_report;
    T m_before{};
    T m_last{};
    bool m_pressed = false;
    bool m_begun = false;
};

}  // namespace reflet
