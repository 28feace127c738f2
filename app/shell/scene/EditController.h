// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "app/shell/scene/DragNumber.h"
#include "core/project/ProjectItem.h"

#include <QObject>
#include <optional>

class QMenu;

namespace reflet {

/// Turns what the user does in the picture, on the plan and in the panels into steps of the
/// document.
class EditController : public QObject {
    Q_OBJECT
public:
    EditController(Workbench& bench, QObject* parent);

    /// The route that a new vehicle is put on: the selected one, that of the selected vehicle, or
    /// the first. Empty: there is none.
    [[nodiscard]] std::string routeForVehicle() const;
    /// Puts a vehicle on routeForVehicle() and selects it; tells what to do when there is no route.
    void addVehicle(const std::string& vehicle);

Q_SIGNALS:
    void routeDrawn(const QString& id);
    /// Others may add what they offer at a place on the ground (project frame).
    void groundMenuOpens(QMenu* menu, const glm::dvec3& ground);

private:
    void connectIntents();
    void connectCommands();
    void connectTree();
    void connectInspector();
    void connectLight();

    void select(const std::optional<ProjectItem>& item, bool extend);
    void placeProbe(const glm::dvec3& position);
    void drawRoute(const std::vector<glm::dvec3>& points);
    void moveRoutePoint(const QString& id, int index, const glm::dvec3& position, DragPhase phase);
    void insertRoutePoint(const QString& id, int index, const glm::dvec3& position,
                          DragPhase phase);
    void removeRoutePoint(const QString& id, int index);
    void moveReflector(const QString& id, double station, DragPhase phase);
    void showContextMenu(const QPoint& global, const std::optional<ProjectItem>& item,
                         const glm::dvec3& ground);
    void rename(const ProjectItem& item, const QString& name);
    void removeSelected();
    void duplicateSelected();

    [[nodiscard]] glm::dvec3 absolute(const glm::dvec3& inFrame) const;
    [[nodiscard]] const struct RouteSpec* route(const std::string& id) const;

    Workbench& m_bench;
    DragNumber m_drag;
    std::vector<glm::dvec3> m_pointsBeforeInsert;
};

}  // namespace reflet
