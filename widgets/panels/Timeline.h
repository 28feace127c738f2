// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/ViewIntents.h"

#include <QWidget>

class QComboBox;
class QLabel;
class QToolButton;

namespace reflet {

class DragSlider;

/// Time of the traffic: play, pause, scrub, speed.
class Timeline : public QWidget {
    Q_OBJECT

public:
    explicit Timeline(QWidget* parent = nullptr);

    void setDuration(double seconds);
    void setTime(double seconds);
    void setPlaying(bool playing);
    void setSpeed(double factor);
    [[nodiscard]] double time() const { return m_time; }

Q_SIGNALS:
    void playingChanged(bool playing);
    void timeChanged(double seconds, reflet::DragPhase phase);
    void speedChanged(double factor);

protected:
    void changeEvent(QEvent* event) override;

private:
    void showTime();
    void showPlaying();

    double m_time = 0.0;
    double m_duration = 0.0;
    bool m_playing = false;
    QToolButton* m_start;
    QToolButton* m_play;
    DragSlider* m_slider;
    QLabel* m_label;
    QComboBox* m_speed;
};

}  // namespace reflet
