// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/AmbientVolume.h"
#include "core/base/Error.h"
#include "core/gpu/Frame.h"
#include "widgets/common/EditIntents.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <QImage>
#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

/// The city in three dimensions. Shows values and says what the user wants (EditIntents); never
/// changes a project. Positions are in the project frame, seconds count from the start of the
/// drive. A thread of its own draws, with an OpenGL context of its own; the interface only copies
/// finished pictures, so it never waits for the scene. Use it on the thread
/// of the interface.
///
/// Mouse: left drag turns the camera about the point under the mouse (walking: looks around), right
/// or middle drag, or left with Shift, moves it along the ground, the wheel goes to the point under
/// the mouse. Probes, corners of the selected route and the selected vehicle are dragged with the
/// left button; Shift moves a probe up and down, Alt switches snapping off. Keys: F frames the
/// selection, Home everything, 1, 3 and 7 look north, look west and down, W walks and walks on,
/// Escape leaves whatever is going on; arrows move, with Shift they turn, + and - go nearer and
/// farther.
class Viewport : public QWidget {
    Q_OBJECT
public:
    /// Where pictures are drawn. Threaded: in a context that shares with the window's. Headless: in
    /// one of its own, with pixels handed over and painted without OpenGL, for drivers in software.
    /// InPlace: in the window's, for drivers without threads; the interface waits for each picture.
    enum class Drawing { Automatic, Threaded, Headless, InPlace };

    /// intents: outlives the viewport; null for its own.
    explicit Viewport(EditIntents* intents = nullptr, QWidget* parent = nullptr,
                      Drawing drawing = Drawing::Automatic);
    ~Viewport() override;

    [[nodiscard]] EditIntents& intents() const;

    // What is shown. Values that are equal to the present ones cost nothing.
    void setCity(std::shared_ptr<const DrawnCity> city);
    void setLighting(const Lighting& lighting);
    void setAmbient(std::shared_ptr<const AmbientVolume> ambient);
    void setRems(const RemSet& rems);
    void setTraffic(std::shared_ptr<const Traffic> traffic);
    void setTuning(const MemSettings& tuning);
    void setExposure(float exposure);
    /// The method left of the wipe and, when there is one, that on its right; without it the wipe
    /// is hidden.
    void setMethods(Method left, std::optional<Method> right);
    /// share: of the width that lies left of the wipe, 0..1.
    void setWipe(float share);
    [[nodiscard]] float wipe() const;
    void setGivenMaps(GivenMaps maps);
    void setProbes(std::vector<ProbeGlyph> probes);
    void setRoutes(std::vector<RouteGlyph> routes);
    /// Stretches of routes, façades and suggested probes with their figures; null: not shown.
    void setCoverage(std::shared_ptr<const CoverageOverlay> coverage);
    void setSelectedReflector(std::string id);
    void setHeightfieldShown(bool shown);

    // The camera. It stays above the ground.
    void setCamera(const Camera& camera, bool animate);
    [[nodiscard]] Camera camera() const;
    /// Of the picture that is seen, a moment behind camera(); nullopt before the first.
    [[nodiscard]] std::optional<Camera> shownCamera() const;
    void frameAll(bool animate = true);
    /// Shows what is selected; everything when nothing is.
    void frameSelection();
    void frameBox(const Box& box, bool animate = true);
    /// Frames a city object with the edges of its box, and names it; an empty box: none. Ends when
    /// another city is shown, or by Escape.
    void markObject(const Box& box, const QString& name);
    /// Empty when nothing is marked.
    [[nodiscard]] QString markedObject() const;
    /// On foot, eyes at 1.6 m over the ground; does not enter solids.
    void setWalking(bool walking);
    [[nodiscard]] bool walking() const;
    /// Goes along with a reflector; empty = none.
    void follow(std::string reflector);
    [[nodiscard]] const std::string& followed() const;
    /// Flights of the camera become jumps. Follows the desktop's setting of animations unless set.
    void setReducedMotion(bool reduced);

    /// Leaving DrawRoute finishes a route of two points or more.
    void setTool(ViewportTool tool);
    [[nodiscard]] ViewportTool tool() const;
    /// Ends the route that is being drawn, if it has two points or more, and leaves the tool.
    void finishRoute();
    /// Points of the route that is being drawn.
    [[nodiscard]] std::size_t draftedPoints() const;
    void setTime(double seconds);
    [[nodiscard]] double time() const;
    /// Vehicles drive, again and again from the start of their routes.
    void setPlaying(bool playing);
    /// Seconds of the drive that pass in one second, > 0.
    void setSpeed(double factor);
    [[nodiscard]] bool playing() const;

    /// The small texts and signs over the picture.
    void setHudShown(bool shown);
    void setFiguresShown(bool shown);  ///< method, milliseconds, frames a second

    /// The newest finished picture, without the widgets over it; null before the first. Probes and
    /// routes are in it if they were shown.
    [[nodiscard]] QImage grabPicture();

    /// Grows with every change that a picture may show.
    [[nodiscard]] quint64 revision() const;
    /// Number of the newest picture that is finished, on the screen or not yet.
    [[nodiscard]] quint64 picturesFinished() const;

    /// Behaves as if the driver had lost its context: draws on with a new one (for tests).
    void loseContext();
    /// Where things lie in the widget, in its pixels.
    [[nodiscard]] ViewGeometry geometry() const;

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

Q_SIGNALS:
    void frameDrawn(const reflet::FrameStatistics& statistics, double framesPerSecond);
    /// The same picture: its number, and the revision() that it shows.
    void pictureShown(quint64 number, quint64 revision);
    /// At full size, with nothing left to refine.
    void pictureSettled();
    void cameraChanged();
    void timeChanged(double seconds);
    void wipeMoved(float share);
    /// No picture is possible, or none any more. The viewport shows the message in its place.
    void graphicsProblem(const reflet::Error& error);
    void playingChanged(bool playing);
    void walkingChanged(bool walking);
    void followedChanged(const QString& reflector);

protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
