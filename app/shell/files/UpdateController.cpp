// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/UpdateController.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/document/Selection.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/files/UpdateDialog.h"
#include "widgets/viewport/Viewport.h"

#include <QFileDialog>
#include <QMainWindow>
#include <algorithm>

namespace reflet {

UpdateController::UpdateController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.commands->action(Command::UpdateModel), &QAction::triggered, this,
            &UpdateController::chooseFile);
}

std::string UpdateController::chosenModel() const {
    std::vector<std::string> cities;
    for (const ModelReference& model : m_bench.document->project().models) {
        if (model.use == ModelUse::City)
            cities.push_back(model.path);
    }
    if (cities.size() == 1)
        return cities.front();
    for (const std::string& id : m_bench.document->selection()->ids(ProjectItem::Kind::Model)) {
        if (std::find(cities.begin(), cities.end(), id) != cities.end())
            return id;
    }
    m_bench.notices->tell(Severity::Info,
                          cities.empty()
                              ? tr("There is no city file yet: drop a city first.")
                              : tr("Select the city file that is to be updated in the panel "
                                   "Project first."));
    return {};
}

void UpdateController::chooseFile() {
    const std::string model = chosenModel();
    if (model.empty())
        return;
    auto* dialog = new QFileDialog(m_bench.window,
                                   tr("The new file for %1").arg(QString::fromStdString(model)));
    dialog->setObjectName(QStringLiteral("updateFileDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, model](const QString& file) { compare(model, file); });
    dialog->open();
}

void UpdateController::compare(const std::string& model, const QString& file) {
    const auto before = m_bench.live->prepared();
    if (!before || m_bench.live->loading()) {
        m_bench.notices->tell(Severity::Info,
                              tr("The city is still being read; please try again then."));
        return;
    }
    m_bench.jobs->run<SourceUpdate>(
        {.title = tr("Comparing the files"), .lane = QStringLiteral("update")},
        [before, model, path = std::filesystem::path(file.toStdString())](const JobContext& job) {
            return updateSource(*before, model, path, job);
        },
        this,
        [this](Result<SourceUpdate> update) {
            if (!update) {
                m_bench.notices->tell(update.error());
            } else if (update->sameFile) {
                m_bench.notices->tell(
                    Severity::Info,
                    tr("Nothing has changed: the file is the one that the project has."));
            } else {
                show(std::move(*update));
            }
        });
}

void UpdateController::show(SourceUpdate update) {
    auto* dialog = new UpdateDialog(std::move(update), m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &UpdateDialog::placeWanted, this,
            [this](const Box& box, const QString& object) {
                if (box.empty())
                    return;
                m_bench.viewport->frameBox(box);
                m_bench.viewport->markObject(box, object);
            });
    connect(dialog, &QDialog::accepted, this, [this, dialog] { apply(dialog->update()); });
    dialog->show();  // the city behind it stays within reach
}

void UpdateController::apply(const SourceUpdate& update) {
    // Only the model: the user may have worked on while the files were compared.
    Project project = m_bench.document->project();
    const auto model =
        std::find_if(project.models.begin(), project.models.end(),
                     [&](const ModelReference& m) { return m.path == update.model; });
    const auto renewed =
        std::find_if(update.project.models.begin(), update.project.models.end(),
                     [&](const ModelReference& m) { return m.path == update.file; });
    if (model == project.models.end() || renewed == update.project.models.end()) {
        m_bench.notices->tell(Severity::Warning,
                              tr("The city file was taken out of the project meanwhile."));
        return;
    }
    model->path = renewed->path;
    model->hash = renewed->hash;
    m_bench.document->replaceProject(std::move(project), tr("Update a city file"));
    Q_EMIT updated();
}

}  // namespace reflet
