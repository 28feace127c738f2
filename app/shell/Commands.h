// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAction>
#include <QObject>
#include <array>
#include <span>

namespace reflet {

/// Everything that a planner can ask the window for, by name. Each is one QAction with one
/// shortcut, shown in the menus, in the toolbar and in the list of keys alike.
enum class Command {
    New,
    Open,
    AddCity,
    PlaceModel,
    UpdateModel,
    ShowReport,
    OpenSample,
    Save,
    SaveAs,
    SavePicture,
    SaveFilm,
    Quit,
    Undo,
    Redo,
    Delete,
    Duplicate,
    PlaceProbe,
    DrawRoute,
    AddTram,
    AddBus,
    AddCar,
    AddSphere,
    AddPerson,
    AddVehicleFile,
    MakeItReflect,
    BakeNow,
    AutoBake,
    CancelBaking,
    MeasureCoverage,
    SuggestProbes,
    AcceptSuggestions,
    DismissSuggestions,
    Navigate,
    Frame,
    FrameAll,
    Walk,
    Follow,
    Play,
    PlanBeside,
    PreviewSphere,
    HeightfieldShown,
    CoverageShown,
    SaveView,
    FullScreen,
    ResetLayout,
    Compare,
    SwapSides,
    CheckReference,
    WhatAmISeeing,
    Keys,
    About,
};
inline constexpr std::size_t kCommandCount = static_cast<std::size_t>(Command::About) + 1;

/// Under which heading a command is listed in the menus and in the list of keys.
enum class CommandGroup { File, Edit, Place, View, Compare, Help };

/// What is fixed about a command; texts are in English, to be translated by Commands.
struct CommandInfo {
    Command command;
    CommandGroup group;
    const char* name;         ///< objectName of the action: stable, for tests and settings
    const char* text;         ///< as in the menu, with its mnemonic
    const char* icon;         ///< of resources/icons; "" = none
    const char* keys;         ///< portable key sequence; "" = none
    const char* explanation;  ///< tooltip and status bar, plain words
    bool checkable = false;
};

[[nodiscard]] std::span<const CommandInfo> allCommands();

/// The actions of one window. What they do is connected by those who do it.
class Commands : public QObject {
    Q_OBJECT
public:
    explicit Commands(QWidget* window);

    [[nodiscard]] QAction* action(Command command) const {
        return m_actions[static_cast<std::size_t>(command)];
    }
    /// Enabled or not, all at once.
    void setEnabled(std::initializer_list<Command> commands, bool enabled);
    [[nodiscard]] static QString groupTitle(CommandGroup group);

private:
    std::array<QAction*, kCommandCount> m_actions{};
};

}  // namespace reflet
