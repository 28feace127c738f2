// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/EditController.h"

#include "app/document/LiveCity.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/ProjectTree.h"
#include "widgets/panels/SunPanel.h"
#include "widgets/panels/Timeline.h"
#include "widgets/plan/PlanView.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <QMainWindow>
#include <QMenu>
#include <algorithm>

namespace reflet {

EditController::EditController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench), m_drag(*bench.document) {
    connectIntents();
    connectCommands();
    connectTree();
    connectInspector();
    connectLight();
    connect(bench.document, &ProjectDocument::changeRefused, this,
            [this](const Error& error) { m_bench.notices->tell(error); });
}

void EditController::connectIntents() {
    EditIntents* intents = m_bench.intents;
    connect(intents, &EditIntents::clicked, this, &EditController::select);
    connect(intents, &EditIntents::probePlaced, this, &EditController::placeProbe);
    connect(intents, &EditIntents::probeDragged, this,
            [this](const QString& id, const glm::dvec3& position, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) {
                    m_bench.document->moveProbe(id.toStdString(), absolute(position), drag);
                });
            });
    connect(intents, &EditIntents::routeDrawn, this, &EditController::drawRoute);
    connect(intents, &EditIntents::routePointDragged, this, &EditController::moveRoutePoint);
    connect(intents, &EditIntents::routePointInserted, this, &EditController::insertRoutePoint);
    connect(intents, &EditIntents::routePointRemoved, this, &EditController::removeRoutePoint);
    connect(intents, &EditIntents::reflectorDragged, this, &EditController::moveReflector);
    connect(intents, &EditIntents::removeRequested, this, &EditController::removeSelected);
    connect(intents, &EditIntents::contextMenuAt, this, &EditController::showContextMenu);
}

void EditController::connectCommands() {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    ProjectDocument* document = m_bench.document;
    on(Command::Undo, [document] { document->undoStack()->undo(); });
    on(Command::Redo, [document] { document->undoStack()->redo(); });
    on(Command::Delete, [this] { removeSelected(); });
    on(Command::Duplicate, [this] { duplicateSelected(); });
    on(Command::AddTram, [this] { addVehicle("tram"); });
    on(Command::AddBus, [this] { addVehicle("bus"); });
    on(Command::AddCar, [this] { addVehicle("car"); });
    on(Command::AddSphere, [this] { addVehicle("sphere"); });
    on(Command::AddPerson, [this] { addVehicle("woman"); });

    auto setTool = [this](ViewportTool tool) {
        m_bench.viewport->setTool(tool);
        m_bench.plan->setTool(tool);
    };
    on(Command::PlaceProbe, [setTool](bool chosen) {
        setTool(chosen ? ViewportTool::PlaceProbe : ViewportTool::Navigate);
    });
    on(Command::DrawRoute, [setTool](bool chosen) {
        setTool(chosen ? ViewportTool::DrawRoute : ViewportTool::Navigate);
    });
    on(Command::Navigate, [setTool] { setTool(ViewportTool::Navigate); });
    auto followTool = [this, setTool](ViewportTool tool) {
        m_bench.commands->action(Command::PlaceProbe)->setChecked(tool == ViewportTool::PlaceProbe);
        m_bench.commands->action(Command::DrawRoute)->setChecked(tool == ViewportTool::DrawRoute);
        setTool(tool);
    };
    connect(m_bench.intents, &EditIntents::toolChanged, this, followTool);
}

void EditController::connectTree() {
    ProjectTree* tree = m_bench.tree;
    ProjectDocument* document = m_bench.document;
    connect(tree, &ProjectTree::selectionChanged, this, [document](std::vector<ProjectItem> items) {
        document->selection()->set(std::move(items));
    });
    connect(tree, &ProjectTree::renamed, this, &EditController::rename);
    connect(tree, &ProjectTree::removeRequested, this,
            [document](const std::vector<ProjectItem>& items) { document->remove(items); });
    connect(tree, &ProjectTree::duplicateRequested, this, [this] { duplicateSelected(); });
    connect(tree, &ProjectTree::contextMenuAt, this, [this](const QPoint& global) {
        showContextMenu(global, m_bench.document->selection()->current(), {});
    });
}

void EditController::connectInspector() {
    Inspector* inspector = m_bench.inspector;
    ProjectDocument* document = m_bench.document;
    // Several items may be edited at once: one step of undo.
    connect(inspector, &Inspector::probesChanged, this,
            [this, document](const std::vector<Probe>& probes, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setProbes(probes, drag); });
            });
    connect(inspector, &Inspector::routesChanged, this,
            [this, document](const std::vector<RouteSpec>& routes, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setRoutes(routes, drag); });
            });
    connect(inspector, &Inspector::reflectorsChanged, this,
            [this, document](const std::vector<Reflector>& reflectors, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setReflectors(reflectors, drag); });
            });
    connect(inspector, &Inspector::vehicleChanged, this,
            [this, document](const VehicleModel& vehicle, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setVehicle(vehicle, drag); });
            });
    connect(inspector, &Inspector::renamed, this, &EditController::rename);
    connect(inspector, &Inspector::projectNameChanged, this,
            [document](const QString& name) { document->setName(name.toStdString()); });
    connect(inspector, &Inspector::heightfieldChanged, this,
            [this, document](const HeightfieldSettings& heightfield, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setHeightfield(heightfield, drag); });
            });
    connect(inspector, &Inspector::viewChanged, this,
            [this, document](const QString& name, const View& view) {
                if (name != QString::fromStdString(view.name)) {
                    rename({ProjectItem::Kind::View, name.toStdString()},
                           QString::fromStdString(view.name));
                }
                document->setView(view);
            });
    TuningPanel* tuning = m_bench.tuning;
    connect(tuning, &TuningPanel::tuningChanged, this,
            [this, document](const MemSettings& settings, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setTuning(settings, drag); });
            });
    connect(tuning, &TuningPanel::bakeChanged, this,
            [document](const BakeSettings& settings) { document->setBake(settings); });
}

void EditController::connectLight() {
    SunPanel* sun = m_bench.sun;
    ProjectDocument* document = m_bench.document;
    connect(sun, &SunPanel::dateChanged, this,
            [this, document](const DateTime& date, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setDate(date, drag); });
            });
    connect(sun, &SunPanel::turbidityChanged, this,
            [this, document](float turbidity, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setTurbidity(turbidity, drag); });
            });
    connect(sun, &SunPanel::exposureChanged, this,
            [this, document](float exposure, DragPhase phase) {
                m_drag.apply(phase, [&](int drag) { document->setExposure(exposure, drag); });
            });
}

glm::dvec3 EditController::absolute(const glm::dvec3& inFrame) const {
    return inFrame + m_bench.document->project().frame.origin;
}

const RouteSpec* EditController::route(const std::string& id) const {
    const auto& routes = m_bench.document->project().routes;
    const auto found = std::find_if(routes.begin(), routes.end(),
                                    [&](const RouteSpec& spec) { return spec.id == id; });
    return found == routes.end() ? nullptr : &*found;
}

void EditController::rename(const ProjectItem& item, const QString& name) {
    if (const auto renamed = m_bench.document->rename(item, name.toStdString()); !renamed) {
        m_bench.notices->tell(renamed.error());
        m_bench.tree->setProject(m_bench.document->project());
    }
}

void EditController::select(const std::optional<ProjectItem>& item, bool extend) {
    Selection* selection = m_bench.document->selection();
    if (!item) {
        if (!extend) {
            selection->clear();
        }
    } else if (extend) {
        selection->toggle(*item);
    } else {
        selection->set(*item);
    }
}

void EditController::placeProbe(const glm::dvec3& position) {
    const std::string id = m_bench.document->addProbe(absolute(position));
    if (!id.empty()) {
        m_bench.document->selection()->set({ProjectItem::Kind::Probe, id});
    }
}

void EditController::drawRoute(const std::vector<glm::dvec3>& points) {
    std::vector<glm::dvec3> line;
    line.reserve(points.size());
    for (const glm::dvec3& point : points) {
        line.push_back(absolute(point));
    }
    const std::string id = m_bench.document->addRoute(line);
    if (id.empty()) {
        return;
    }
    m_bench.document->selection()->set({ProjectItem::Kind::Route, id});
    m_bench.viewport->setTool(ViewportTool::Navigate);
    m_bench.plan->setTool(ViewportTool::Navigate);
    m_bench.commands->action(Command::DrawRoute)->setChecked(false);
    Q_EMIT routeDrawn(QString::fromStdString(id));
}

void EditController::moveRoutePoint(const QString& id, int index, const glm::dvec3& position,
                                    DragPhase phase) {
    m_drag.apply(phase, [&](int drag) {
        const RouteSpec* present = route(id.toStdString());
        if (!present || index < 0 || std::size_t(index) >= present->points.size()) {
            return;
        }
        RouteSpec changed = *present;
        changed.points[std::size_t(index)] = absolute(position);
        m_bench.document->setRoute(changed, drag);
    });
}

void EditController::insertRoutePoint(const QString& id, int index, const glm::dvec3& position,
                                      DragPhase phase) {
    m_drag.apply(phase, [&](int drag) {
        const RouteSpec* present = route(id.toStdString());
        if (!present) {
            return;
        }
        // The index counts in the route as it was before the drag.
        const bool first = phase == DragPhase::Begin || drag < 0;
        if (first) {
            m_pointsBeforeInsert = present->points;
        }
        if (index < 0 || std::size_t(index) > m_pointsBeforeInsert.size()) {
            return;
        }
        RouteSpec changed = *present;
        changed.points = m_pointsBeforeInsert;
        changed.points.insert(changed.points.begin() + index, absolute(position));
        m_bench.document->setRoute(changed, drag);
    });
}

void EditController::removeRoutePoint(const QString& id, int index) {
    const RouteSpec* present = route(id.toStdString());
    if (!present || index < 0 || std::size_t(index) >= present->points.size()) {
        return;
    }
    RouteSpec changed = *present;
    changed.points.erase(changed.points.begin() + index);
    m_bench.document->setRoute(changed);
}

void EditController::moveReflector(const QString& id, double station, DragPhase phase) {
    const auto& reflectors = m_bench.document->project().reflectors;
    const auto found = std::find_if(reflectors.begin(), reflectors.end(),
                                    [&](const Reflector& r) { return r.id == id.toStdString(); });
    if (found == reflectors.end()) {
        return;
    }
    Reflector changed = *found;
    double driven = changed.speed * m_bench.viewport->time();
    if (station < driven) {
        // It could not be there yet at this time: the drive starts anew from where it is put.
        m_bench.viewport->setTime(0.0);
        driven = 0.0;
    }
    changed.start = station - driven;
    m_drag.apply(phase, [&](int drag) { m_bench.document->setReflector(changed, drag); });
}

std::string EditController::routeForVehicle() const {
    const Project& project = m_bench.document->project();
    for (const ProjectItem& item : m_bench.document->selection()->items()) {
        if (item.kind == ProjectItem::Kind::Route) {
            return item.id;
        }
        for (const Reflector& reflector : project.reflectors) {
            if (item == ProjectItem{ProjectItem::Kind::Reflector, reflector.id}) {
                return reflector.route;
            }
        }
    }
    return project.routes.empty() ? std::string() : project.routes.front().id;
}

void EditController::addVehicle(const std::string& vehicle) {
    const std::string onto = routeForVehicle();
    if (onto.empty()) {
        m_bench.notices->tell(Severity::Info, tr("A vehicle needs a route to drive on."),
                              {{tr("Draw a route"), [this] {
                                    m_bench.commands->action(Command::DrawRoute)->trigger();
                                }}});
        return;
    }
    const std::string id = m_bench.document->addReflector(vehicle, onto);
    if (!id.empty()) {
        m_bench.document->selection()->set({ProjectItem::Kind::Reflector, id});
    }
}

void EditController::removeSelected() {
    const std::vector<ProjectItem> items = m_bench.document->selection()->items();
    if (!items.empty()) {
        m_bench.document->remove(items);
    }
}

void EditController::duplicateSelected() {
    const std::vector<ProjectItem> items = m_bench.document->selection()->items();
    if (items.empty()) {
        return;
    }
    if (const auto copies = m_bench.document->duplicate(items); !copies) {
        m_bench.notices->tell(copies.error());
    }
}

void EditController::showContextMenu(const QPoint& global, const std::optional<ProjectItem>& item,
                                     const glm::dvec3& ground) {
    if (item && !m_bench.document->selection()->contains(*item)) {
        m_bench.document->selection()->set(*item);
    }
    auto* menu = new QMenu(m_bench.window);
    menu->setObjectName(QStringLiteral("contextMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const Commands& commands = *m_bench.commands;
    if (item) {
        menu->addAction(commands.action(Command::Frame));
        menu->addAction(commands.action(Command::Duplicate));
        menu->addAction(commands.action(Command::Delete));
        if (item->kind == ProjectItem::Kind::Probe) {
            menu->addAction(commands.action(Command::PreviewSphere));
        }
        if (item->kind == ProjectItem::Kind::Route) {
            menu->addSeparator();
            for (const Command add :
                 {Command::AddTram, Command::AddBus, Command::AddCar, Command::AddSphere,
                  Command::AddPerson, Command::AddVehicleFile}) {
                menu->addAction(commands.action(add));
            }
        }
        if (item->kind == ProjectItem::Kind::Vehicle) {
            QAction* add = menu->addAction(tr("&Add it to the route"));
            connect(add, &QAction::triggered, this, [this, id = item->id] { addVehicle(id); });
        }
        if (item->kind == ProjectItem::Kind::Reflector) {
            menu->addAction(commands.action(Command::Follow));
            menu->addAction(commands.action(Command::CheckReference));
        }
    } else {
        QAction* place = menu->addAction(tr("Place a reflection probe here"));
        connect(place, &QAction::triggered, this, [this, ground] {
            constexpr double kBodyHeight = 1.75;  // metres: the middle of a vehicle's body
            placeProbe(ground + glm::dvec3(0.0, 0.0, kBodyHeight));
        });
        menu->addAction(commands.action(Command::DrawRoute));
        menu->addAction(commands.action(Command::FrameAll));
    }
    // Routes lie on the ground.
    if (!item || item->kind == ProjectItem::Kind::Route) {
        Q_EMIT groundMenuOpens(menu, ground);
    }
    menu->popup(global);
}

}  // namespace reflet
