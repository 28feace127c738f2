// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/LiveCity.h"
#include "app/shell/MainWindow.h"
#include "core/project/Project.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"
#include "widgets/plan/PlanView.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <string>

namespace reflet::test {

inline constexpr int kPatience = 60'000;  ///< milliseconds that work in the background may take

/// The real window on a small street, whose road runs along x in its middle.
class WindowTest : public testing::Test {
protected:
    /// Opens a file as if it had been named on the command line, and waits for the city.
    void open(MainWindow& window, const std::filesystem::path& file) {
        StartOptions options;
        options.files << QString::fromStdString(file.string());
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
        window.activateWindow();
        window.start(options);
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                return !window.document().project().models.empty() && window.bench().live->city() &&
                       !window.bench().live->loading();
            },
            kPatience));
        PlanView& plan = *window.bench().plan;
        if (!plan.isVisible())
            QTest::keyClick(&window, Qt::Key_L, Qt::ControlModifier);
        ASSERT_TRUE(QTest::qWaitFor([&] { return plan.isVisible(); }));
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
        plan.setFocus();
        ASSERT_TRUE(QTest::qWaitFor([&] { return plan.hasFocus(); }));
        plan.frameAll();
        QTest::qWait(50);
    }
    static void moveMouse(QWidget& widget, const QPoint& to) {
        QMouseEvent event(QEvent::MouseMove, to, widget.mapToGlobal(to), Qt::NoButton,
                          Qt::LeftButton, {});
        QApplication::sendEvent(&widget, &event);
    }
    /// A point of the plan; the street's corner is the project's origin plus this.
    static QPoint inPlan(const MainWindow& window, const glm::dvec3& position) {
        return window.bench().plan->toWidget(position).toPoint();
    }
    static void click(QWidget& widget, const QPoint& point) {
        QTest::mouseClick(&widget, Qt::LeftButton, {}, point);
    }
    /// Gives the file dialog that is open a path, and saves.
    static void answerFileDialog(const MainWindow& window, const char* name,
                                 const std::filesystem::path& path) {
        QFileDialog* dialog = nullptr;
        ASSERT_TRUE(QTest::qWaitFor([&] {
            dialog = window.findChild<QFileDialog*>(QString::fromLatin1(name));
            return dialog && dialog->isVisible();
        })) << name;
        auto* edit = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
        ASSERT_NE(edit, nullptr);
        // Typing would open the list of completions, which takes the Enter.
        edit->setText(QString::fromStdString(path.string()));
        auto* buttons = dialog->findChild<QDialogButtonBox*>();
        ASSERT_NE(buttons, nullptr);
        QTest::mouseClick(buttons->button(QDialogButtonBox::Save), Qt::LeftButton);
        ASSERT_TRUE(QTest::qWaitFor([&] { return std::filesystem::exists(path); }, kPatience))
            << path;
    }
    [[nodiscard]] static std::string json(MainWindow& window) {
        return projectToJson(window.document().project());
    }

    TemporaryFolder folder;
    StreetCity street{6};
    std::filesystem::path city = folder.write("street.city.json", street.cityJson());
};

}  // namespace reflet::test
