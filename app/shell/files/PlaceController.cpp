// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/PlaceController.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/GroundModels.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/files/PlaceDialog.h"

#include <QMainWindow>

namespace reflet {

PlaceController::PlaceController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.commands->action(Command::PlaceModel), &QAction::triggered, this,
            &PlaceController::ask);
    connect(bench.live, &LiveCity::remark, this, [this](const Diagnostic& remark) {
        if (remark.code == "ground-fit")
            offerToMoveTerrain();
    });
}

void PlaceController::ask() {
    QStringList models;
    for (const ModelReference& model : m_bench.document->project().models)
        models << QString::fromStdString(model.path);
    if (models.isEmpty()) {
        m_bench.notices->tell(Severity::Info, tr("There is no model yet: drop a city first."));
        return;
    }
    auto* dialog = new PlaceDialog(models, m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this, [this, dialog] { place(dialog->chosen()); });
    dialog->open();
}

void PlaceController::place(const PlaceRequest& request) {
    const Project before = m_bench.document->project();
    m_bench.jobs->run<PlacedProject>(
        {.title = tr("Placing the model"), .lane = QStringLiteral("place")},
        [before, request, folder = m_bench.document->folder()](const JobContext& job) {
            return placeModel(before, request, folder, job);
        },
        this,
        [this, before](Result<PlacedProject> placed) {
            if (!placed) {
                m_bench.notices->tell(placed.error());
                return;
            }
            if (projectToJson(before) != projectToJson(m_bench.document->project())) {
                m_bench.notices->tell(Severity::Warning,
                                      tr("The project was changed meanwhile; please place the "
                                         "model once more."));
                return;
            }
            for (const Diagnostic& remark : placed->remarks)
                m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                                      QString::fromStdString(remark.remedy));
            m_bench.document->replaceProject(std::move(placed->project), tr("Place a model"));
        });
}

void PlaceController::offerToMoveTerrain() {
    const auto prepared = m_bench.live->prepared();
    const auto fit = prepared ? groundFit(prepared->city()) : std::nullopt;
    if (!fit)
        return;
    const QString figure = QString::number(fit->median, 'f', 1);
    m_bench.notices->tell(
        Severity::Warning,
        tr("The buildings do not stand on the terrain: it lies %1 m off.").arg(figure),
        {{tr("Move the terrain"), [this, by = fit->median] {
              Project project = m_bench.document->project();
              for (ModelReference& model : project.models) {
                  if (model.use != ModelUse::Terrain)
                      continue;
                  ModelPlacement placement = model.placement.value_or(ModelPlacement{});
                  placement.offset.z += by;
                  model.placement = placement;
              }
              m_bench.document->replaceProject(std::move(project), tr("Move the terrain"));
          }}});
}

}  // namespace reflet
