// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/JobRunner.h"

#include <QToolButton>

namespace reflet {

/// What runs in the background, as one small button of the status bar: the newest job's title, with
/// its progress as the button's ground. Hidden when nothing runs.
class JobChip : public QToolButton {
    Q_OBJECT
public:
    explicit JobChip(QWidget* parent = nullptr);
    void setJobs(const std::vector<JobStatus>& jobs);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double m_fraction = 0.0;
};

}  // namespace reflet
