// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/Picker.h"
#include "widgets/viewport/Viewport.h"
#include "widgets/viewport/camera/CameraDriver.h"
#include "widgets/viewport/frames/FrameSource.h"
#include "widgets/viewport/frames/GlCanvas.h"
#include "widgets/viewport/input/CameraDrags.h"
#include "widgets/viewport/input/PointerDrag.h"
#include "widgets/viewport/overlay/CoverageLabels.h"
#include "widgets/viewport/overlay/Hud.h"
#include "widgets/viewport/overlay/ObjectMark.h"
#include "widgets/viewport/overlay/WipeBar.h"

#include <QBasicTimer>
#include <QElapsedTimer>
#include <QLabel>
#include <QMetaObject>
#include <QPoint>
#include <QSet>
#include <QTimer>

namespace reflet {

/// The viewport's state and what it does with it; split over Viewport.cpp (what is shown),
/// ViewportPicture.cpp (OpenGL) and input/Viewport*.cpp (tools, drags, mouse, keys).
struct Viewport::Impl {
    Impl(Viewport& widget, EditIntents* given, Drawing where);

    Viewport& q;
    EditIntents* intents;
    Drawing drawing;

    // What is shown.
    SceneState state;
    ReflectorBoxes boxes;
    std::vector<BoxedReflector> reflectors;  ///< where they are in the picture that is shown
    std::vector<ProbeGlyph> probes;
    std::vector<RouteGlyph> routes;
    CameraDriver driver;
    Hud* hud = nullptr;
    WipeBar* wipeBar = nullptr;
    ObjectMark* mark = nullptr;
    CoverageLabels* labels = nullptr;
    QLabel* problem = nullptr;  ///< stands in place of the picture
    bool figuresShown = false;

    // The picture.
    std::unique_ptr<FrameSource> source;
    std::optional<DrawnFrame> shown;
    std::uint64_t announced = 0;  ///< number of the newest picture that others were told of
    GlCanvas* canvas = nullptr;   ///< none where pictures come as pixels
    unsigned readFramebuffer = 0;
    QMetaObject::Connection contextGoes;
    int losses = 0;
    QElapsedTimer lastLoss;

    // Input.
    ViewportTool tool = ViewportTool::Navigate;
    std::unique_ptr<PointerDrag> drag;                          ///< in progress, past the threshold
    std::function<std::unique_ptr<PointerDrag>()> pendingDrag;  ///< begins when the mouse moves
    Qt::MouseButton pressed = Qt::NoButton;
    QPointF pressedAt;
    std::optional<QPointF> mouse;  ///< in the widget; none when it is elsewhere
    std::optional<Picked> hovered;
    std::optional<Picked> dragged;    ///< shown where it is dragged to, until the project follows
    std::optional<glm::dvec3> ghost;  ///< where the tool would put something
    std::vector<glm::dvec3> draft;    ///< of the route that is being drawn
    QSet<int> walkKeys;
    bool walkFast = false;
    QTimer motion;  ///< flights and steps
    QElapsedTimer motionClock;
    bool posting = false;  ///< at the end of this turn

    // What is shown (Viewport.cpp). What is posted in one turn of the event loop is one picture.
    void post(bool moving);
    void cityChanged();
    void rebuildOverlays(bool moving);
    void placeReflectors(double seconds);
    void applyCamera(const Camera& camera);
    void flyTo(const Camera& camera);
    /// Flies, where that is wanted and can be seen; else it is there at once.
    void moveTo(const Camera& camera, bool animate);
    void cameraMoved();
    void tick();
    void startMotion();
    void leaveFollowing();
    [[nodiscard]] double secondsShown() const;
    [[nodiscard]] glm::dvec3 middleOfView() const;
    void updateHud();

    // The picture (ViewportPicture.cpp).
    void makeCanvas();
    void leaveCanvas();
    void startDrawing();
    void startOnCanvas();
    void startSource(std::unique_ptr<FrameSource> made);
    void stopDrawing();
    void paintOnCanvas();
    void updatePicture();
    void contextLost();
    void showProblem(const Error& error);
    void takeFrame();
    void announce(const DrawnFrame& frame);
    void bindForReading(const DrawnFrame& frame);
    [[nodiscard]] QImage readTexture(const DrawnFrame& frame);
    void copyToCanvas(const DrawnFrame& frame);
    [[nodiscard]] QSize deviceSize() const;

    // What is under the mouse, and tools (input/ViewportTools.cpp).
    [[nodiscard]] std::optional<Picked> pickAt(const QPointF& at) const;
    /// Id of the suggested probe under the mouse; empty: none.
    [[nodiscard]] std::string ghostAt(const QPointF& at) const;
    [[nodiscard]] glm::dvec3 pivotAt(const QPointF& at) const;
    void hoverAt(const std::optional<QPointF>& at);
    void updateCursor();
    void clickAt(const QPointF& at, bool extend);
    void addDraftPoint(const QPointF& at);
    void changeTool(ViewportTool to, bool finish);
    void clearDraft();
    [[nodiscard]] bool cancelSomething();

    // Drags (input/ViewportDrags.cpp).
    [[nodiscard]] std::unique_ptr<PointerDrag> cameraDrag(CameraDrag::Move how);
    [[nodiscard]] std::unique_ptr<PointerDrag> followDrag();
    [[nodiscard]] std::unique_ptr<PointerDrag> pointDrag(const Picked& picked);
    [[nodiscard]] std::unique_ptr<PointerDrag> reflectorDrag(const Picked& picked);
    [[nodiscard]] bool draggable(const Picked& picked) const;
    void tellDragged(const Picked& picked, const glm::dvec3& place, DragPhase phase);
    void endPress(bool cancel);

    // Keys (input/ViewportKeys.cpp).
    [[nodiscard]] bool navigateByKey(int key, bool shift);
    [[nodiscard]] bool toolKey(int key);
    void walkInputChanged();
    [[nodiscard]] bool wantsKey(int key) const;

    [[nodiscard]] static glm::dvec2 pixelOf(const QPointF& at) { return {at.x(), at.y()}; }
};

}  // namespace reflet
