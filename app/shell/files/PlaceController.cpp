// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/PlaceController.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/AxisOrder.h"
#include "app/pipeline/GroundModels.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"

#include <QMainWindow>
#include <algorithm>
#include <cmath>

namespace reflet {
PlaceController::PlaceController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.commands->action(Command::PlaceModel), &QAction::triggered, this,
            &PlaceController::ask);
    connect(bench.live, &LiveCity::remark, this, [this](const Diagnostic& remark) {
        if (remark.code == "ground-fit")
            offerToMoveTerrain();
    });
    connect(bench.live, &LiveCity::cityChanged, this, &PlaceController::offerToExchangeAxes);
}

std::vector<PlaceableModel> PlaceController::models() const {
    std::vector<PlaceableModel> models;
    const auto folder = m_bench.document->folder();
    const std::vector<FileReport> reports = m_bench.live->reports();
    for (const ModelReference& model : m_bench.document->project().models) {
        const std::string file = modelPath(model, folder).string();
        const auto report = std::find_if(reports.begin(), reports.end(),
                                         [&](const FileReport& r) { return r.file == file; });
        const bool told = !model.crs.empty() && model.crs != "local";
        models.push_back({QString::fromStdString(model.path), model.placement,
                          told || (model.crs.empty() && report != reports.end() &&
                                   report->summary.crsHorizontal.has_value() && !model.placement)});
    }
    // Those first that need it.
    std::stable_partition(models.begin(), models.end(),
                          [](const PlaceableModel& model) { return !model.hasPlace; });
    return models;
}

void PlaceController::ask() {
    auto known = models();
    if (known.empty())
        return;
    auto* dialog = new PlaceDialog(std::move(known), m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &PlaceDialog::placeRequested, this,
            [this, dialog](const PlaceRequest& request) { place(request, dialog); });
    dialog->open();
}

void PlaceController::place(const PlaceRequest& request, PlaceDialog* dialog) {
    const Project before = m_bench.document->project();
    m_bench.jobs->run<PlacedProject>(
        {.title = tr("Placing the model"), .lane = QStringLiteral("place")},
        [before, request, folder = m_bench.document->folder()](const JobContext& job) {
            return placeModel(before, request, folder, job);
        },
        dialog,
        [this, before, dialog](Result<PlacedProject> placed) {
            if (!placed) {
                dialog->tell(placed.error());
                return;
            }
            if (projectToJson(before) != projectToJson(m_bench.document->project())) {
                dialog->tell({ErrorCode::Refused,
                              tr("The project was changed meanwhile.").toStdString(),
                              "",
                              tr("Press Place once more.").toStdString(),
                              {}});
                return;
            }
            dialog->finish();
            for (const Diagnostic& remark : placed->remarks)
                m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                                      QString::fromStdString(remark.remedy));
            m_bench.document->replaceProject(std::move(placed->project), tr("Place a model"));
        });
}

void PlaceController::offerToExchangeAxes() {
    const auto folder = m_bench.document->folder();
    const std::vector<FileReport> reports = m_bench.live->reports();
    std::vector<std::string> crossed;
    for (const ModelReference& model : m_bench.document->project().models) {
        const std::string file = modelPath(model, folder).string();
        const bool told = std::any_of(reports.begin(), reports.end(), [&](const FileReport& r) {
            return r.file == file &&
                   std::any_of(r.diagnostics.begin(), r.diagnostics.end(),
                               [](const Diagnostic& d) { return d.code == kAxesExchanged; });
        });
        if (told && model.use == ModelUse::City)
            crossed.push_back(model.path);
    }
    if (crossed == m_offered)
        return;
    m_offered = crossed;
    if (crossed.empty())
        return;
    m_bench.notices->tell(
        Severity::Warning,
        tr("%1 lies outside the area of its reference system; with east and north exchanged it "
           "would lie inside.")
            .arg(QString::fromStdString(crossed.front())),
        {{tr("Exchange east and north"), [this, crossed] { exchangeAxes(crossed); }}},
        tr("The picture shows it as the file has it. It can be taken back with Undo."));
}

void PlaceController::exchangeAxes(const std::vector<std::string>& models) {
    const Project before = m_bench.document->project();
    m_bench.jobs->run<Project>(
        {.title = tr("Exchanging east and north"), .lane = QStringLiteral("place")},
        [before, models, folder = m_bench.document->folder()](const JobContext& job) {
            return withAxisOrder(before, models, "ne", folder, job);
        },
        this,
        [this, before](Result<Project> turned) {
            if (!turned)
                m_bench.notices->tell(turned.error());
            else if (before.models == m_bench.document->project().models)
                m_bench.document->replaceProject(std::move(*turned), tr("Exchange east and north"));
        });
}

void PlaceController::offerToMoveTerrain() {
    // Large cities have many buildings to look at.
    m_bench.jobs->run<std::optional<GroundFit>>(
        {.title = {}, .lane = QStringLiteral("groundFit"), .visible = false},
        [city = m_bench.live->prepared()](const JobContext&) -> Result<std::optional<GroundFit>> {
            return city ? groundFit(city->city()) : std::nullopt;
        },
        this,
        [this](const Result<std::optional<GroundFit>>& fit) {
            if (fit && *fit)
                tellFit(**fit);
        });
}

void PlaceController::tellFit(const GroundFit& fit) {
    const auto isTerrain = [](const ModelReference& m) { return m.use == ModelUse::Terrain; };
    const auto& models = m_bench.document->project().models;
    const QString figure = QString::number(std::abs(fit.median), 'f', 1);
    const QString what = fit.median > 0.0
                             ? tr("The buildings hang %1 m above the terrain.").arg(figure)
                             : tr("The buildings are buried %1 m in the terrain.").arg(figure);
    if (std::none_of(models.begin(), models.end(), isTerrain)) {
        m_bench.notices->tell(Severity::Warning, what, {},
                              tr("Both come from the city's files: see where the heights of the "
                                 "terrain come from."));
        return;
    }
    const Project asRead = m_bench.document->project();
    m_bench.notices->tell(
        Severity::Warning, what,
        {{tr("Move the terrain"),
          [this, isTerrain, by = fit.median, asRead] {
              Project project = m_bench.document->project();
              if (project.models != asRead.models)
                  return;  // what was measured is no more
              for (ModelReference& model : project.models) {
                  if (!isTerrain(model))
                      continue;
                  ModelPlacement placement = model.placement.value_or(ModelPlacement{});
                  placement.offset.z += by;
                  model.placement = placement;
              }
              m_bench.document->replaceProject(std::move(project), tr("Move the terrain"));
          }}},
        tr("Their heights may be measured from different zeros. It can be taken back with Undo."));
}

}  // namespace reflet
