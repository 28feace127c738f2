// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/gpu/Frame.h"
#include "core/traffic/Traffic.h"
#include "widgets/common/EditIntents.h"

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

/// The city from above, grid north up, with everything that the planner put into it. A passive
/// view: shows what the setters were given, and says what the user wants (EditIntents). Positions
/// are in the project frame; heights come from the heightfield. GUI thread.
///
/// Drag pans, the wheel zooms to the cursor, Home shows all, arrow keys pan, + and - zoom. Probes
/// and corners of selected routes are dragged; the middle of an edge makes a corner. Delete removes
/// the corner that was clicked last, or asks for the removal of the selection.
class PlanView : public QWidget {
    Q_OBJECT

public:
    /// intents: outlives the plan; null for its own.
    explicit PlanView(EditIntents* intents = nullptr, QWidget* parent = nullptr);
    ~PlanView() override;

    [[nodiscard]] EditIntents& intents() const;

    /// Null while there is none. The picture is made on a thread of its own.
    void setCity(std::shared_ptr<const DrawnCity> city);
    void setHeightfield(std::shared_ptr<const Heightfield> heightfield);
    /// For the coordinates under the cursor; crsName: for people, empty for local metres.
    void setFrame(const ProjectFrame& frame, const QString& crsName);
    void setProbes(std::vector<ProbeGlyph> probes);
    void setRoutes(std::vector<RouteGlyph> routes);
    void setTraffic(std::shared_ptr<const Traffic> traffic);
    /// Over the ground and below the routes, with a legend; null: not shown.
    void setCoverage(std::shared_ptr<const CoverageOverlay> coverage);
    void setTime(double seconds);
    /// The 3D viewer's place and cone.
    void setCamera(const Camera& camera);
    void setSelectedReflector(const std::string& id);

    void setTool(ViewportTool tool);
    [[nodiscard]] ViewportTool tool() const;
    /// Ends the route that is being drawn: routeDrawn, when it has two points or more.
    void finishRoute();
    void frameAll();
    void frameBox(const Box& box);

    /// Where a position of the frame is on the widget, and back (z = 0), in logical pixels.
    [[nodiscard]] QPointF toWidget(const glm::dvec3& position) const;
    [[nodiscard]] glm::dvec3 toFrame(const QPointF& point) const;
    /// Logical pixels a metre.
    [[nodiscard]] double scale() const;
    /// The ground's height there, 0 where none is known; what a new point gets.
    [[nodiscard]] double groundHeight(double x, double y) const;

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

Q_SIGNALS:
    void activated(reflet::ProjectItem item);  ///< double click: show it in 3D
    void hovered(std::optional<reflet::ProjectItem> item);
    void cameraDragged(reflet::Camera camera, reflet::DragPhase phase);
    void pictureReady();  ///< the city's picture is painted from now on

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool event(QEvent* event) override;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
