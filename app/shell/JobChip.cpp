// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/JobChip.h"

#include <QPainter>

namespace reflet {
namespace {

constexpr double kPercent = 100.0;
constexpr int kMaximumTitle = 48;  // letters
constexpr int kGroundAlpha = 90;

}  // namespace

JobChip::JobChip(QWidget* parent) : QToolButton(parent) {
    setObjectName(QStringLiteral("jobChip"));
    setAutoRaise(true);
    setToolButtonStyle(Qt::ToolButtonTextOnly);
    setToolTip(tr("What runs in the background; click for the list"));
    hide();
}

void JobChip::setJobs(const std::vector<JobStatus>& jobs) {
    setVisible(!jobs.empty());
    if (jobs.empty()) {
        return;
    }
    // The one that is nearest to its end says most about how long it takes.
    const JobStatus* shown = &jobs.front();
    for (const JobStatus& job : jobs) {
        if (!job.waiting && (shown->waiting || job.fraction > shown->fraction)) {
            shown = &job;
        }
    }
    m_fraction = std::clamp(shown->fraction, 0.0, 1.0);
    QString title = shown->title;
    title.truncate(kMaximumTitle);
    QString label = tr("%1  %2 %").arg(title).arg(int(m_fraction * kPercent));
    if (jobs.size() > 1) {
        label = tr("%1  (and %n more)", nullptr, int(jobs.size()) - 1).arg(label);
    }
    setText(label);
    update();
}

void JobChip::paintEvent(QPaintEvent* event) {
    {
        QPainter painter(this);
        QColor ground = palette().color(QPalette::Highlight);
        ground.setAlpha(kGroundAlpha);
        painter.fillRect(QRectF(0, 0, width() * m_fraction, height()), ground);
    }
    QToolButton::paintEvent(event);
}

}  // namespace reflet
