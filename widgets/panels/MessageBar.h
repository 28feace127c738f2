// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"

#include <QFrame>
#include <QString>
#include <QStringList>
#include <deque>

class QHBoxLayout;
class QLabel;
class QToolButton;

namespace reflet {

/// What MessageBar tells.
struct Message {
    Severity severity = Severity::Info;
    QString what;         ///< one sentence
    QString subject;      ///< which file or object; may be empty
    QString remedy;       ///< what the user can do; may be empty
    QString details;      ///< for those who want to know more; may be empty
    QStringList actions;  ///< labels of buttons
};
[[nodiscard]] Message toMessage(const Error& error);

/// A bar over the views that tells what went wrong and what to do. Several messages wait in line;
/// the same text is not queued twice. Escape or the cross closes the front one.
class MessageBar : public QFrame {
    Q_OBJECT

public:
    explicit MessageBar(QWidget* parent = nullptr);

    /// Returns the message's number.
    quint64 post(const Message& message);
    quint64 post(const Error& error) { return post(toMessage(error)); }
    void dismiss(quint64 id);
    void dismissAll();
    [[nodiscard]] int count() const { return int(m_queue.size()); }

Q_SIGNALS:
    void actionTriggered(quint64 id, int action);  ///< the message closes itself
    void dismissed(quint64 id);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    struct Entry {
        quint64 id;
        Message message;
    };
    void showFront();
    void close();

    std::deque<Entry> m_queue;
    quint64 m_next = 1;
    QLabel* m_icon;
    QLabel* m_text;
    QLabel* m_details;
    QToolButton* m_more;
    QLabel* m_waiting;
    QHBoxLayout* m_actions;
};

}  // namespace reflet
