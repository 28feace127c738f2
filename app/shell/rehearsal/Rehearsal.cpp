// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/rehearsal/Rehearsal.h"

#include "app/document/LiveCity.h"
#include "app/pipeline/WriteSample.h"
#include "app/shell/Commands.h"
#include "app/shell/MainWindow.h"
#include "app/shell/rehearsal/Hands.h"
#include "widgets/common/DragSlider.h"
#include "widgets/viewport/Viewport.h"

#include <QAbstractButton>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QSlider>
#include <algorithm>
#include <utility>

namespace reflet {

namespace {

constexpr int kPatience = 120'000;  ///< milliseconds for work in the background
constexpr int kRest = 400;          ///< for what an action leaves behind
constexpr int kDrive = 2000;
constexpr int kHandPace = 16;  ///< between two moves of the mouse
constexpr int kDragSteps = 20;
constexpr int kSliderSteps = 8;
constexpr int kNever = 9999;  ///< pictures: more than anybody waits for
constexpr int kMessagesAtMost = 20;
constexpr std::uint64_t kSeed = 1;

}  // namespace

Rehearsal::Rehearsal(MainWindow& window, PauseWatch& watch, std::filesystem::path folder)
    : m_window(window), m_watch(watch), m_folder(std::move(folder)) {}

std::vector<RehearsedAction> Rehearsal::run() {
    m_actions.clear();
    hands::waitFor([this] { return cityShown(); }, kPatience);
    copyProject();
    drive();
    dragProbe();
    changeHistory();
    moveSliders();
    save();
    addCity();
    save();
    openAnother();
    m_window.document().close();
    return std::exchange(m_actions, {});
}

RehearsedAction& Rehearsal::act(const QString& name, const std::function<void()>& begin,
                                const Condition& done) {
    m_watch.forget();
    begin();
    RehearsedAction action;
    action.name = name;
    action.done = hands::waitFor(done, kPatience);
    hands::rest(kRest);
    action.longest = m_watch.longest();
    action.hardest = m_watch.hardest();
    m_actions.push_back(std::move(action));
    return m_actions.back();
}

bool Rehearsal::cityShown() const {
    const LiveCity& live = *m_window.bench().live;
    return live.city() != nullptr && !live.loading() &&
           m_window.bench().viewport->picturesFinished() > 0;
}

void Rehearsal::pushButton(const QString& tool) {
    if (auto* button = m_window.findChild<QAbstractButton*>(QStringLiteral("tool_") + tool)) {
        hands::click(*button);
    }
}

void Rehearsal::showPanel(const QString& name) {
    auto* dock = m_window.findChild<QDockWidget*>(name + QStringLiteral("Dock"));
    if (dock && !dock->isVisible()) {
        dock->toggleViewAction()->trigger();
    }
}

void Rehearsal::copyProject() {
    act(
        QStringLiteral("save under another name"),
        [this] {
            hands::ask(m_window, [this] {
                static_cast<void>(m_window.document().saveAs(m_folder / "rehearsal.reflet"));
            });
        },
        [this] { return m_window.document().file().parent_path() == m_folder && cityShown(); });
}

void Rehearsal::drive() {
    Viewport& viewport = *m_window.bench().viewport;
    if (viewport.playing()) {
        pushButton(QStringLiteral("play"));
    }
    const double before = viewport.time();
    act(
        QStringLiteral("drive"), [this] { pushButton(QStringLiteral("play")); },
        [&, steps = 0]() mutable {
            return viewport.time() != before && ++steps > kDrive / kHandPace;
        });
    pushButton(QStringLiteral("play"));
}

void Rehearsal::dragProbe() {
    ProjectDocument& document = m_window.document();
    if (document.project().probes.empty()) {
        return;
    }
    LiveCity& live = *m_window.bench().live;
    Viewport& viewport = *m_window.bench().viewport;
    const auto& probes = document.project().probes;
    const Probe probe = probes[probes.size() / 2];
    act(
        QStringLiteral("select a probe"),
        [&] {
            hands::ask(m_window, [&document, probe] {
                document.selection()->set({ProjectItem::Kind::Probe, probe.id});
            });
            hands::rest(kRest);
            pushButton(QStringLiteral("frame"));
        },
        [] { return true; });
    hands::rest(kRest);
    const auto there =
        viewport.geometry().project(probe.position - document.project().frame.origin).pixel;
    const QPoint from(int(there.x), int(there.y));
    const int steps = document.undoStack()->index();
    act(
        QStringLiteral("drag a probe"),
        [&] {
            hands::move(viewport, from);
            hands::press(viewport, from);
            for (int step = 1; step <= kDragSteps; ++step) {
                hands::rest(kHandPace);
                hands::move(viewport, from + QPoint(2 * step, step));
            }
            hands::release(viewport, from + QPoint(2 * kDragSteps, kDragSteps));
        },
        [&] { return document.undoStack()->index() == steps + 1; });
    act(
        QStringLiteral("bake its map"), [] {},
        [&] {
            const ProbeState state = live.probeState(probe.id);
            return state == ProbeState::Fresh || state == ProbeState::Refused;
        });
}

void Rehearsal::changeHistory() {
    QUndoStack& history = *m_window.document().undoStack();
    const int index = history.index();
    if (!history.canUndo()) {
        return;
    }
    act(
        QStringLiteral("undo"), [this] { pushButton(QStringLiteral("undo")); },
        [&] { return history.index() == index - 1; });
    act(
        QStringLiteral("redo"), [this] { pushButton(QStringLiteral("redo")); },
        [&] { return history.index() == index; });
}

void Rehearsal::moveSliders() {
    for (const auto* panel : {"tuning", "sun"}) {
        const QString name = QString::fromLatin1(panel);
        act(
            QStringLiteral("show the panel “%1”").arg(name), [&] { showPanel(name); },
            [] { return true; });
        auto* content = m_window.findChild<QWidget*>(name);
        for (DragSlider* slider :
             content ? content->findChildren<DragSlider*>() : QList<DragSlider*>()) {
            if (slider->isVisible() && slider->isEnabled()) {
                moveSlider(*slider);
            }
        }
    }
}

void Rehearsal::moveSlider(QSlider& slider) {
    std::optional<Shown> most;
    const auto at = [&](int step) {
        return QPoint(slider.width() * (2 * step + 1) / (2 * kSliderSteps + 2),
                      slider.height() / 2);
    };
    const auto step = [&](const QPoint& to) {
        if (const auto shown = stepUntilShown(slider, to)) {
            const Shown before = most.value_or(Shown());
            most = Shown{std::max(before.pictures, shown->pictures),
                         std::max(before.milliseconds, shown->milliseconds)};
        }
        hands::rest(kHandPace);
    };
    RehearsedAction& action = act(
        QStringLiteral("slider “%1”").arg(slider.objectName()),
        [&] {
            hands::press(slider, at(0));
            for (int k = 1; k <= kSliderSteps; ++k) {
                step(at(k));
            }
            hands::release(slider, at(kSliderSteps));
        },
        [] { return true; });
    if (most) {
        action.pictures = most->pictures;
        action.shownAfter = most->milliseconds;
    }
}

std::optional<Rehearsal::Shown> Rehearsal::stepUntilShown(QWidget& slider, const QPoint& to) {
    Viewport& viewport = *m_window.bench().viewport;
    const quint64 before = viewport.revision();
    const quint64 finished = viewport.picturesFinished();
    QElapsedTimer since;
    since.start();
    Shown shown;
    bool seen = false;
    quint64 wanted = before;
    QObject listener;
    QObject::connect(&viewport, &Viewport::pictureShown, &listener,
                     [&](quint64 number, quint64 revision) {
                         if (!seen && number > finished) {
                             ++shown.pictures;
                             seen = revision >= wanted && wanted > before;
                         }
                     });
    hands::move(slider, to);
    wanted = viewport.revision();
    if (wanted == before) {
        return std::nullopt;
    }
    if (!hands::waitFor([&] { return seen; }, kPatience)) {
        shown.pictures = kNever;
    }
    shown.milliseconds = double(since.elapsed());
    return shown;
}

void Rehearsal::save() {
    act(
        QStringLiteral("save"), [this] { pushButton(QStringLiteral("save")); },
        [this] { return !m_window.document().isDirty(); });
}

void Rehearsal::addCity() {
    ProjectDocument& document = m_window.document();
    const auto& models = document.project().models;
    if (models.empty()) {
        return;
    }
    const std::filesystem::path first = modelPath(models.front(), document.folder());
    const std::filesystem::path copy = m_folder / ("second-" + first.filename().string());
    std::error_code error;
    std::filesystem::copy_file(first, copy, error);
    const std::size_t before = models.size();
    const auto* live = m_window.bench().live;
    const auto city = live->city();
    act(
        QStringLiteral("add a city"),
        [&] {
            hands::drop(m_window, {QString::fromStdString(copy.string())});
            answerAdd();
        },
        [&] {
            return document.project().models.size() == before + 1 && cityShown() &&
                   live->city() != city;
        });
}

void Rehearsal::openAnother() {
    const auto another = writeSample("paper", kSeed, m_folder / "another");
    if (!another) {
        return;
    }
    const auto* live = m_window.bench().live;
    const auto city = live->city();
    act(
        QStringLiteral("open another project"),
        [&] { hands::drop(m_window, {QString::fromStdString(another->string())}); },
        [&] {
            return m_window.document().file() == *another && cityShown() && live->city() != city;
        });
}

/// Of “Open it in place of this one” and “Add it to this project” the second; older messages, which
/// stand before the question, are closed.
void Rehearsal::answerAdd() {
    for (int closed = 0; closed < kMessagesAtMost; ++closed) {
        auto* add = m_window.findChild<QAbstractButton*>(QStringLiteral("messageAction1"));
        if (add && add->isVisible()) {
            hands::click(*add);
            return;
        }
        auto* close = m_window.findChild<QAbstractButton*>(QStringLiteral("messageClose"));
        if (!close || !close->isVisible()) {
            return;
        }
        hands::click(*close);
        hands::rest(kHandPace);
    }
}

QString rehearsalText(const std::vector<RehearsedAction>& actions) {
    QString text = QStringLiteral("%1 %2 %3 %4 %5  %6\n")
                       .arg(QStringLiteral("action"), -28)
                       .arg(QStringLiteral("longest"), 8)
                       .arg(QStringLiteral("at work"), 8)
                       .arg(QStringLiteral("pictures"), 8)
                       .arg(QStringLiteral("after"), 6)
                       .arg(QStringLiteral("the longest pause (ms)"));
    for (const RehearsedAction& action : actions) {
        const auto seen = [&](const QString& figure) {
            return action.pictures ? figure : QStringLiteral("-");
        };
        text += QStringLiteral("%1 %2 %3 %4 %5  %6\n")
                    .arg(action.done ? action.name : action.name + QStringLiteral(" (failed)"), -28)
                    .arg(action.longest.milliseconds, 8, 'f', 1)
                    .arg(action.hardest.work, 8, 'f', 1)
                    .arg(seen(QString::number(action.pictures.value_or(0))), 8)
                    .arg(seen(QString::number(action.shownAfter, 'f', 0)), 6)
                    .arg(action.longest.what);
    }
    return text;
}

}  // namespace reflet
