// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/overlays/Welcome.h"

#include <QApplication>
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
constexpr int kCompactBelow = 640;  // logical pixels: 200 % on a small screen
constexpr int kCompactSide = 12;
constexpr QColor kGround(6, 14, 18, 225);

void scaleFont(QWidget* widget, double scale) {
    QFont font = widget->font();
    font.setPointSizeF(QApplication::font().pointSizeF() * scale);
    widget->setFont(font);
}

void styleButton(QPushButton* button, bool primary, bool compact) {
    const QString room = compact ? QStringLiteral("8px 3px") : QStringLiteral("10px 20px");
    scaleFont(button, compact ? 1.0 : kDetailScale);
    button->setStyleSheet(
        primary ? QStringLiteral("QPushButton { background: #1b8a92; color: white; border: 1px "
                                 "solid #1b8a92; border-radius: 8px; padding: %1; }"
                                 "QPushButton:hover, QPushButton:focus { background: #25a6af; }")
                      .arg(room)
                : QStringLiteral("QPushButton { background: rgba(255,255,255,38); color: white; "
                                 "border: 1px solid rgba(255,255,255,120); border-radius: 8px; "
                                 "padding: %1; }"
                                 "QPushButton:hover, QPushButton:focus { background: "
                                 "rgba(255,255,255,70); }")
                      .arg(room));
}

QPushButton* bigButton(const QString& text, const char* name, bool primary) {
    auto* button = new QPushButton(text);
    button->setObjectName(QString::fromLatin1(name));
    button->setCursor(Qt::PointingHandCursor);
    QFont font = button->font();
    font.setBold(primary);
    button->setFont(font);
    styleButton(button, primary, false);
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

    m_buttons = {open, drive, explain};

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

void Welcome::fit(int width) {
    const bool compact = width < kCompactBelow;
    if (compact == m_compact) {
        return;
    }
    m_compact = compact;
    const int side = compact ? kCompactSide : kSide;
    layout()->setContentsMargins(side, compact ? kCompactSide : kHead, side,
                                 compact ? kCompactSide : kFoot);
    scaleFont(m_caption, compact ? kDetailScale : kCaptionScale);
    scaleFont(m_detail, compact ? 1.0 : kDetailScale);
    for (QPushButton* button : m_buttons) {
        styleButton(button, button == m_buttons.front(), compact);
    }
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
