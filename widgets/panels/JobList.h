// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace reflet {

/// A running job, as it is shown.
struct JobRow {
    quint64 id = 0;
    QString title;
    QString phase;
    double fraction = 0.0;  ///< 0..1; negative: unknown
    bool cancelling = false;
};

/// What runs in the background, with progress and a way to stop it.
class JobList : public QWidget {
    Q_OBJECT

public:
    explicit JobList(QWidget* parent = nullptr);
    void setJobs(const std::vector<JobRow>& jobs);

Q_SIGNALS:
    void cancelRequested(quint64 id);

private:
    class Row;
    QVBoxLayout* m_rows;
    QLabel* m_none;
    std::vector<Row*> m_shown;
};

}  // namespace reflet
