// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/overlays/Card.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr int kMargin = 28;
constexpr int kSpacing = 14;
constexpr double kTitleScale = 1.5;
constexpr QColor kDimming(8, 14, 18, 150);

}  // namespace

Card::Card(const QString& title, QWidget* window) : QWidget(window) {
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_DeleteOnClose);
    setAccessibleName(title);

    m_sheet = new QFrame(this);
    m_sheet->setObjectName(QStringLiteral("sheet"));
    m_sheet->setAutoFillBackground(true);
    m_sheet->setFrameShape(QFrame::StyledPanel);

    auto* heading = new QLabel(title, m_sheet);
    QFont font = heading->font();
    font.setPointSizeF(font.pointSizeF() * kTitleScale);
    font.setBold(true);
    heading->setFont(font);
    auto* done = new QPushButton(tr("Close"), m_sheet);
    done->setObjectName(QStringLiteral("closeCard"));
    connect(done, &QPushButton::clicked, this, &QWidget::close);

    auto* top = new QHBoxLayout;
    top->addWidget(heading, 1);
    top->addWidget(done);
    m_body = new QVBoxLayout;
    m_body->setSpacing(kSpacing);
    auto* column = new QVBoxLayout(m_sheet);
    column->setContentsMargins(kMargin, kMargin, kMargin, kMargin);
    column->setSpacing(kSpacing);
    column->addLayout(top);
    column->addLayout(m_body);

    auto* centred = new QVBoxLayout(this);
    centred->addStretch();
    centred->addWidget(m_sheet, 0, Qt::AlignHCenter);
    centred->addStretch();
    window->installEventFilter(this);
}

void Card::open() {
    setGeometry(parentWidget()->rect());
    show();
    raise();
    setFocus();
}

void Card::paintEvent(QPaintEvent* /*event*/) {
    QPainter(this).fillRect(rect(), kDimming);
}

void Card::mousePressEvent(QMouseEvent* event) {
    if (!m_sheet->geometry().contains(event->position().toPoint())) {
        close();
    }
}

void Card::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) {
        close();
    } else {
        QWidget::keyPressEvent(event);
    }
}

bool Card::eventFilter(QObject* watched, QEvent* event) {
    if (watched == parentWidget() && event->type() == QEvent::Resize) {
        setGeometry(parentWidget()->rect());
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace reflet
