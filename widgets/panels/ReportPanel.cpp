// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/ReportPanel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace reflet {

ReportPanel::ReportPanel(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Import report"));
    auto* layout = new QVBoxLayout(this);
    auto* top = new QHBoxLayout;
    m_summary = new QLabel(this);
    m_summary->setObjectName(QStringLiteral("reportSummary"));
    m_summary->setTextFormat(Qt::PlainText);
    m_summary->setWordWrap(true);
    m_save = new QPushButton(tr("Save…"), this);
    m_save->setObjectName(QStringLiteral("reportSave"));
    m_save->setToolTip(tr("Save the report with each object as a JSON file"));
    top->addWidget(m_summary, 1);
    top->addWidget(m_save, 0, Qt::AlignTop);
    layout->addLayout(top);

    m_remarks = new RemarkList(this);
    m_files = new QTreeWidget(this);
    m_files->setObjectName(QStringLiteral("reportFiles"));
    m_files->setAccessibleName(tr("What is known of each file"));
    m_files->setHeaderHidden(true);
    m_files->setColumnCount(2);
    m_files->setWordWrap(true);
    m_files->setAlternatingRowColors(true);
    m_files->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    m_tabs = new QTabWidget(this);
    m_tabs->addTab(m_remarks, tr("Remarks"));
    m_tabs->addTab(m_files, tr("Files"));
    layout->addWidget(m_tabs, 1);

    connect(m_remarks, &RemarkList::objectActivated, this, &ReportPanel::objectActivated);
    connect(m_save, &QPushButton::clicked, this, &ReportPanel::saveRequested);
    setReport({}, {}, {});
}

void ReportPanel::setReport(const QString& summary, std::vector<FileRemark> remarks,
                            const std::vector<FileFacts>& files) {
    m_summary->setText(files.empty() ? tr("No city has been read yet.") : summary);
    m_save->setEnabled(!files.empty());
    m_remarks->setRemarks(std::move(remarks));
    m_files->clear();
    for (const FileFacts& file : files) {
        auto* root = new QTreeWidgetItem(m_files, {file.file});
        root->setFirstColumnSpanned(true);
        for (const auto& [name, value] : file.facts) {
            auto* row = new QTreeWidgetItem(root, {name, value});
            row->setToolTip(1, value);
        }
        root->setExpanded(true);
    }
}

}  // namespace reflet
