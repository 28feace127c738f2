// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/tuning/TuningPanel.h"

#include <QWidget>

class QLabel;
class QTableWidget;

namespace reflet {

/// The methods beside one another: how close each comes to the reference, and what it costs.
class FigureTable : public QWidget {
    Q_OBJECT

public:
    explicit FigureTable(QWidget* parent = nullptr);

    void setFigures(const std::vector<MethodRow>& figures, const QString& pose);
    void setStale(bool stale);

private:
    void showNote();

    QTableWidget* m_table;
    QLabel* m_note;
    QString m_pose;
    bool m_stale = false;
};

}  // namespace reflet
