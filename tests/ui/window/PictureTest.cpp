// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures and films as a planner saves them: what is in the file is what the window showed.
#include "app/pipeline/Import.h"
#include "app/shell/Commands.h"
#include "core/project/ProjectFile.h"
#include "tests/ui/window/PictureFiles.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/panels/JobList.h"
#include "widgets/viewport/Viewport.h"

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QSpinBox>
#include <QToolButton>

namespace reflet::test {
namespace {

constexpr double kAlike = 6.0;  // of 255, mean over a picture: edges are smoothed differently

class PictureTest : public WindowTest {
protected:
    void SetUp() override {
        ImportRequest request;
        request.files = {city};
        request.routes = folder.write("route.geojson", street.routeGeoJson());
        request.vehicle = "car";
        request.output = file;
        ASSERT_TRUE(importProject(request, {}).has_value());
        Project project = *loadProject(file);
        View view;
        view.name = "kerb";
        view.position = project.frame.origin + glm::dvec3(12.0, -4.0, 1.7);
        view.target = project.frame.origin + glm::dvec3(22.0, 0.0, 1.5);
        view.verticalFov = 0.9;
        view.time = 1.0;
        project.views = {view};
        ASSERT_TRUE(saveProject(project, file).has_value());
    }
    /// The window at the kerb, the car held in the picture, small enough to be drawn quickly.
    void openAtTheKerb(MainWindow& window) {
        window.resize(760, 520);
        open(window, file);
        if (HasFatalFailure())
            return;
        Viewport& viewport = *window.bench().viewport;
        viewport.setPlaying(false);
        ASSERT_TRUE(QTest::qWaitFor([&] { return window.bench().live->traffic()->size() == 1; },
                                    kPatience));
        window.bench().commands->action(Command::PlanBeside)->trigger();
        QTest::qWait(50);
        viewport.setTime(1.0);
    }
    QDialog* ask(MainWindow& window, const char* name, Qt::KeyboardModifiers keys) {
        window.bench().viewport->setFocus();
        QTest::keyClick(window.bench().viewport, Qt::Key_P, keys);
        QDialog* dialog = nullptr;
        EXPECT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<QDialog*>(QString::fromLatin1(name));
                return dialog && dialog->isVisible();
            },
            kPatience))
            << name;
        return dialog;
    }
    QDialog* askForPicture(MainWindow& window) {
        return ask(window, "pictureDialog", Qt::ControlModifier);
    }
    /// As on the screen, that many seconds.
    QDialog* askForFilm(MainWindow& window, int seconds) {
        QDialog* dialog = ask(window, "filmDialog", Qt::ControlModifier | Qt::ShiftModifier);
        if (dialog) {
            chooseSmallSize(*dialog, window);
            dialog->findChild<QSpinBox*>(QStringLiteral("filmSeconds"))->setValue(seconds);
        }
        return dialog;
    }
    QImage savedPicture(MainWindow& window, const std::filesystem::path& to, bool small) {
        QDialog* dialog = askForPicture(window);
        if (!dialog)
            return {};
        if (small)
            chooseSmallSize(*dialog, window);
        else
            dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(0);
        QTest::keyClick(dialog, Qt::Key_Return);
        answerFileDialog(window, "pictureFileDialog", to);
        return loaded(to);
    }

    std::filesystem::path file = folder / "street.reflet";
};

TEST_F(PictureTest, APictureShowsWhatTheWindowShows) {
    MainWindow window;
    openAtTheKerb(window);
    if (HasFatalFailure())
        return;
    Viewport& viewport = *window.bench().viewport;
    viewport.setRoutes({});  // a picture has no marks in it
    const QImage saved = savedPicture(window, folder / "kerb.png", false);
    ASSERT_EQ(saved.size(), QSize(viewport.width() & ~1, viewport.height() & ~1));
    QImage shown;
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
            shown = viewport.grabPicture();
            return !shown.isNull() && difference(shown, saved) < kAlike;
        },
        kPatience))
        << difference(shown, saved);
    viewport.setCamera({{12.0, 4.0, 1.7}, {2.0, 0.0, 1.5}, 0.9}, false);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return difference(viewport.grabPicture(), saved) > 2.0 * kAlike; }, kPatience))
        << "another view is another picture";
}

TEST_F(PictureTest, AFilmIsH264AndShowsTheWindowsViewWithTheCarDriving) {
    if (!hasProgram("ffmpeg") || !hasProgram("ffprobe"))
        GTEST_SKIP() << "ffmpeg is not installed.";
    MainWindow window;
    openAtTheKerb(window);
    if (HasFatalFailure())
        return;
    const QImage picture = savedPicture(window, folder / "kerb.png", true);
    QDialog* dialog = askForFilm(window, 1);
    ASSERT_NE(dialog, nullptr);
    QTest::keyClick(dialog, Qt::Key_Return);
    const auto film = folder / "kerb.mp4";
    answerFileDialog(window, "pictureFileDialog", film);
    const QSize size = picture.size();
    EXPECT_EQ(probed(film),
              QStringLiteral("h264,%1,%2,yuv420p,30").arg(size.width()).arg(size.height()));
    const QImage first = frameOf(film, 0, folder / "first.png");
    const QImage last = frameOf(film, 29, folder / "last.png");
    EXPECT_LT(difference(first, picture), 2.0 * kAlike);
    EXPECT_GT(difference(first, last), 0.5) << "the car has driven on";
}

TEST_F(PictureTest, AFilmThatIsStoppedLeavesNothingBehind) {
    MainWindow window;
    openAtTheKerb(window);
    if (HasFatalFailure())
        return;
    std::filesystem::create_directory(folder / "films");
    QDialog* dialog = askForFilm(window, 600);
    ASSERT_NE(dialog, nullptr);
    QTest::keyClick(dialog, Qt::Key_Return);
    QFileDialog* where = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            where = window.findChild<QFileDialog*>(QStringLiteral("pictureFileDialog"));
            return where && where->isVisible();
        },
        kPatience));
    where->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
        ->setText(QString::fromStdString((folder / "films/long.mp4").string()));
    QTest::mouseClick(where->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save),
                      Qt::LeftButton);
    const auto filming = [&]() -> std::optional<JobStatus> {
        for (const JobStatus& job : window.jobs().jobs()) {
            if (job.title == QStringLiteral("Filming"))
                return job;
        }
        return std::nullopt;
    };
    ASSERT_TRUE(QTest::qWaitFor([&] { return filming() && filming()->fraction > 0.0; }, kPatience))
        << "its progress is told";
    window.findChild<QAction*>(QStringLiteral("jobsToggle"))->trigger();
    QToolButton* cancel = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            for (auto* button :
                 window.bench().jobList->findChildren<QToolButton*>(QStringLiteral("cancelJob"))) {
                if (button->isVisible() && button->toolTip().contains(QStringLiteral("Filming")))
                    cancel = button;
            }
            return cancel != nullptr;
        },
        kPatience));
    QTest::mouseClick(cancel, Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !filming(); }, kPatience));
    EXPECT_TRUE(std::filesystem::is_empty(folder / "films"));
}

TEST_F(PictureTest, WithoutFfmpegTheDialogSaysSoAndNumberedPicturesAreWritten) {
    const QByteArray before = qgetenv("PATH");
    qputenv("PATH", QByteArray::fromStdString(folder.path().string()));
    MainWindow window;
    openAtTheKerb(window);
    if (HasFatalFailure())
        return;
    QDialog* dialog = askForFilm(window, 1);
    ASSERT_NE(dialog, nullptr);
    const auto* remark = dialog->findChild<QLabel*>(QStringLiteral("pictureRemark"));
    EXPECT_TRUE(remark->isVisible());
    EXPECT_TRUE(remark->text().contains(QStringLiteral("ffmpeg")));
    QTest::keyClick(dialog, Qt::Key_Return);
    answerFileDialog(window, "pictureFileDialog", folder / "drive.mp4", folder / "drive");
    qputenv("PATH", before);
    EXPECT_FALSE(std::filesystem::exists(folder / "drive.mp4"));
    EXPECT_FALSE(loaded(folder / "drive/frame-00001.png").isNull());
    EXPECT_FALSE(loaded(folder / "drive/frame-00030.png").isNull());
    EXPECT_FALSE(std::filesystem::exists(folder / "drive/frame-00031.png"));
}

}  // namespace
}  // namespace reflet::test
