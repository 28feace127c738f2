// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/ProjectItem.h"
#include "widgets/ViewIntents.h"

#include <glm/vec3.hpp>

#include <QObject>
#include <QPoint>
#include <QString>
#include <optional>
#include <vector>

namespace reflet {

/// What the user wants changed, in one vocabulary for all views of the city: the 3D viewport and
/// the plan emit these signals on the object that they are given, and one listener does what they
/// say. Positions are in the project frame, ids are UTF-8; steps follow DragPhase. GUI thread.
class EditIntents : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

Q_SIGNALS:
    /// Nothing under the cursor: nullopt.
    void clicked(const std::optional<reflet::ProjectItem>& item, bool extend);
    /// The tool stays chosen.
    void probePlaced(const glm::dvec3& position);
    void probeDragged(const QString& id, const glm::dvec3& position, reflet::DragPhase phase);
    /// At least two points.
    void routeDrawn(const std::vector<glm::dvec3>& points);
    /// While DrawRoute draws; 0 when it was given up or has ended.
    void routeGrowing(int points);
    void routePointDragged(const QString& id, int index, const glm::dvec3& position,
                           reflet::DragPhase phase);
    /// Before the handle `index`, counted in the route as it was before Begin.
    void routePointInserted(const QString& id, int index, const glm::dvec3& position,
                            reflet::DragPhase phase);
    void routePointRemoved(const QString& id, int index);
    /// station: metres along its route, of the vehicle's middle.
    void reflectorDragged(const QString& id, double station, reflet::DragPhase phase);
    /// A suggested probe was clicked, which does not exist yet.
    void ghostClicked(const QString& id);
    /// Of all that is selected.
    void removeRequested();
    void contextMenuAt(const QPoint& global, const std::optional<reflet::ProjectItem>& item,
                       const glm::dvec3& ground);
    /// A view has changed its tool; Escape leaves one.
    void toolChanged(reflet::ViewportTool tool);
};

}  // namespace reflet
