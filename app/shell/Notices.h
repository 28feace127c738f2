// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/panels/MessageBar.h"

#include <QObject>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace reflet {

/// What the window tells the user: messages in its bar, each with buttons that do something.
/// Errors never get lost: they are written to the log as well.
class Notices : public QObject {
    Q_OBJECT
public:
    /// A button's label and what it does.
    using Action = std::pair<QString, std::function<void()>>;

    explicit Notices(MessageBar* bar, QObject* parent = nullptr);

    /// Cancelled is no error: it is not told.
    void tell(const Error& error, std::vector<Action> actions = {});
    quint64 tell(Severity severity, const QString& what, std::vector<Action> actions = {},
                 const QString& remedy = {});
    void dismiss(quint64 id) { m_bar->dismiss(id); }

private:
    quint64 post(Message message, std::vector<Action> actions);

    MessageBar* m_bar;
    std::map<quint64, std::vector<Action>> m_actions;
};

}  // namespace reflet
