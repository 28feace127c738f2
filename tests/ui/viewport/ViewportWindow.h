// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/BoxCity.h"
#include "tests/ui/Patience.h"
#include "widgets/viewport/Viewport.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTest>
#include <QWheelEvent>
#include <QWindow>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace reflet::test {

/// Waits, with the event loop running, until a condition holds; false after ten seconds.
template <class Condition>
[[nodiscard]] bool eventually(const Condition& condition, int milliseconds = 10'000) {
    return QTest::qWaitFor(condition, milliseconds);
}

/// A viewport with the box city in a window of its own, seen from the south, shown and active.
class ViewportWindow : public testing::Test {
protected:
    explicit ViewportWindow(Viewport::Drawing drawing = Viewport::Drawing::Automatic)
        : view(std::make_unique<Viewport>(nullptr, nullptr, drawing)) {
        view->setReducedMotion(true);
        view->setCity(BoxCity::make());
        view->setCamera(kStart, false);
        QObject::connect(view.get(), &Viewport::frameDrawn, view.get(),
                         [this](const FrameStatistics&, double) { ++frames; });
    }
    void SetUp() override {
        view->resize(1000, 700);
        view->show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(view.get(), kPatience));
        ASSERT_TRUE(eventually([this] { return frames > 0; })) << "no picture was drawn";
        view->setFocus();
    }

    [[nodiscard]] static QPoint toPoint(const glm::dvec2& pixel) {
        return {int(std::lround(pixel.x)), int(std::lround(pixel.y))};
    }
    [[nodiscard]] QPoint pixelOf(const glm::dvec3& point) const {
        return toPoint(view->geometry().project(point).pixel);
    }
    [[nodiscard]] glm::dvec3 onPlane(const QPoint& pixel, double z) const {
        const Ray ray = view->geometry().ray({pixel.x(), pixel.y()});
        return ray.at((z - ray.origin.z) / ray.direction.z);
    }
    void press(const QPoint& at, Qt::MouseButton button = Qt::LeftButton,
               Qt::KeyboardModifiers modifiers = {}) {
        QTest::mousePress(view->windowHandle(), button, modifiers, at);
    }
    void release(const QPoint& at, Qt::MouseButton button = Qt::LeftButton,
                 Qt::KeyboardModifiers modifiers = {}) {
        QTest::mouseRelease(view->windowHandle(), button, modifiers, at);
    }
    /// QTest's own mouseMove() forgets which buttons and keys are held.
    void move(const QPoint& at, Qt::MouseButtons buttons = Qt::NoButton,
              Qt::KeyboardModifiers modifiers = {}) {
        QMouseEvent event(QEvent::MouseMove, at, view->mapToGlobal(at), Qt::NoButton, buttons,
                          modifiers);
        QApplication::sendEvent(view.get(), &event);
    }
    void dragFromTo(const QPoint& from, const QPoint& to, Qt::MouseButton button = Qt::LeftButton,
                    Qt::KeyboardModifiers modifiers = {}) {
        press(from, button, modifiers);
        move(from + (to - from) / 2, button, modifiers);
        move(to, button, modifiers);
        release(to, button, modifiers);
    }
    void click(const QPoint& at, Qt::MouseButton button = Qt::LeftButton) {
        // Far enough apart in time that two clicks are no double click.
        QTest::qWait(QApplication::doubleClickInterval() + 20);
        QTest::mouseClick(view->windowHandle(), button, {}, at);
    }
    void wheel(const QPoint& at, int notches) {
        QWheelEvent event(at, view->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, {},
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(view.get(), &event);
    }

    static inline const Camera kStart{{0, -40, 30}, {0, 0, 0}, 0.9};
    std::unique_ptr<Viewport> view;
    int frames = 0;
};

}  // namespace reflet::test
