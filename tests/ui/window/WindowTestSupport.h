// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/LiveCity.h"
#include "app/shell/MainWindow.h"
#include "core/project/Project.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/ui/Patience.h"
#include "widgets/plan/PlanView.h"
#include "widgets/viewport/Viewport.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <string>

namespace reflet::test {

/// The real window on a small street, whose road runs along x in its middle.
class WindowTest : public testing::Test {
protected:
    /// Opens a file as if it had been named on the command line, and waits for the city.
    void open(MainWindow& window, const std::filesystem::path& file) {
        StartOptions options;
        options.files << QString::fromStdString(file.string());
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&window, kPatience));
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
            press(window, Qt::Key_L, Qt::ControlModifier);
        ASSERT_TRUE(QTest::qWaitFor([&] { return plan.isVisible(); }, kPatience));
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, kPatience));
        plan.setFocus();
        ASSERT_TRUE(QTest::qWaitFor([&] { return plan.hasFocus(); }, kPatience));
        plan.frameAll();
        QTest::qWait(50);
    }
    /// A shortcut of the window. It counts only while the window is active, and when a dialog has
    /// closed the window manager takes its time to make it so.
    static void press(MainWindow& window, Qt::Key key, Qt::KeyboardModifiers modifiers) {
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, kPatience));
        QTest::keyClick(&window, key, modifiers);
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
    /// Gives the file dialog that is open a path, saves, and waits for what is written: the path,
    /// unless told otherwise.
    static void answerFileDialog(const MainWindow& window, const char* name,
                                 const std::filesystem::path& path,
                                 std::filesystem::path written = {}) {
        QFileDialog* dialog = nullptr;
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<QFileDialog*>(QString::fromLatin1(name));
                return dialog && dialog->isVisible();
            },
            kPatience))
            << name;
        auto* edit = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
        ASSERT_NE(edit, nullptr);
        // Typing would open the list of completions, which takes the Enter.
        edit->setText(QString::fromStdString(path.string()));
        auto* buttons = dialog->findChild<QDialogButtonBox*>();
        ASSERT_NE(buttons, nullptr);
        QTest::mouseClick(buttons->button(QDialogButtonBox::Save), Qt::LeftButton);
        if (written.empty())
            written = path;
        ASSERT_TRUE(
            QTest::qWaitFor([&] { return std::filesystem::exists(written); }, 4 * kPatience))
            << written;
    }
    /// Adds a quarter of the picture's width and height to the sizes of the dialog, and takes it.
    static void chooseSmallSize(const QDialog& dialog, const MainWindow& window) {
        const QSize shown = window.bench().viewport->size();
        auto* sizes = dialog.findChild<QComboBox*>(QStringLiteral("pictureSize"));
        sizes->addItem(QString(), QSize(shown.width() / 4 & ~1, shown.height() / 4 & ~1));
        sizes->setCurrentIndex(sizes->count() - 1);
    }
    [[nodiscard]] static std::string json(MainWindow& window) {
        return projectToJson(window.document().project());
    }

    TemporaryFolder folder;
    StreetCity street{6};
    std::filesystem::path city = folder.write("street.city.json", street.cityJson());
};

}  // namespace reflet::test
