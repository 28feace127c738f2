// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/Notices.h"

#include <QLoggingCategory>

namespace reflet {
namespace {

Q_LOGGING_CATEGORY(log, "reflet")

}  // namespace

Notices::Notices(MessageBar* bar, QObject* parent) : QObject(parent), m_bar(bar) {
    connect(m_bar, &MessageBar::actionTriggered, this, [this](quint64 id, int action) {
        const auto found = m_actions.find(id);
        if (found == m_actions.end() || action < 0 || std::size_t(action) >= found->second.size()) {
            return;
        }
        // What the button does may post messages of its own.
        const auto act = found->second[std::size_t(action)].second;
        m_actions.erase(found);
        if (act) {
            act();
        }
    });
    connect(m_bar, &MessageBar::dismissed, this, [this](quint64 id) { m_actions.erase(id); });
}

void Notices::tell(const Error& error, std::vector<Action> actions) {
    if (error.code == ErrorCode::Cancelled) {
        return;
    }
    qCWarning(log).noquote() << QString::fromStdString(error.message());
    post(toMessage(error), std::move(actions));
}

quint64 Notices::tell(Severity severity, const QString& what, std::vector<Action> actions,
                      const QString& remedy) {
    Message message;
    message.severity = severity;
    message.what = what;
    message.remedy = remedy;
    return post(std::move(message), std::move(actions));
}

quint64 Notices::post(Message message, std::vector<Action> actions) {
    for (const Action& action : actions) {
        message.actions << action.first;
    }
    const quint64 id = m_bar->post(message);
    m_actions[id] = std::move(actions);
    return id;
}

}  // namespace reflet
