// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/common/DragSequence.h"
#include "widgets/plan/PlanPicture.h"
#include "widgets/plan/PlanScene.h"
#include "widgets/plan/PlanView.h"

#include <QPixmap>
#include <thread>

namespace reflet {

class CoverageLegend;

/// The state of a PlanView: what is shown, and what the mouse is doing.
struct PlanView::Impl {
    Impl(PlanView* owner, EditIntents* intents);
    ~Impl();

    PlanView* view;
    EditIntents* intents;
    PlanTransform transform;
    PlanScene scene;
    ViewportTool tool = ViewportTool::Navigate;
    CoverageLegend* legend = nullptr;

    // The city's picture.
    std::shared_ptr<const Heightfield> heightfield;
    std::shared_ptr<const PlanPicture> picture;
    std::jthread painter;
    bool pictureWanted = false;
    std::optional<Box> houses;  ///< of the heightfield, once they were asked for
    quint64 pictureNumber = 0;  ///< pictures of older heightfields are dropped
    QPixmap ground;             ///< the picture as the present transform shows it
    PlanTransform groundTransform;
    bool groundDark = false;
    bool framed = false;  ///< the user or a caller has chosen where to look

    // The text below.
    glm::dvec3 origin{0.0};
    QString crsName;
    std::optional<QPointF> cursor;

    // The mouse.
    QPointF pressed;
    Qt::MouseButton button = Qt::NoButton;
    PlanHit pressedHit;
    bool moving = false;   ///< beyond the threshold of a click
    bool panning = false;  ///< the view moves
    bool doubleClicked = false;
    glm::dvec2 panFrom{0.0};
    glm::dvec3 grabbed{0.0};  ///< where the dragged thing was
    DragSequence<glm::dvec3> drag;
    DragSequence<Camera> cameraDrag;

    void forgetPicture();
    /// Has the picture painted if it was not since it was forgotten: not before it is seen.
    void startPicture();
    void fitAll();
    void takePicture(std::shared_ptr<const PlanPicture> painted, quint64 number);
    void renderGround();
    [[nodiscard]] QString footer() const;
    [[nodiscard]] std::optional<double> knownGround(double x, double y) const;
    [[nodiscard]] glm::dvec3 onGround(const glm::dvec2& p) const;
    [[nodiscard]] static std::optional<ProjectItem> itemOf(const PlanHit& hit);

    void reportDrag(const glm::dvec3& position, DragPhase phase);
    void beginDrag();
    void continueDrag(const QPointF& point);
    void endDrag();
    bool cancelDrag();
    void click(const QPointF& point, bool extend);
    void hover(const QPointF& point);
    void clearHover();
    void showCursor();
    void leaveTool();
    void finishRoute();
    void setDraft(std::vector<glm::dvec3> points);
    /// Keys that mean something here before they mean something to the window.
    [[nodiscard]] bool wants(int key) const;
    [[nodiscard]] QPointF keyPoint() const;
    bool toolKey(QKeyEvent* event);
    bool navigationKey(QKeyEvent* event);
};

}  // namespace reflet
