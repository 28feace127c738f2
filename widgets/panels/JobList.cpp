// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/JobList.h"

#include "widgets/common/ElidedLabel.h"
#include "widgets/common/Look.h"

#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace reflet {

class JobList::Row : public QWidget {
public:
    explicit Row(JobList* list) : QWidget(list) {
        auto* grid = new QGridLayout(this);
        grid->setContentsMargins(0, 2, 0, 2);
        m_title = new ElidedLabel(this);
        m_phase = new ElidedLabel(this);
        m_phase->setForegroundRole(QPalette::PlaceholderText);
        m_bar = new QProgressBar(this);
        m_cancel = new QToolButton(this);
        m_cancel->setObjectName(QStringLiteral("cancelJob"));
        grid->addWidget(m_title, 0, 0);
        grid->addWidget(m_bar, 1, 0);
        grid->addWidget(m_phase, 2, 0);
        grid->addWidget(m_cancel, 0, 1, 2, 1);
        grid->setColumnStretch(0, 1);
        connect(m_cancel, &QToolButton::clicked, list,
                [this, list] { Q_EMIT list->cancelRequested(m_id); });
    }

    void show(const JobRow& job) {
        m_id = job.id;
        m_title->setText(job.title);
        m_phase->setText(job.cancelling ? JobList::tr("stopping …") : job.phase);
        const bool known = job.fraction >= 0.0;
        m_bar->setRange(0, known ? 100 : 0);
        m_bar->setValue(int(std::floor(100.0 * std::clamp(job.fraction, 0.0, 1.0))));
        m_bar->setAccessibleName(job.title);
        m_cancel->setText(JobList::tr("Cancel"));
        m_cancel->setToolTip(JobList::tr("Stop: %1").arg(job.title));
        m_cancel->setAccessibleName(m_cancel->toolTip());
        m_cancel->setEnabled(!job.cancelling);
    }
    [[nodiscard]] quint64 id() const { return m_id; }

private:
    quint64 m_id = 0;
    ElidedLabel* m_title;
    ElidedLabel* m_phase;
    QProgressBar* m_bar;
    QToolButton* m_cancel;
};

JobList::JobList(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Work in the background"));
    auto* layout = new QVBoxLayout(this);
    m_rows = new QVBoxLayout;
    m_none = new QLabel(tr("Nothing is being worked on."), this);
    m_none->setForegroundRole(QPalette::PlaceholderText);
    layout->addWidget(m_none);
    layout->addLayout(m_rows);
    layout->addStretch();
}

/// Rows are kept by job, so that the keyboard focus on a Cancel button stays with its job.
void JobList::setJobs(const std::vector<JobRow>& jobs) {
    for (auto row = m_shown.begin(); row != m_shown.end();) {
        const bool runs = std::any_of(jobs.begin(), jobs.end(),
                                      [&](const JobRow& job) { return job.id == (*row)->id(); });
        if (runs) {
            ++row;
            continue;
        }
        (*row)->hide();
        (*row)->deleteLater();
        row = m_shown.erase(row);
    }
    for (const JobRow& job : jobs) {
        const auto found = std::find_if(m_shown.begin(), m_shown.end(),
                                        [&](const Row* row) { return row->id() == job.id; });
        if (found != m_shown.end()) {
            (*found)->show(job);
            continue;
        }
        auto* row = new Row(this);
        row->show(job);
        m_rows->addWidget(row);
        m_shown.push_back(row);
    }
    m_none->setVisible(jobs.empty());
}

}  // namespace reflet
