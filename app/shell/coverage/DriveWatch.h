// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "core/gpu/Frame.h"

#include <QElapsedTimer>
#include <QObject>
#include <vector>

namespace reflet {

class SuggestController;

/// Counts, while vehicles drive, how much of what they mirror no probe sees, and offers a probe
/// where it is much.
class DriveWatch : public QObject {
    Q_OBJECT
public:
    static constexpr double kMuch = 0.1;           ///< of what is mirrored
    static constexpr double kApart = 60.0;         ///< metres between places that are offered
    static constexpr qint64 kWindow = 1'500;       ///< milliseconds that are counted together
    static constexpr qint64 kPauseAfter = 20'000;  ///< milliseconds after an offer

    DriveWatch(Workbench& bench, SuggestController& suggest, QObject* parent);

    /// What a picture of the drive tells.
    void count(const FrameStatistics& statistics);

private:
    void look();
    void forget();

    Workbench& m_bench;
    SuggestController& m_suggest;
    std::size_t m_vertices = 0, m_uncovered = 0;
    QElapsedTimer m_since;             ///< of the window
    QElapsedTimer m_offered;           ///< since the last offer
    std::vector<glm::dvec3> m_places;  ///< that were offered
};

}  // namespace reflet
