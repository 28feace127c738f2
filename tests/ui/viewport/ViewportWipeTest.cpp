// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/viewport/ViewportWindow.h"

#include <QLabel>
#include <QSignalSpy>

namespace reflet {
namespace {

class ViewportWipe : public test::ViewportWindow {
protected:
    void SetUp() override {
        ViewportWindow::SetUp();
        view->setMethods(Method::Sky, Method::Mem);
        bar = view->findChild<QWidget*>(QStringLiteral("wipe"));
        ASSERT_NE(bar, nullptr);
    }
    [[nodiscard]] QString plate(const char* name) const {
        const auto* label = view->findChild<QLabel*>(QString::fromLatin1(name));
        return label != nullptr && label->isVisible() ? label->text() : QString();
    }
    QWidget* bar = nullptr;
};

TEST_F(ViewportWipe, NamesTheTwoMethodsInAPlannersWords) {
    EXPECT_TRUE(bar->isVisible());
    EXPECT_EQ(plate("wipeLeft").toLower(), "sky only");
    EXPECT_EQ(plate("wipeRight"), "Reflet");
}

TEST_F(ViewportWipe, IsDraggedByItsHandle) {
    QSignalSpy moved(view.get(), &Viewport::wipeMoved);
    const QPoint handle(bar->width() / 2, bar->height() / 2);
    QTest::mousePress(bar, Qt::LeftButton, {}, handle);
    QMouseEvent event(QEvent::MouseMove, handle + QPoint(-250, 0),
                      bar->mapToGlobal(handle + QPoint(-250, 0)), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(bar, &event);
    QTest::mouseRelease(bar, Qt::LeftButton, {}, handle);
    ASSERT_GE(moved.count(), 1);
    const double wanted = 0.5 - 250.0 / view->width();
    EXPECT_NEAR(double(view->wipe()), wanted, 2.0 / view->width());
    EXPECT_NEAR(bar->geometry().center().x(), wanted * view->width(), 2.0);
    EXPECT_EQ(view->camera().position, kStart.position) << "the camera was dragged with it";
}

TEST_F(ViewportWipe, IsMovedByTheArrowKeysWhenItHasTheFocus) {
    bar->setFocus();
    QTest::keyClick(bar, Qt::Key_Right);
    EXPECT_GT(view->wipe(), 0.5F);
    QTest::keyClick(bar, Qt::Key_Home);
    EXPECT_EQ(view->wipe(), 0.0F);
    QTest::keyClick(bar, Qt::Key_End);
    EXPECT_EQ(view->wipe(), 1.0F);
    EXPECT_FALSE(bar->accessibleName().isEmpty());
}

TEST_F(ViewportWipe, StaysInPlaceWhenTheViewIsResized) {
    QWidget frame;
    frame.resize(900, 600);
    frame.show();
    view->setParent(&frame);
    view->setGeometry(0, 0, 800, 500);
    view->show();
    EXPECT_NEAR(bar->geometry().center().x(), 400, 2);
    view->setGeometry(0, 0, 400, 300);
    EXPECT_NEAR(bar->geometry().center().x(), 200, 2);
    EXPECT_EQ(bar->height(), 300);
    view->setParent(nullptr);
}

TEST_F(ViewportWipe, VanishesWithTheSecondMethod) {
    view->setMethods(Method::Mem, std::nullopt);
    EXPECT_FALSE(bar->isVisible());
    EXPECT_EQ(plate("wipeLeft"), QString());
}

TEST_F(ViewportWipe, TakesSenselessSharesForSoundOnes) {
    view->setWipe(7.0F);
    EXPECT_EQ(view->wipe(), 1.0F);
    view->setWipe(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(view->wipe(), 0.5F);
}

}  // namespace
}  // namespace reflet
