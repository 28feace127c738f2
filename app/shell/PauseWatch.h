// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QString>
#include <chrono>
#include <functional>
#include <vector>

class QEvent;

namespace reflet {

/// Notes how long the interface does not look at the user: how long one event takes, with those
/// that are sent while it is handled. GUI thread only.
class PauseWatch {
public:
    using Clock = std::chrono::steady_clock;
    struct Pause {
        double milliseconds = 0.0;
        QString
            what;  ///< the event and who got it, from the outermost to the one that took longest
    };
    using Report = std::function<void(const Pause&)>;

    /// `report` is told of every pause that is longer than that.
    PauseWatch(double milliseconds, Report report);

    /// Around the handling of an event. Calls may be nested.
    void begin(const QObject& receiver, const QEvent& event, Clock::time_point now);
    void end(Clock::time_point now);
    [[nodiscard]] const Pause& longest() const { return m_longest; }

private:
    struct Running {
        QString what;
        Clock::time_point since;
        double worst = 0.0;  ///< of the events within
        QString worstWhat;
    };
    double m_limit;
    Report m_report;
    std::vector<Running> m_running;
    Pause m_longest;
};

/// An application whose events a watch looks at.
class WatchedApplication : public QApplication {
public:
    WatchedApplication(int& argc, char** argv, PauseWatch& watch);
    bool notify(QObject* receiver, QEvent* event) override;

private:
    PauseWatch& m_watch;
};

}  // namespace reflet
