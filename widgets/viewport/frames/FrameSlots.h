// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/frames/SceneState.h"

#include <array>
#include <cstddef>
#include <mutex>
#include <optional>

namespace reflet {

/// Three places for pictures, passed between one thread that draws and one that shows: neither ever
/// waits for the other, and the newest finished picture is what is shown.
class FrameSlots {
public:
    static constexpr std::size_t kCount = 3;

    /// For the thread that draws: a place that is neither finished nor shown. It stays the same
    /// until publish().
    [[nodiscard]] std::size_t drawing() const { return m_drawing; }
    /// The picture in drawing() is finished. Returns whether the one before was shown already.
    bool publish(const DrawnFrame& frame) {
        const std::lock_guard lock(m_mutex);
        m_frames[m_drawing] = frame;
        std::swap(m_drawing, m_finished);
        const bool wasTaken = !m_fresh;
        m_fresh = true;
        return wasTaken;
    }
    /// For the thread that shows: the newest finished picture, and where it is; none before the
    /// first. That place is left alone until the next call.
    [[nodiscard]] std::optional<DrawnFrame> take(std::size_t& place) {
        const std::lock_guard lock(m_mutex);
        if (m_fresh) {
            std::swap(m_shown, m_finished);
            m_fresh = false;
            m_any = true;
        }
        place = m_shown;
        return m_any ? std::optional(m_frames[m_shown]) : std::nullopt;
    }

private:
    std::mutex m_mutex;
    std::array<DrawnFrame, kCount> m_frames;
    std::size_t m_drawing = 0, m_finished = 1, m_shown = 2;
    bool m_fresh = false;  ///< `m_finished` holds a picture that was not shown yet
    bool m_any = false;
};

}  // namespace reflet
