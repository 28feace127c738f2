// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/PauseWatch.h"

#include <QString>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

class QSlider;
class QWidget;

namespace reflet {

class MainWindow;

/// One thing that a planner does, and how the window bore it.
struct RehearsedAction {
    QString name;
    bool done = false;          ///< what was to come of it came
    PauseWatch::Pause longest;  ///< of the pauses until then
    PauseWatch::Pause hardest;  ///< the one with the most work in it
    /// Pictures that came on the screen from a step of a slider to the first that shows it, that
    /// one counted: the most of all steps. None for what changes no picture.
    std::optional<int> pictures;
    double shownAfter = 0.0;  ///< milliseconds until that picture, at most
};

/// A planner's work, done by the program itself with the events that hands would cause: drives,
/// drags a probe and waits for its map, undoes, redoes, moves every slider, saves, adds a city,
/// opens another project, which it closes. Works on a copy of the project in a folder of its own;
/// the maps that are baked meanwhile are kept where the project's are.
class Rehearsal {
public:
    /// The window shows a project; the watch looks at the application's events, or at none (then
    /// there are no pauses). `folder` is there and empty. All outlive this.
    Rehearsal(MainWindow& window, PauseWatch& watch, std::filesystem::path folder);

    /// Takes minutes. To be called while no event is handled: pauses are those between events.
    [[nodiscard]] std::vector<RehearsedAction> run();

private:
    using Condition = std::function<bool()>;

    RehearsedAction& act(const QString& name, const std::function<void()>& begin,
                         const Condition& done);
    void copyProject();
    void drive();
    void dragProbe();
    void moveSliders();
    void moveSlider(QSlider& slider);
    void changeHistory();
    void save();
    void addCity();
    void answerAdd();
    void openAnother();

    struct Shown {
        int pictures = 0;
        double milliseconds = 0.0;
    };
    /// Steps the slider and waits for the first picture that shows it; none: it changes none.
    [[nodiscard]] std::optional<Shown> stepUntilShown(QWidget& slider, const QPoint& to);
    [[nodiscard]] bool cityShown() const;
    void pushButton(const QString& tool);
    void showPanel(const QString& name);

    MainWindow& m_window;
    PauseWatch& m_watch;
    std::filesystem::path m_folder;
    std::vector<RehearsedAction> m_actions;
};

/// As a table of one line for each action.
[[nodiscard]] QString rehearsalText(const std::vector<RehearsedAction>& actions);

}  // namespace reflet
