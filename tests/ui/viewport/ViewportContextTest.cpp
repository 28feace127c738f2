// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/Patience.h"
#include "tests/ui/viewport/ViewportWindow.h"

#include <QDockWidget>
#include <QLabel>
#include <QMainWindow>
#include <QOpenGLContext>
#include <QProcess>
#include <QSignalSpy>
#include <QTimer>
#include <fstream>
#include <iostream>

namespace reflet {
namespace {

using test::BoxCity;
using test::eventually;

/// Whether a picture shows more than one colour.
bool showsSomething(const QImage& picture) {
    if (picture.isNull()) {
        return false;
    }
    const QRgb first = picture.pixel(0, 0);
    for (int y = 0; y < picture.height(); y += 16) {
        for (int x = 0; x < picture.width(); x += 16) {
            if (picture.pixel(x, y) != first) {
                return true;
            }
        }
    }
    return false;
}

long residentKilobytes() {
    std::ifstream status("/proc/self/status");
    std::string word;
    long kilobytes = 0;
    while (status >> word) {
        if (word == "VmRSS:") {
            status >> kilobytes;
        }
    }
    return kilobytes;
}

class ViewportContext : public test::ViewportWindow {
protected:
    [[nodiscard]] bool drawsOn() {
        const int before = frames;
        ++m_step;
        view->setExposure(1.0F + 0.01F * float(m_step));
        return eventually([this, before] { return frames > before; });
    }

private:
    int m_step = 0;
};

TEST_F(ViewportContext, ShowsTheCity) {
    EXPECT_TRUE(eventually([this] { return showsSomething(view->grabPicture()); }));
    EXPECT_TRUE(showsSomething(view->grab().toImage())) << "it is in the widget, too";
}

TEST_F(ViewportContext, SettlesAtTheFullSizeWhenNothingMoves) {
    QSignalSpy settled(view.get(), &Viewport::pictureSettled);
    ASSERT_TRUE(eventually([&] { return settled.count() > 0; }));
    EXPECT_EQ(view->grabPicture().size(), view->size() * view->devicePixelRatioF());
    const int count = frames;
    QTest::qWait(300);
    EXPECT_EQ(frames, count) << "pictures are drawn though nothing changes";
}

TEST_F(ViewportContext, DrawsOnAfterBeingHiddenAndShown) {
    view->hide();
    QTest::qWait(50);
    view->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(view.get(), test::kPatience));
    EXPECT_TRUE(drawsOn());
}

TEST_F(ViewportContext, DrawsOnInADockThatFloatsAndComesBack) {
    QMainWindow window;
    auto* dock = new QDockWidget(&window);
    window.resize(900, 700);
    window.addDockWidget(Qt::LeftDockWidgetArea, dock);
    Viewport* shown = view.release();
    view.reset();
    dock->setWidget(shown);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window, test::kPatience));
    const auto draws = [&] {
        const int before = frames;
        shown->setExposure(1.0F + 0.001F * float(before + 1));
        return eventually([&] { return frames > before; });
    };
    EXPECT_TRUE(draws());
    dock->setFloating(true);
    QTest::qWait(100);
    EXPECT_TRUE(draws());
    dock->setFloating(false);
    QTest::qWait(100);
    EXPECT_TRUE(draws());
    EXPECT_TRUE(showsSomething(shown->grabPicture()));
}

TEST_F(ViewportContext, FollowsTheSizeOfTheWindow) {
    QWidget frame;
    frame.resize(900, 600);
    frame.show();
    view->setParent(&frame);
    for (const QSize size : {QSize(300, 200), QSize(1, 1), QSize(800, 500), QSize(240, 480)}) {
        view->setGeometry(QRect({0, 0}, size));
        view->show();
        EXPECT_TRUE(eventually([&] { return view->grabPicture().size() == size; }));
    }
    view->setParent(nullptr);
}

TEST_F(ViewportContext, DrawsOnWithANewContextWhenTheDriverLostTheOld) {
    QSignalSpy problems(view.get(), &Viewport::graphicsProblem);
    view->loseContext();
    QTest::qWait(50);
    EXPECT_TRUE(drawsOn());
    EXPECT_TRUE(eventually([this] { return showsSomething(view->grabPicture()); }));
    EXPECT_EQ(problems.count(), 0);
}

TEST_F(ViewportContext, GivesUpWithAMessageWhenTheContextIsLostAgainAndAgain) {
    QSignalSpy problems(view.get(), &Viewport::graphicsProblem);
    for (int k = 0; k < 20 && problems.count() == 0; ++k) {
        view->loseContext();
        (void)eventually([&] { return problems.count() > 0; }, 2000);
    }
    ASSERT_EQ(problems.count(), 1);
    EXPECT_TRUE(view->findChild<QLabel*>(QStringLiteral("graphicsProblem"))->isVisible());
}

TEST_F(ViewportContext, IsMadeAndThrownAwayAHundredTimesWithoutALoss) {
    const auto once = [] {
        Viewport viewport;
        viewport.resize(320, 200);
        viewport.setCity(BoxCity::make());
        int drawn = 0;
        QObject::connect(&viewport, &Viewport::frameDrawn, &viewport,
                         [&](const FrameStatistics&, double) { ++drawn; });
        viewport.show();
        return eventually([&] { return drawn > 0; });
    };
    const auto hasty = [](int milliseconds) {
        Viewport viewport;  // gone before its first picture, or before it is seen at all
        viewport.setCity(BoxCity::make());
        if (milliseconds % 2 == 0) {
            viewport.show();
            QTest::qWait(milliseconds);
        }
    };
    for (int k = 0; k < 4; ++k) {
        ASSERT_TRUE(once());
        hasty(k);
    }
    const long before = residentKilobytes();
    for (int k = 0; k < 92; ++k) {
        if (k % 6 == 0) {
            ASSERT_TRUE(once());
        } else {
            hasty(k % 9);
        }
    }
    const long growth = residentKilobytes() - before;
    std::cout << "memory grew by " << growth << " kB in 92 rounds\n";
    // A coarse bound, well above the 3.5 MB a round that were measured with software OpenGL: it
    // catches a viewport whose pictures or city are not given back.
    EXPECT_LT(growth, 900'000) << "about ten megabytes are lost each time";
}

TEST_F(ViewportContext, ReportsTheLongestPauseOfTheInterface) {
    // Nothing is asserted on time: the figure is for people (and for the reports of a release).
    view->setMethods(Method::Sky, Method::Mem);
    QElapsedTimer since;
    qint64 longest = 0;
    QTimer beat;
    beat.setTimerType(Qt::PreciseTimer);
    QObject::connect(&beat, &QTimer::timeout, &beat,
                     [&] { longest = std::max(longest, since.restart()); });
    since.start();
    beat.start(5);
    for (int k = 0; k < 60; ++k) {
        view->setCamera({{20.0 * std::cos(0.1 * k), -40, 30}, {0, 0, 0}, 0.9}, false);
        QTest::qWait(33);
    }
    QTest::qWait(1500);
    std::cout << "longest pause of the interface: " << longest << " ms, " << frames
              << " pictures\n";
    EXPECT_GT(frames, 5);
}

class ViewportThreaded : public test::ViewportWindow {
protected:
    ViewportThreaded() : ViewportWindow(Viewport::Drawing::Threaded) {}
};

TEST_F(ViewportThreaded, DrawsTheSameInAContextThatSharesWithTheWindow) {
    EXPECT_TRUE(eventually([this] { return showsSomething(view->grabPicture()); }));
    QSignalSpy settled(view.get(), &Viewport::pictureSettled);
    EXPECT_TRUE(eventually([&] { return settled.count() > 0; }));
    const int before = frames;
    view->loseContext();
    EXPECT_TRUE(eventually([&] { return frames > before; }));
}

class ViewportInPlace : public test::ViewportWindow {
protected:
    ViewportInPlace() : ViewportWindow(Viewport::Drawing::InPlace) {}
};

TEST_F(ViewportInPlace, DrawsTheSameWithoutAThread) {
    EXPECT_TRUE(eventually([this] { return showsSomething(view->grabPicture()); }));
    const int before = frames;
    dragFromTo({500, 400}, {620, 430});
    EXPECT_TRUE(eventually([&] { return frames > before; }));
    QSignalSpy settled(view.get(), &Viewport::pictureSettled);
    EXPECT_TRUE(eventually([&] { return settled.count() > 0; }));
}

/// Runs in a process of its own, with a driver that offers OpenGL 3.3 only.
TEST(ViewportOfAnOldDriver, DISABLED_ShowsWhatIsMissing) {
    Viewport viewport;
    std::optional<Error> problem;
    QObject::connect(&viewport, &Viewport::graphicsProblem, &viewport,
                     [&](const Error& error) { problem = error; });
    viewport.resize(800, 500);
    viewport.show();
    ASSERT_TRUE(eventually([&] { return problem.has_value(); }));
    EXPECT_EQ(problem->code, ErrorCode::ResourceLimit);
    const auto* label = viewport.findChild<QLabel*>(QStringLiteral("graphicsProblem"));
    ASSERT_NE(label, nullptr);
    EXPECT_TRUE(label->isVisible());
    EXPECT_TRUE(label->text().contains("3.3")) << label->text().toStdString();
    EXPECT_TRUE(label->text().contains("4.5"));
    EXPECT_TRUE(label->text().contains("LIBGL_ALWAYS_SOFTWARE=1"));
    viewport.setCity(BoxCity::make());
    viewport.frameAll();
    viewport.setWalking(true);
    QTest::qWait(50);
}

TEST(ViewportOfAnOldDriver, SaysWhatWasFoundWhatIsNeededAndHowSoftwareHelps) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("MESA_GL_VERSION_OVERRIDE", "3.3");
    environment.insert("MESA_GLSL_VERSION_OVERRIDE", "330");
    process.setProcessEnvironment(environment);
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(QCoreApplication::applicationFilePath(),
                  {"--gtest_also_run_disabled_tests",
                   "--gtest_filter=ViewportOfAnOldDriver.DISABLED_ShowsWhatIsMissing"});
    ASSERT_TRUE(process.waitForFinished(60'000));
    const std::string output = process.readAll().toStdString();
    EXPECT_EQ(process.exitCode(), 0) << output;
    EXPECT_NE(output.find("[  PASSED  ] 1 test"), std::string::npos) << output;
}

}  // namespace
}  // namespace reflet
