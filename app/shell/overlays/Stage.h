// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <QWidget>

class QLabel;

namespace reflet {

class Welcome;

/// Where the 3D picture stands, with what is laid over it: the welcome of the first start, and a
/// hint of what to do next. When the graphics cannot draw it, says so in its place.
class Stage : public QWidget {
    Q_OBJECT
public:
    explicit Stage(QWidget* parent = nullptr);

    /// Takes the widget over.
    void setPicture(QWidget* picture);
    /// Takes the bar over. It lies over the top of the picture, whose shape does not change with
    /// it.
    void setMessages(QWidget* bar);
    /// Puts the error and its remedy where the picture would be.
    void showProblem(const Error& error);
    [[nodiscard]] bool hasProblem() const { return m_problem != nullptr; }

    [[nodiscard]] Welcome* welcome() const { return m_welcome; }
    /// One line at the top of the picture, what to do next; empty = none.
    void setHint(const QString& hint);
    [[nodiscard]] QString hint() const;

Q_SIGNALS:
    /// Something that the user dropped onto the picture, or the stage changed its size.
    void resized();

protected:
    void resizeEvent(QResizeEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void arrange();
    /// Lays the messages over the top; how high they are now.
    int arrangeMessages();

    QWidget* m_picture = nullptr;
    QWidget* m_problem = nullptr;
    QWidget* m_messages = nullptr;
    Welcome* m_welcome = nullptr;
    QLabel* m_hint = nullptr;
};

}  // namespace reflet
