// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"

#include <QElapsedTimer>
#include <QWidget>
#include <array>
#include <deque>

class QTimer;

namespace reflet {

/// The frame times of the last ten seconds as stacked columns, by stage, with the budget as a line.
class FrameChart : public QWidget {
    Q_OBJECT

public:
    explicit FrameChart(QWidget* parent = nullptr);

    void addFrame(const FrameStatistics& statistics);
    void setBudget(double milliseconds);
    void clear();

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override;

private:
    struct Sample {
        qint64 at;  ///< milliseconds since m_clock started
        std::array<float, 6> stages;
        float total;
    };
    [[nodiscard]] double top() const;
    void drop();

    std::deque<Sample> m_samples;
    QElapsedTimer m_clock;
    QTimer* m_repaint;
    double m_budget = 1000.0 / 30.0;
};

}  // namespace reflet
