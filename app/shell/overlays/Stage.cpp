// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/overlays/Stage.h"

#include "app/shell/overlays/Welcome.h"

#include <QEvent>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>

namespace reflet {
namespace {

constexpr int kHintTop = 44;  // below the labels of the wipe
constexpr int kHintGap = 8;   // below the messages
constexpr int kProblemWidth = 560;

QLabel* centredText(const QString& text, bool strong) {
    auto* label = new QLabel(text);
    label->setWordWrap(true);
    label->setAlignment(Qt::AlignHCenter);
    label->setFixedWidth(kProblemWidth);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    if (strong) {
        QFont font = label->font();
        font.setPointSizeF(font.pointSizeF() * 1.4);
        font.setBold(true);
        label->setFont(font);
    }
    // A layout that centres a label asks for one line only.
    label->setMinimumHeight(label->heightForWidth(kProblemWidth));
    return label;
}

}  // namespace

Stage::Stage(QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("stage"));
    setMinimumSize(320, 240);
    m_welcome = new Welcome(this);
    m_hint = new QLabel(this);
    m_hint->setObjectName(QStringLiteral("hint"));
    m_hint->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_hint->setStyleSheet(
        QStringLiteral("background: rgba(15, 30, 36, 215); color: white; border-radius: 12px; "
                       "padding: 6px 16px;"));
    m_hint->hide();
    m_welcome->installEventFilter(this);
}

void Stage::setPicture(QWidget* picture) {
    m_picture = picture;
    m_picture->setParent(this);
    m_picture->lower();
    m_picture->show();
    arrange();
}

void Stage::setMessages(QWidget* bar) {
    m_messages = bar;
    m_messages->setParent(this);
    m_messages->installEventFilter(this);
    arrange();
}

void Stage::showProblem(const Error& error) {
    if (m_problem) {
        return;
    }
    if (m_picture) {
        m_picture->hide();
    }
    m_welcome->hide();
    m_problem = new QWidget(this);
    m_problem->setObjectName(QStringLiteral("graphicsProblem"));
    auto* column = new QVBoxLayout(m_problem);
    column->addStretch();
    column->addWidget(centredText(tr("The picture cannot be drawn here"), true), 0,
                      Qt::AlignHCenter);
    column->addWidget(centredText(QString::fromStdString(error.what), false), 0, Qt::AlignHCenter);
    column->addWidget(centredText(QString::fromStdString(error.remedy), false), 0,
                      Qt::AlignHCenter);
    column->addWidget(centredText(tr("The plan, the lists and the files work as usual."), false), 0,
                      Qt::AlignHCenter);
    column->addStretch();
    m_problem->lower();
    m_problem->show();
    arrange();
}

void Stage::setHint(const QString& hint) {
    m_hint->setText(hint);
    m_hint->setVisible(!hint.isEmpty());
    arrange();
}

QString Stage::hint() const {
    return m_hint->isHidden() ? QString() : m_hint->text();
}

void Stage::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
    Q_EMIT resized();
}

bool Stage::eventFilter(QObject* watched, QEvent* event) {
    const bool laidOver = watched == m_welcome || watched == m_messages;
    if (laidOver && (event->type() == QEvent::Show || event->type() == QEvent::Hide ||
                     event->type() == QEvent::LayoutRequest)) {
        arrange();
    }
    return QWidget::eventFilter(watched, event);
}

void Stage::arrange() {
    for (QWidget* full : {m_picture, m_problem}) {
        if (full) {
            full->setGeometry(rect());
        }
    }
    const int messages = arrangeMessages();
    m_hint->adjustSize();
    m_hint->move((width() - m_hint->width()) / 2, std::max(kHintTop, messages + kHintGap));
    m_hint->raise();
    m_welcome->fit(width());
    const int height = std::min(m_welcome->heightForStage(width()), this->height());
    m_welcome->setGeometry(0, this->height() - height, width(), height);
    m_welcome->raise();
    if (m_messages)
        m_messages->raise();
}

int Stage::arrangeMessages() {
    if (!m_messages || m_messages->isHidden())
        return 0;
    const QLayout* layout = m_messages->layout();
    const int wanted = layout && layout->hasHeightForWidth() ? layout->totalHeightForWidth(width())
                                                             : m_messages->sizeHint().height();
    m_messages->setGeometry(0, 0, width(), std::min(wanted, height()));
    return m_messages->height();
}

}  // namespace reflet
