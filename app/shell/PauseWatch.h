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
/// that are sent while it is handled, and how much of that the thread itself was at work: the rest
/// it waited, for other threads or for a busy machine. GUI thread only.
class PauseWatch {
public:
    using Clock = std::chrono::steady_clock;
    /// An instant, and the processor time that the calling thread had used by then.
    struct Moment {
        Clock::time_point time;
        std::chrono::nanoseconds work{0};
        [[nodiscard]] static Moment now();
    };
    struct Pause {
        double milliseconds = 0.0;
        double work = 0.0;  ///< milliseconds of it in which the thread was at work
        QString
            what;  ///< the event and who got it, from the outermost to the one that took longest
    };
    using Report = std::function<void(const Pause&)>;

    /// `report` is told of every pause that is longer than that.
    PauseWatch(double milliseconds, Report report);

    /// Around the handling of an event. Calls may be nested.
    void begin(const QObject& receiver, const QEvent& event, const Moment& now);
    void end(const Moment& now);
    [[nodiscard]] const Pause& longest() const { return m_longest; }
    /// The pause with the most work in it; not always the longest.
    [[nodiscard]] const Pause& hardest() const { return m_hardest; }
    /// Both are sought anew from here on. An event that is being handled counts from its beginning.
    void forget();

private:
    struct Running {
        QString what;
        Moment since;
        double worst = 0.0;  ///< of the events within
        QString worstWhat;
    };
    double m_limit;
    Report m_report;
    std::vector<Running> m_running;
    Pause m_longest, m_hardest;
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
