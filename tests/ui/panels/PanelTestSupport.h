// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"
#include "core/project/Project.h"
#include "tests/ui/Patience.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QTest>
#include <QWidget>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace reflet::test {

/// Shows a widget of this size and waits until it is on the screen and active.
inline void showWidget(QWidget& widget, int width, int height) {
    widget.resize(width, height);
    widget.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&widget, kPatience));
    widget.activateWindow();
    widget.setFocus();
    QTest::qWait(20);
}

/// Moves the mouse at once; QTest's own moves the X server's pointer and hears of it later.
inline void moveMouse(QWidget& widget, const QPoint& to, Qt::MouseButtons held = Qt::LeftButton) {
    QMouseEvent event(QEvent::MouseMove, to, widget.mapToGlobal(to), Qt::NoButton, held, {});
    QApplication::sendEvent(&widget, &event);
}

template <class T>
T* child(const QWidget& parent, const char* name) {
    auto* found = parent.findChild<T*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
}

/// A street between two rows of houses on ground that rises to the east, 240 m × 160 m.
inline std::shared_ptr<const Heightfield> streetHeightfield() {
    auto field = std::make_shared<Heightfield>();
    field->grid = {-120.0, -80.0, 1.0, 240, 160};
    for (int j = 0; j < field->grid.rows; ++j) {
        for (int i = 0; i < field->grid.columns; ++i) {
            const double x = field->grid.xMin(i) + 0.5;
            const double y = field->grid.yMin(j) + 0.5;
            const auto ground = float(10.0 + 0.02 * x);
            const bool street = std::abs(y) < 8.0 || std::abs(x) < 6.0;
            const bool yard = std::fmod(std::abs(x), 30.0) < 6.0 || std::abs(y) > 60.0;
            const float roof = street || yard ? 0.0F : 9.0F + 3.0F * float(int(std::abs(x) / 30.0));
            field->ground.push_back(ground);
            field->topCenter.push_back(ground + roof);
            field->topMax.push_back(ground + roof);
        }
    }
    return field;
}

/// A project with `probes` probes, two routes, two vehicles, a brought one and a view.
inline Project streetProject(int probes) {
    Project project;
    project.name = "Street";
    project.frame.crs = "EPSG:28992";
    project.frame.origin = {85'000.0, 446'000.0, 0.0};
    project.models.push_back({{}, "models/street.city.json", ""});
    for (int i = 0; i < probes; ++i) {
        Probe probe;
        probe.id = "rem-" + std::to_string(i + 1);
        probe.position = project.frame.origin + glm::dvec3(-100.0 + 20.0 * (i % 11), 0.0, 12.0);
        project.probes.push_back(probe);
    }
    project.routes.push_back({"route-1",
                              "Main street",
                              {project.frame.origin + glm::dvec3(-100.0, 0.0, 8.0),
                               project.frame.origin + glm::dvec3(100.0, 0.0, 12.0)},
                              20.0});
    project.routes.push_back({"route-2",
                              "",
                              {project.frame.origin + glm::dvec3(0.0, -60.0, 10.0),
                               project.frame.origin + glm::dvec3(0.0, 60.0, 10.0)},
                              0.0});
    project.reflectors.push_back({"tram-1", "tram", "route-1", 8.0, 0.0});
    project.reflectors.push_back({"bus-1", "bus", "route-2", 10.0, 5.0});
    VehicleModel vehicle;
    vehicle.id = "delivery van";
    vehicle.path = "vehicles/van.glb";
    project.vehicles.push_back(vehicle);
    project.views.push_back(
        {"pavement", "From the pavement", project.frame.origin, project.frame.origin, 0.9, 3.0});
    return project;
}

/// The texts of a widget's children that do not fit: too narrow, or too low for their lines.
inline std::vector<std::string> clippedTexts(const QWidget& widget) {
    std::vector<std::string> clipped;
    const auto note = [&](const QWidget* each, const QString& text) {
        clipped.push_back(text.toStdString() + " (" + std::to_string(each->width()) + " × " +
                          std::to_string(each->height()) + ")");
    };
    for (const QLabel* label : widget.findChildren<QLabel*>()) {
        if (!label->isVisible() || label->text().isEmpty())
            continue;
        const bool narrow = label->width() < label->minimumSizeHint().width();
        const bool low =
            label->wordWrap() && label->heightForWidth(label->width()) > label->height();
        if (narrow || low)
            note(label, label->text());
    }
    for (const QAbstractButton* button : widget.findChildren<QAbstractButton*>())
        if (button->isVisible() && button->width() < button->minimumSizeHint().width())
            note(button, button->text());
    return clipped;
}

/// A font `factor` times as large as the usual one for as long as this lives.
class LargerFont {
public:
    explicit LargerFont(double factor) : m_before(QApplication::font()) {
        QFont font = m_before;
        font.setPointSizeF(m_before.pointSizeF() * factor);
        QApplication::setFont(font);
    }
    ~LargerFont() { QApplication::setFont(m_before); }
    LargerFont(const LargerFont&) = delete;
    LargerFont& operator=(const LargerFont&) = delete;

private:
    QFont m_before;
};

}  // namespace reflet::test
