// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/KeyGuard.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>

namespace reflet {
namespace {

bool isPlain(const QKeyEvent& key) {
    return (key.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == Qt::NoModifier;
}

bool wants(const QObject* widget, int key) {
    const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
    if (qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QLineEdit*>(widget)) {
        return enter;
    }
    if (qobject_cast<const QAbstractButton*>(widget)) {
        return key == Qt::Key_Space || enter;
    }
    if (qobject_cast<const QComboBox*>(widget) || qobject_cast<const QAbstractItemView*>(widget)) {
        return enter || key == Qt::Key_Space || key == Qt::Key_Home ||
               (key >= Qt::Key_A && key <= Qt::Key_Z);
    }
    return qobject_cast<const QAbstractSlider*>(widget) && key == Qt::Key_Home;
}

}  // namespace

bool KeyGuard::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        if (isPlain(key) && wants(watched, key.key())) {
            event->accept();
            return true;
        }
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace reflet
