// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/reconstruction/LevelOfDetail.h"
#include "widgets/ViewIntents.h"

#include <QWidget>
#include <functional>

class QCheckBox;
class QLabel;

namespace reflet {

class NumberEdit;

/// What reflections may cost while something moves, and what became of it in the last picture.
class DetailSection : public QWidget {
    Q_OBJECT

public:
    explicit DetailSection(QWidget* parent = nullptr);

    void show(const LodSettings& settings);
    using QWidget::show;
    void showFrame(const LodStatistics& statistics);

    std::function<void(const LodSettings&, DragPhase)> changed;

private:
    void report(DragPhase phase);

    LodSettings m_settings;
    QCheckBox* m_on;
    NumberEdit* m_pace;
    NumberEdit* m_blur;
    QLabel* m_counts;
};

}  // namespace reflet
