// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/vehicles/VehicleController.h"

#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/scene/EditController.h"
#include "app/shell/vehicles/VehicleDialog.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <algorithm>
#include <utility>

namespace reflet {
namespace {

/// As a project stores it: relative to its folder where there is one.
std::string storedPath(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto relative =
        folder.empty() ? std::filesystem::path() : file.lexically_relative(folder);
    return (relative.empty() ? file : relative).generic_string();
}

}  // namespace

VehicleController::VehicleController(Workbench& bench, EditController& edit, QObject* parent)
    : QObject(parent), m_bench(bench), m_edit(edit) {
    connect(bench.commands->action(Command::AddVehicleFile), &QAction::triggered, this,
            &VehicleController::chooseFile);
    connect(&edit, &EditController::routeDrawn, this, &VehicleController::putOnRoute);
}

void VehicleController::chooseFile() {
    auto* dialog = new QFileDialog(m_bench.window, tr("Add a vehicle"));
    dialog->setObjectName(QStringLiteral("vehicleFileDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilter(tr("Vehicles, glTF (*.glb *.gltf)"));
    connect(dialog, &QFileDialog::fileSelected, this, &VehicleController::bringIn);
    dialog->open();
}

void VehicleController::bringIn(const QString& path) {
    m_bench.jobs->run<VehicleOffer>(
        {.title = tr("Reading %1").arg(QFileInfo(path).fileName()),
         .lane = QStringLiteral("vehicleFile"),
         .replace = false},
        [file = std::filesystem::path(path.toStdString())](const JobContext& job) {
            return proposeVehicle(file, job);
        },
        this,
        [this](const Result<VehicleOffer>& offer) {
            if (!offer) {
                m_bench.notices->tell(offer.error());
            } else {
                propose(*offer);
            }
        });
}

void VehicleController::propose(const VehicleOffer& offer) {
    auto* dialog = new VehicleDialog(offer, *m_bench.jobs, m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this, [this, dialog] { take(dialog->chosen()); });
    dialog->open();
}

void VehicleController::take(VehicleModel model) {
    ProjectDocument& document = *m_bench.document;
    const std::string route = m_edit.routeForVehicle();
    model.path = storedPath(model.path, document.folder());
    const QString name = QFileInfo(QString::fromStdString(model.path)).completeBaseName();
    document.undoStack()->beginMacro(tr("Add the vehicle %1").arg(name));
    const std::string id = document.addVehicle(std::move(model));
    std::string reflector;
    if (!id.empty() && !route.empty()) {
        reflector = document.addReflector(id, route);
    }
    document.undoStack()->endMacro();
    if (id.empty()) {
        return;  // told by the document
    }
    if (!reflector.empty()) {
        document.selection()->set({ProjectItem::Kind::Reflector, reflector});
        return;
    }
    m_waiting = id;
    document.selection()->set({ProjectItem::Kind::Vehicle, id});
    m_bench.notices->tell(Severity::Info,
                          tr("“%1” is in the project and waits for a route to drive on.").arg(name),
                          {{tr("Draw a route"),
                            [this] { m_bench.commands->action(Command::DrawRoute)->trigger(); }}});
}

void VehicleController::putOnRoute(const QString& route) {
    const auto& vehicles = m_bench.document->project().vehicles;
    const std::string id = std::exchange(m_waiting, {});
    const bool there = std::any_of(vehicles.begin(), vehicles.end(),
                                   [&](const VehicleModel& model) { return model.id == id; });
    if (there) {
        m_bench.document->addReflector(id, route.toStdString());
    }
}

}  // namespace reflet
