// SPDX-License-Identifier: GPL-3.0-or-later
// A planner's first quarter of an hour with a real city.
#include "app/shell/Commands.h"
#include "core/heightfield/Heightfield.h"
#include "tests/support/TestData.h"
#include "tests/ui/window/PictureFiles.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/common/DragSlider.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <QComboBox>
#include <QDialog>
#include <QSpinBox>
#include <QUndoStack>
#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

constexpr double kLength = 60.0;  // metres of the route

/// A straight line along x over open ground, with houses within 15 m: a street, as the heightfield
/// tells. Frame coordinates.
std::optional<std::pair<glm::dvec3, glm::dvec3>> findStreet(const Heightfield& field) {
    const GridSpec& grid = field.grid;
    const auto rise = [&](int i, int j) {
        const std::size_t cell = grid.index(i, j);
        return field.topMax[cell] - field.ground[cell];
    };
    const int length = int(kLength / grid.cellSize);
    const int side = int(15.0 / grid.cellSize);
    const int clear = std::max(1, int(3.0 / grid.cellSize));
    for (int j = side; j + side < grid.rows; j += clear) {
        for (int i = 0; i + length < grid.columns; i += std::max(1, length / 4)) {
            bool open = true;
            int houses = 0;
            for (int k = 0; k <= length && open; ++k) {
                for (int w = -clear; w <= clear && open; ++w)
                    open = rise(i + k, j + w) < 0.3;
                houses += rise(i + k, j + side) > 3.0 ? 1 : 0;
                houses += rise(i + k, j - side) > 3.0 ? 1 : 0;
            }
            if (open && houses > length / 2) {
                const double y = grid.y0 + (j + 0.5) * grid.cellSize;
                const double x = grid.x0 + (i + 0.5) * grid.cellSize;
                return std::pair{glm::dvec3(x, y, 0.0), glm::dvec3(x + kLength, y, 0.0)};
            }
        }
    }
    return std::nullopt;
}

class RealCityTest : public WindowTest {
protected:
    void drawRoute(MainWindow& window) {
        const auto line = findStreet(*window.bench().live->city()->heightfield);
        ASSERT_TRUE(line.has_value());
        PlanView& plan = *window.bench().plan;
        ASSERT_EQ(plan.tool(), ViewportTool::DrawRoute);
        Box around;
        around.add(line->first - glm::dvec3(20.0, 20.0, 0.0));
        around.add(line->second + glm::dvec3(20.0, 20.0, 0.0));
        plan.frameBox(around);
        click(plan, inPlan(window, line->first));
        click(plan, inPlan(window, line->second));
        ASSERT_EQ(window.document().project().routes.size(), 0U) << "M finishes the route";
    }
    void makeItReflect(MainWindow& window) {
        const Project& project = window.document().project();
        QTest::keyClick(window.bench().plan, Qt::Key_M);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !project.reflectors.empty(); }, kPatience));
        ASSERT_GE(project.probes.size(), 2U);
        const auto fresh = [&](const Probe& probe) {
            return window.bench().live->probeState(probe.id) == ProbeState::Fresh;
        };
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                return std::all_of(project.probes.begin(), project.probes.end(), fresh) &&
                       window.bench().live->traffic()->size() == 1;
            },
            4 * kPatience));
    }
    void moveAProbeAndUndo(MainWindow& window) {
        const std::string before = json(window);
        PlanView& plan = *window.bench().plan;
        const glm::dvec3 place = window.document().project().probes.front().position -
                                 window.document().project().frame.origin;
        const QPoint from = inPlan(window, place);
        QTest::mousePress(&plan, Qt::LeftButton, {}, from);
        for (int step = 1; step <= 6; ++step)
            moveMouse(plan, from + QPoint(0, 6 * step));
        QTest::mouseRelease(&plan, Qt::LeftButton, {}, from + QPoint(0, 36));
        EXPECT_NE(json(window), before);
        QTest::keyClick(&plan, Qt::Key_Z, Qt::ControlModifier);
        EXPECT_EQ(json(window), before);
    }
    void detailToBothEnds(MainWindow& window) {
        auto* slider =
            window.bench().tuning->findChild<DragSlider*>(QStringLiteral("detailSlider"));
        ASSERT_NE(slider, nullptr);
        slider->setFocus();
        QTest::keyClick(slider, Qt::Key_Home);
        EXPECT_TRUE(std::isinf(window.document().project().tuning.depthRatio));
        QTest::keyClick(slider, Qt::Key_End);
        EXPECT_EQ(window.document().project().tuning.depthRatio, 0.0);
    }
    void save(MainWindow& window, const std::filesystem::path& file) {
        window.bench().plan->setFocus();
        QTest::keyClick(window.bench().plan, Qt::Key_S, Qt::ControlModifier);
        answerFileDialog(window, "saveDialog", file);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !window.isWindowModified(); }, kPatience));
    }
    /// The pavement's view with the tram in it, held.
    void holdTheView(MainWindow& window) {
        const Project& project = window.document().project();
        ASSERT_FALSE(project.views.empty());
        Viewport& viewport = *window.bench().viewport;
        viewport.setPlaying(false);
        viewport.setTime(project.views.front().time);
        viewport.setCamera({project.views.front().position - project.frame.origin,
                            project.views.front().target - project.frame.origin,
                            project.views.front().verticalFov},
                           false);
    }
    void take(MainWindow& window, Command command, const char* dialogName,
              const std::filesystem::path& to) {
        window.bench().commands->action(command)->trigger();
        QDialog* dialog = nullptr;
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<QDialog*>(QString::fromLatin1(dialogName));
                return dialog && dialog->isVisible();
            },
            kPatience));
        chooseSmallSize(*dialog, window);
        if (auto* seconds = dialog->findChild<QSpinBox*>(QStringLiteral("filmSeconds")))
            seconds->setValue(1);
        QTest::keyClick(dialog, Qt::Key_Return);
        answerFileDialog(window, "pictureFileDialog", to);
    }
};

TEST_F(RealCityTest, FromTheFileToAPictureAndAFilmOfATramThatReflectsIt) {
    const auto real = sharedData("cityjson/zurich.city.json");
    if (!real)
        GTEST_SKIP() << kNoSharedData;
    const auto file = folder / "real.reflet";
    std::string saved;
    {
        MainWindow window;
        open(window, *real);
        if (HasFatalFailure())
            return;
        drawRoute(window);
        if (HasFatalFailure())
            return;
        makeItReflect(window);
        if (HasFatalFailure())
            return;
        moveAProbeAndUndo(window);
        detailToBothEnds(window);
        save(window, file);
        saved = json(window);
    }
    MainWindow window;
    window.resize(760, 520);
    open(window, file);
    if (HasFatalFailure())
        return;
    EXPECT_EQ(json(window), saved);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.bench().live->traffic()->size() == 1; }, kPatience));
    window.bench().commands->action(Command::PlanBeside)->trigger();
    QTest::qWait(50);
    holdTheView(window);
    take(window, Command::SavePicture, "pictureDialog", folder / "reflet.png");
    const QImage reflecting = loaded(folder / "reflet.png");
    ASSERT_FALSE(reflecting.isNull());

    QTest::keyClick(window.bench().viewport, Qt::Key_X);  // sky only | Reflet
    take(window, Command::SavePicture, "pictureDialog", folder / "wipe.png");
    const QImage wipe = loaded(folder / "wipe.png");
    ASSERT_FALSE(wipe.isNull());
    EXPECT_GT(difference(wipe, reflecting.scaled(wipe.size())), 0.05)
        << "left of the bar the tram mirrors the sky alone";

    if (!hasProgram("ffmpeg") || !hasProgram("ffprobe"))
        return;
    take(window, Command::SaveFilm, "filmDialog", folder / "wipe.mp4");
    const QString stream = probed(folder / "wipe.mp4");
    EXPECT_TRUE(stream.startsWith(QStringLiteral("h264,%1,").arg(wipe.width())))
        << qPrintable(stream);
    EXPECT_TRUE(stream.endsWith(QStringLiteral(",yuv420p,30"))) << qPrintable(stream);
    const QImage first = frameOf(folder / "wipe.mp4", 0, folder / "first.png");
    ASSERT_FALSE(first.isNull());
    EXPECT_LT(difference(first, wipe.scaled(first.size())), 40.0) << "another view";
}

}  // namespace
}  // namespace reflet::test
