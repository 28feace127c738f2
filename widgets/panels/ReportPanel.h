// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/panels/RemarkList.h"

#include <QString>
#include <QWidget>
#include <utility>
#include <vector>

class QLabel;
class QPushButton;
class QTabWidget;
class QTreeWidget;

namespace reflet {

/// What is told of one file: "Coordinates", "EPSG:28992, as the file says".
struct FileFacts {
    QString file;
    std::vector<std::pair<QString, QString>> facts;
};

/// The report on an import: how the objects fared, remark by remark, and what is known of each
/// file.
class ReportPanel : public QWidget {
    Q_OBJECT
public:
    explicit ReportPanel(QWidget* parent = nullptr);

    /// `summary`: one sentence over all of it. Without files there is nothing to save.
    void setReport(const QString& summary, std::vector<FileRemark> remarks,
                   const std::vector<FileFacts>& files);
    [[nodiscard]] RemarkList* remarks() const { return m_remarks; }

Q_SIGNALS:
    /// Show the object in the city.
    void objectActivated(QString file, QString object);
    void saveRequested();

private:
    QLabel* m_summary;
    RemarkList* m_remarks;
    QTreeWidget* m_files;
    QTabWidget* m_tabs;
    QPushButton* m_save;
};

}  // namespace reflet
