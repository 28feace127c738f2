// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/ToolBar.h"

#include <QLayout>
#include <QResizeEvent>

namespace reflet {

ToolBar::ToolBar(const QString& title, QWidget* parent) : QToolBar(title, parent) {
    setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
}

void ToolBar::resizeEvent(QResizeEvent* event) {
    QToolBar::resizeEvent(event);
    chooseStyle();
}

bool ToolBar::event(QEvent* event) {
    switch (event->type()) {
        case QEvent::ActionAdded:
        case QEvent::ActionRemoved:
        case QEvent::ActionChanged:
        case QEvent::FontChange:
        case QEvent::StyleChange:
        case QEvent::LanguageChange:
            m_withWords = 0;
            break;
        default:
            break;
    }
    return QToolBar::event(event);
}

int ToolBar::widthWithWords() {
    if (m_withWords == 0) {
        const Qt::ToolButtonStyle style = toolButtonStyle();
        setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
        m_withWords = layout()->sizeHint().width();
        setToolButtonStyle(style);
    }
    return m_withWords;
}

void ToolBar::chooseStyle() {
    const Qt::ToolButtonStyle fitting =
        widthWithWords() <= width() ? Qt::ToolButtonTextUnderIcon : Qt::ToolButtonIconOnly;
    if (fitting != toolButtonStyle()) {
        setToolButtonStyle(fitting);
    }
}

}  // namespace reflet
