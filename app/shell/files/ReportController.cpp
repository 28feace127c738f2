// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/ReportController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/ImportReportJson.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/files/ReportFacts.h"
#include "core/base/Files.h"
#include "widgets/viewport/Viewport.h"

#include <QFileDialog>
#include <QMainWindow>

namespace reflet {

ReportController::ReportController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.live, &LiveCity::cityChanged, this, &ReportController::showReport);
    connect(bench.commands->action(Command::ShowReport), &QAction::triggered, this,
            &ReportController::panelWanted);
    connect(bench.report, &ReportPanel::objectActivated, this, &ReportController::showObject);
    connect(bench.report, &ReportPanel::saveRequested, this, &ReportController::chooseFile);
}

void ReportController::showReport() {
    const auto prepared = m_bench.live->prepared();
    if (!prepared) {
        m_bench.report->setReport({}, {}, {});
        return;
    }
    const LoadedCity& city = prepared->loaded();
    m_bench.report->setReport(reportSummary(city), reportRemarks(city), reportFacts(city));
    if (std::exchange(m_tell, false) && isWorthTelling(city))
        tell();
}

void ReportController::tell() {
    m_bench.notices->tell(
        Severity::Info,
        tr("The city is here. %1").arg(reportSummary(m_bench.live->prepared()->loaded())),
        {{tr("Show the report"), [this] { Q_EMIT panelWanted(); }}});
}

void ReportController::showObject(const QString& file, const QString& object) {
    const auto prepared = m_bench.live->prepared();
    if (!prepared || object.isEmpty())
        return;
    const Box box = boxOfObject(prepared->loaded(), file, object.toStdString());
    if (box.empty()) {
        m_bench.viewport->markObject({}, {});
        m_bench.notices->tell(
            Severity::Info, tr("“%1” cannot be shown: nothing of it is in the city.").arg(object));
        return;
    }
    m_bench.viewport->frameBox(box);
    m_bench.viewport->markObject(box, object);
}

void ReportController::chooseFile() {
    auto* dialog = new QFileDialog(m_bench.window, tr("Save the import report"));
    dialog->setObjectName(QStringLiteral("reportSaveDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("json"));
    dialog->setNameFilter(tr("Reports (*.json)"));
    dialog->selectFile(QString::fromStdString(m_bench.document->project().name + "-import.json"));
    connect(dialog, &QFileDialog::fileSelected, this, &ReportController::save);
    dialog->open();
}

void ReportController::save(const QString& path) {
    const auto prepared = m_bench.live->prepared();
    if (!prepared)
        return;
    const LoadedCity& city = prepared->loaded();
    const auto& file = m_bench.document->file();
    const std::string project =
        file.empty() ? m_bench.document->project().name : file.generic_string();
    const auto written = writeFileAtomically(
        path.toStdString(),
        importReportText({project, city.city.frame, city.generatedGround, city.groundFit,
                          city.remarks, city.files, city.city.objects}));
    if (!written)
        m_bench.notices->tell(written.error());
}

}  // namespace reflet
