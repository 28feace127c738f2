// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/PauseWatch.h"

#include <QEvent>
#include <QMetaEnum>
#include <QThread>
#include <ctime>
#include <utility>

namespace reflet {

namespace {

QString described(const QObject& receiver, const QEvent& event) {
    const char* name = QMetaEnum::fromType<QEvent::Type>().valueToKey(event.type());
    QString text = name ? QString::fromLatin1(name) : QString::number(event.type());
    text += QStringLiteral(" to ") + QString::fromLatin1(receiver.metaObject()->className());
    if (!receiver.objectName().isEmpty())
        text += QStringLiteral(" “%1”").arg(receiver.objectName());
    return text;
}

double inMilliseconds(std::chrono::nanoseconds duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

PauseWatch::Moment PauseWatch::Moment::now() {
    timespec used{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used) != 0)
        used = {};
    return {Clock::now(),
            std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec)};
}

PauseWatch::PauseWatch(double milliseconds, Report report)
    : m_limit(milliseconds), m_report(std::move(report)) {}

void PauseWatch::begin(const QObject& receiver, const QEvent& event, const Moment& now) {
    // Described now: the receiver may be gone when it is done.
    m_running.push_back({described(receiver, event), now, 0.0, {}});
}

void PauseWatch::end(const Moment& now) {
    const Running done = std::move(m_running.back());
    m_running.pop_back();
    const double took = inMilliseconds(now.time - done.since.time);
    const QString what =
        done.worst > 0.5 * took ? done.what + QStringLiteral(" > ") + done.worstWhat : done.what;
    if (!m_running.empty()) {
        if (took > m_running.back().worst) {
            m_running.back().worst = took;
            m_running.back().worstWhat = what;
        }
        return;
    }
    const Pause pause{took, inMilliseconds(now.work - done.since.work), what};
    if (took > m_longest.milliseconds)
        m_longest = pause;
    if (pause.work > m_hardest.work)
        m_hardest = pause;
    if (took > m_limit && m_report)
        m_report(pause);
}

void PauseWatch::forget() {
    m_longest = m_hardest = {};
}

WatchedApplication::WatchedApplication(int& argc, char** argv, PauseWatch& watch)
    : QApplication(argc, argv), m_watch(watch) {}

bool WatchedApplication::notify(QObject* receiver, QEvent* event) {
    if (QThread::currentThread() != thread())
        return QApplication::notify(receiver, event);  // events of other threads block nobody
    m_watch.begin(*receiver, *event, PauseWatch::Moment::now());
    const bool taken = QApplication::notify(receiver, event);
    m_watch.end(PauseWatch::Moment::now());
    return taken;
}

}  // namespace reflet
