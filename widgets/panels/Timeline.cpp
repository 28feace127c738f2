// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/Timeline.h"

#include "widgets/common/DragSlider.h"
#include "widgets/common/Look.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr int kStepsASecond = 20;  ///< of the slider
constexpr std::array kSpeeds{0.25, 0.5, 1.0, 2.0, 4.0};
constexpr int kIcon = 18;

enum class Sign { Play, Pause, Start };

QIcon signIcon(Sign sign, const QColor& color) {
    QIcon icon;
    for (const int ratio : {1, 2, 3}) {
        QPixmap pixmap(kIcon * ratio, kIcon * ratio);
        pixmap.setDevicePixelRatio(ratio);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(Qt::NoPen);
        painter.setBrush(color);
        if (sign == Sign::Pause) {
            painter.drawRect(QRectF(4.0, 3.0, 3.5, 12.0));
            painter.drawRect(QRectF(10.5, 3.0, 3.5, 12.0));
        } else if (sign == Sign::Play) {
            painter.drawPolygon(QPolygonF({{5.0, 3.0}, {15.0, 9.0}, {5.0, 15.0}}));
        } else {
            painter.drawRect(QRectF(3.0, 3.0, 2.5, 12.0));
            painter.drawPolygon(QPolygonF({{15.0, 3.0}, {6.0, 9.0}, {15.0, 15.0}}));
        }
        icon.addPixmap(pixmap);
    }
    return icon;
}

}  // namespace

Timeline::Timeline(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Traffic"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(6, 2, 6, 2);
    m_start = new QToolButton(this);
    m_start->setObjectName(QStringLiteral("timelineStart"));
    m_start->setToolTip(tr("Back to the start"));
    m_play = new QToolButton(this);
    m_play->setObjectName(QStringLiteral("timelinePlay"));
    m_slider = new DragSlider(this);
    m_slider->setObjectName(QStringLiteral("timelineSlider"));
    m_slider->setAccessibleName(tr("Time of the traffic"));
    m_slider->setToolTip(tr("Where the vehicles are: drag to move them along their routes"));
    m_slider->setSingleStep(kStepsASecond / 10);
    m_slider->setPageStep(kStepsASecond);
    m_label = new QLabel(this);
    m_label->setObjectName(QStringLiteral("timelineLabel"));
    m_label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    m_speed = new QComboBox(this);
    m_speed->setObjectName(QStringLiteral("timelineSpeed"));
    for (const double speed : kSpeeds)
        m_speed->addItem(tr("%1 ×").arg(QLocale().toString(speed)), speed);
    m_speed->setCurrentIndex(2);
    m_speed->setToolTip(tr("How fast time passes"));
    m_speed->setAccessibleName(tr("Speed"));
    for (QToolButton* button : {m_start, m_play}) {
        button->setAutoRaise(true);
        button->setIconSize({kIcon, kIcon});
    }
    layout->addWidget(m_start);
    layout->addWidget(m_play);
    layout->addWidget(m_slider, 1);
    layout->addWidget(m_label);
    layout->addWidget(m_speed);

    connect(m_start, &QToolButton::clicked, this, [this] {
        setTime(0.0);
        Q_EMIT timeChanged(0.0, DragPhase::End);
    });
    connect(m_play, &QToolButton::clicked, this, [this] {
        setPlaying(!m_playing);
        Q_EMIT playingChanged(m_playing);
    });
    connect(m_slider, &DragSlider::moved, this, [this](int value, DragPhase phase) {
        m_time = double(value) / kStepsASecond;
        showTime();
        Q_EMIT timeChanged(m_time, phase);
    });
    connect(m_speed, &QComboBox::activated, this,
            [this](int index) { Q_EMIT speedChanged(kSpeeds[std::size_t(index)]); });
    m_start->setAccessibleName(m_start->toolTip());
    showPlaying();
    setDuration(0.0);
}

void Timeline::setDuration(double seconds) {
    m_duration = std::max(0.0, seconds);
    const QSignalBlocker quiet(m_slider);
    m_slider->setRange(0, int(std::ceil(m_duration * kStepsASecond)));
    // The time may have been told before the duration was.
    m_slider->show(int(std::lround(m_time * kStepsASecond)));
    setEnabled(m_duration > 0.0);
    showTime();
}

void Timeline::setTime(double seconds) {
    if (m_slider->dragging())
        return;
    m_time = seconds;
    m_slider->show(int(std::lround(seconds * kStepsASecond)));
    showTime();
}

void Timeline::setPlaying(bool playing) {
    m_playing = playing;
    showPlaying();
}

void Timeline::setSpeed(double factor) {
    for (std::size_t i = 0; i < kSpeeds.size(); ++i)
        if (std::abs(kSpeeds[i] - factor) < 1e-6)
            m_speed->setCurrentIndex(int(i));
}

void Timeline::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        showPlaying();
}

void Timeline::showTime() {
    const auto text = [](double seconds) { return QLocale().toString(seconds, 'f', 1); };
    m_label->setText(tr("%1 / %2 s").arg(text(m_time), text(m_duration)));
    // The label does not jump while time passes.
    m_label->setMinimumWidth(m_label->fontMetrics().horizontalAdvance(
        tr("%1 / %2 s").arg(text(m_duration), text(m_duration))));
}

void Timeline::showPlaying() {
    const QColor ink = palette().color(QPalette::ButtonText);
    m_start->setIcon(signIcon(Sign::Start, ink));
    m_play->setIcon(signIcon(m_playing ? Sign::Pause : Sign::Play, ink));
    m_play->setToolTip(m_playing ? tr("Stop the vehicles") : tr("Let the vehicles drive"));
    m_play->setAccessibleName(m_play->toolTip());
}

}  // namespace reflet
