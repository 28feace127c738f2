// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPoint>
#include <QStringList>
#include <functional>

class QWidget;

namespace reflet {

/// What a user's hands do, as events that widgets get as if they came from mouse and desktop.
namespace hands {

void press(QWidget& widget, const QPoint& at);
void move(QWidget& widget, const QPoint& to);
void release(QWidget& widget, const QPoint& at);
void click(QWidget& widget);
/// Files from a file manager, let go over the widget's middle.
void drop(QWidget& widget, const QStringList& files);
/// Lets the widget's thread call something, as an event of its own.
void ask(QWidget& widget, const std::function<void()>& what);

/// Lets events pass for so long.
void rest(int milliseconds);
/// Lets events pass until the condition holds; false when it does not within the time.
bool waitFor(const std::function<bool()>& condition, int milliseconds);

}  // namespace hands
}  // namespace reflet
