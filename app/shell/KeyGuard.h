// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace reflet {

/// Lets the widget with the keyboard have the plain keys that it understands itself, before they
/// are taken as commands of the window: Space presses a focused button, letters search in a list.
class KeyGuard : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace reflet
