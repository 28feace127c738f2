// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/PauseWatch.h"

#include <QEvent>
#include <QMetaEnum>
#include <QThread>
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

}  // namespace

PauseWatch::PauseWatch(double milliseconds, Report report)
    : m_limit(milliseconds), m_report(std::move(report)) {}

void PauseWatch::begin(const QObject& receiver, const QEvent& event, Clock::time_point now) {
    // Described now: the receiver may be gone when it is done.
    m_running.push_back({described(receiver, event), now, 0.0, {}});
}

void PauseWatch::end(Clock::time_point now) {
    const Running done = std::move(m_running.back());
    m_running.pop_back();
    const double took = std::chrono::duration<double, std::milli>(now - done.since).count();
    const QString what =
        done.worst > 0.5 * took ? done.what + QStringLiteral(" > ") + done.worstWhat : done.what;
    if (!m_running.empty()) {
        if (took > m_running.back().worst) {
            m_running.back().worst = took;
            m_running.back().worstWhat = what;
        }
        return;
    }
    const Pause pause{took, what};
    if (took > m_longest.milliseconds)
        m_longest = pause;
    if (took > m_limit && m_report)
        m_report(pause);
}

WatchedApplication::WatchedApplication(int& argc, char** argv, PauseWatch& watch)
    : QApplication(argc, argv), m_watch(watch) {}

bool WatchedApplication::notify(QObject* receiver, QEvent* event) {
    if (QThread::currentThread() != thread())
        return QApplication::notify(receiver, event);  // events of other threads block nobody
    m_watch.begin(*receiver, *event, PauseWatch::Clock::now());
    const bool taken = QApplication::notify(receiver, event);
    m_watch.end(PauseWatch::Clock::now());
    return taken;
}

}  // namespace reflet
