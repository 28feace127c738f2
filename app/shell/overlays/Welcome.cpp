// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/overlays/Welcome.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLinearGradient>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr int kSide = 32;
constexpr int kFoot = 26;
constexpr int kHead = 70;  // where the picture fades into the caption's ground
constexpr double kCaptionScale = 2.0;
constexpr double kDetailScale = 1.15;
constexpr QColor kGround(6, 14, 18, 225);

QPushButton* bigButton(const QString& text, const char* name, bool primary) {
    auto* button = new QPushButton(text);
    button->setObjectName(QString::fromLatin1(name));
    button->setCursor(Qt::PointingHandCursor);
    QFont font = button->font();
    font.setPointSizeF(font.pointSizeF() * kDetailScale);
    font.setBold(primary);
    button->setFont(font);
    button->setStyleSheet(
        primary ? QStringLiteral("QPushButton { background: #1b8a92; color: white; border: none; "
                                 "border-radius: 8px; padding: 11px 20px; }"
                                 "QPushButton:hover, QPushButton:focus { background: #25a6af; }")
                : QStringLiteral("QPushButton { background: rgba(255,255,255,38); color: white; "
                                 "border: 1px solid rgba(255,255,255,120); border-radius: 8px; "
                                 "padding: 10px 20px; }"
                                 "QPushButton:hover, QPushButton:focus { background: "
                                 "rgba(255,255,255,70); }"));
    return button;
}

QLabel* whiteLabel(double scale, bool bold) {
    auto* label = new QLabel;
    label->setWordWrap(true);
    QFont font = label->font();
    font.setPointSizeF(font.pointSizeF() * scale);
    font.setBold(bold);
    label->setFont(font);
    label->setStyleSheet(QStringLiteral("color: white;"));
    return label;
}

}  // namespace

Welcome::Welcome(QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("welcome"));
    m_caption = whiteLabel(kCaptionScale, true);
    m_caption->setObjectName(QStringLiteral("welcomeCaption"));
    m_detail = whiteLabel(kDetailScale, false);

    auto* open = bigButton(tr("Open your city…"), "welcomeOpen", true);
    auto* drive = bigButton(tr("Drive this square"), "welcomeDrive", false);
    auto* explain = bigButton(tr("What am I seeing?"), "welcomeExplain", false);
    connect(open, &QPushButton::clicked, this, &Welcome::openCityAsked);
    connect(drive, &QPushButton::clicked, this, &Welcome::driveAsked);
    connect(explain, &QPushButton::clicked, this, &Welcome::explanationAsked);

    auto* away = new QToolButton;
    away->setObjectName(QStringLiteral("welcomeDismiss"));
    away->setText(QStringLiteral("✕"));
    away->setAccessibleName(tr("Put this away"));
    away->setToolTip(tr("Put this away"));
    away->setStyleSheet(QStringLiteral(
        "QToolButton { color: white; border: none; padding: 6px; }"
        "QToolButton:hover, QToolButton:focus { background: rgba(255,255,255,60); }"));
    connect(away, &QToolButton::clicked, this, [this] {
        hide();
        Q_EMIT dismissed();
    });

    auto* row = new QHBoxLayout;
    row->setSpacing(12);
    row->addWidget(open);
    row->addWidget(drive);
    row->addWidget(explain);
    row->addStretch();
    row->addWidget(away);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(kSide, kHead, kSide, kFoot);
    column->setSpacing(8);
    column->addWidget(m_caption);
    column->addWidget(m_detail);
    column->addSpacing(8);
    column->addLayout(row);
}

void Welcome::setCaption(const QString& caption, const QString& detail) {
    m_caption->setText(caption);
    m_detail->setText(detail);
}

int Welcome::heightForStage(int width) const {
    return layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width)
                                         : sizeHint().height();
}

void Welcome::paintEvent(QPaintEvent* /*event*/) {
    QLinearGradient fade(0, 0, 0, height());
    QColor clear = kGround;
    clear.setAlpha(0);
    fade.setColorAt(0.0, clear);
    fade.setColorAt(0.55, QColor(kGround.red(), kGround.green(), kGround.blue(), 150));
    fade.setColorAt(1.0, kGround);
    QPainter(this).fillRect(rect(), fade);
}

}  // namespace reflet
