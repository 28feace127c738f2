// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/Commands.h"

#include "app/shell/Icons.h"

#include <QKeySequence>
#include <QWidget>

namespace reflet {
namespace {

using enum CommandGroup;

// The one list of commands and keys. QT_TRANSLATE_NOOP marks the texts for translators.
#define T(text) QT_TRANSLATE_NOOP("reflet::Commands", text)
const CommandInfo kCommands[] = {
    {Command::New, File, "new", T("&New project"), "new", "Ctrl+N",
     T("Start with nothing: then drop a city into the window")},
    {Command::Open, File, "open", T("&Open your city…"), "open", "Ctrl+O",
     T("Open a project, or a city model (CityJSON, CityGML)")},
    {Command::AddCity, File, "addCity", T("&Add a city file to this project…"), "", "",
     T("Put another city file of the same place beside what is there")},
    {Command::PlaceModel, File, "placeModel", T("P&lace a model…"), "", "",
     T("Say where on the Earth a model without coordinates stands, and where its north is")},
    {Command::UpdateModel, File, "updateModel", T("&Update from file…"), "", "",
     T("Put a new delivery of a city file in the place of the old one, and see what has changed")},
    {Command::ShowReport, File, "showReport", T("Import re&port"), "remarks", "",
     T("What was read of the city's files, what was mended and what was left out")},
    {Command::OpenSample, File, "openSample", T("Open the sample &square"), "", "",
     T("A small made-up town with a tram, to try everything on")},
    {Command::Save, File, "save", T("&Save"), "save", "Ctrl+S", T("Save the project")},
    {Command::SaveAs, File, "saveAs", T("Save &as…"), "", "Ctrl+Shift+S",
     T("Save the project under another name")},
    {Command::SavePicture, File, "savePicture", T("Save &picture…"), "picture", "Ctrl+P",
     T("Save what you see as a picture, at the size you choose")},
    {Command::SaveFilm, File, "saveFilm", T("Save &film…"), "film", "Ctrl+Shift+P",
     T("Save the drive as a film, 20 seconds or as long as you like")},
    {Command::Quit, File, "quit", T("&Quit"), "", "Ctrl+Q", T("Close Reflet")},

    {Command::Undo, Edit, "undo", T("&Undo"), "undo", "Ctrl+Z", T("Take back the last change")},
    {Command::Redo, Edit, "redo", T("&Redo"), "redo", "Ctrl+Shift+Z",
     T("Do again what was taken back")},
    {Command::Delete, Edit, "delete", T("&Delete"), "delete", "Delete",
     T("Remove what is selected from the project")},
    {Command::Duplicate, Edit, "duplicate", T("D&uplicate"), "duplicate", "Ctrl+D",
     T("Make a copy of what is selected")},

    {Command::PlaceProbe, Place, "placeProbe", T("&Place reflection probe"), "probe", "P",
     T("Click where a reflection probe shall stand: it takes the picture that vehicles reflect"),
     true},
    {Command::DrawRoute, Place, "drawRoute", T("Draw &route"), "route", "R",
     T("Click along the street where a vehicle shall drive; Enter or a double click ends it"),
     true},
    {Command::AddTram, Place, "addTram", T("Add &tram"), "tram", "",
     T("Put a tram on the selected route")},
    {Command::AddBus, Place, "addBus", T("Add &bus"), "bus", "",
     T("Put a bus on the selected route")},
    {Command::AddCar, Place, "addCar", T("Add &car"), "car", "",
     T("Put a car on the selected route")},
    {Command::AddSphere, Place, "addSphere", T("Add &mirror ball"), "sphere", "",
     T("Put a polished ball on the selected route: the plainest test of a reflection")},
    {Command::AddPerson, Place, "addPerson", T("Add &person"), "walk", "",
     T("Let somebody walk along the selected route: vehicles stop where it crosses theirs")},
    {Command::AddVehicleFile, Place, "addVehicleFile", T("Add vehicle from &file…"), "", "",
     T("Put a vehicle of your own (glTF, .glb) on the selected route")},
    {Command::MakeItReflect, Place, "makeItReflect", T("&Make it reflect"), "reflect", "M",
     T("Place reflection probes where they serve the route most, take their pictures and drive")},
    {Command::BakeNow, Place, "bakeNow", T("Take probe pictures &now"), "bake", "Ctrl+B",
     T("Take the pictures of all probes that are missing or out of date")},
    {Command::AutoBake, Place, "autoBake", T("Take probe pictures b&y itself"), "", "",
     T("Take them anew in the background whenever something changes"), true},
    {Command::CancelBaking, Place, "cancelBaking", T("&Stop taking pictures"), "stop", "",
     T("Stop; what has been taken is kept")},
    {Command::MeasureCoverage, Place, "measureCoverage", T("Measure c&overage"), "coverage",
     "Shift+V",
     T("How much of what vehicles mirror the probes show rightly, and where they do not")},
    {Command::SuggestProbes, Place, "suggestProbes", T("Su&ggest probes"), "", "Shift+P",
     T("Work out where probes serve most, with a proof of how good that is")},
    {Command::AcceptSuggestions, Place, "acceptSuggestions", T("A&ccept all suggested probes"), "",
     "Return", T("Add the suggested probes to the project; a click on one adds that one")},
    {Command::DismissSuggestions, Place, "dismissSuggestions", T("Dismiss suggested probes"), "",
     "Esc", T("Take the suggested probes away")},

    {Command::Navigate, View, "navigate", T("&Look around"), "", "", T("Put the tool down")},
    {Command::Frame, View, "frame", T("&Frame selection"), "frame", "F",
     T("Bring what is selected into view")},
    {Command::FrameAll, View, "frameAll", T("Frame &all"), "home", "Home",
     T("Bring the whole city into view")},
    {Command::Walk, View, "walk", T("&Walk"), "walk", "W",
     T("Stand on the pavement: arrow keys to walk, drag to look around"), true},
    {Command::Follow, View, "follow", T("F&ollow the vehicle"), "follow", "T",
     T("Let the camera travel with the selected vehicle"), true},
    {Command::Play, View, "play", T("&Drive"), "play", "Space",
     T("Let the vehicles drive, or hold them"), true},
    {Command::PlanBeside, View, "planBeside", T("&Plan beside the picture"), "plan", "Ctrl+L",
     T("Show the map of the city at the side"), true},
    {Command::PreviewSphere, View, "previewSphere", T("P&review ball on the probe"), "sphere", "B",
     T("Show what the selected probe has seen, on a ball at its place"), true},
    {Command::HeightfieldShown, View, "heightfieldShown", T("Show the &heightfield"), "heightfield",
     "H", T("Show the relief in which reflected rays are traced"), true},
    {Command::CoverageShown, View, "coverageShown", T("Show the &coverage"), "coverage", "V",
     T("Colour routes and façades by how well the probes cover them"), true},
    {Command::SaveView, View, "saveView", T("&Keep this view…"), "camera", "Ctrl+K",
     T("Give the present view a name and keep it in the project")},
    {Command::FullScreen, View, "fullScreen", T("F&ull screen"), "fullscreen", "F11",
     T("The picture alone"), true},
    {Command::ResetLayout, View, "resetLayout", T("Reset la&yout"), "", "",
     T("Put all panels back where they were at the first start")},

    {Command::Compare, Compare, "compare", T("Compare &side by side"), "compare", "X",
     T("Divide the picture by a bar that can be moved: one method on each side"), true},
    {Command::SwapSides, Compare, "swapSides", T("S&wap the sides"), "", "Shift+X",
     T("Change left and right of the bar")},
    {Command::CheckReference, Compare, "checkReference", T("&Check against the reference"), "check",
     "C", T("Hold the vehicle, ray trace what it truly reflects, and say how close Reflet comes")},

    {Command::WhatAmISeeing, Help, "whatAmISeeing", T("&What am I seeing?"), "help", "F1",
     T("In plain words: what a reflection probe is, and what the bar divides")},
    {Command::Keys, Help, "keys", T("&Keys"), "", "?", T("All keys at a glance")},
    {Command::About, Help, "about", T("&About Reflet"), "", "",
     T("Version, licence, and what Reflet is made with")},
};
#undef T

static_assert(std::size(kCommands) == kCommandCount, "each command has its row");

}  // namespace

std::span<const CommandInfo> allCommands() {
    return kCommands;
}

Commands::Commands(QWidget* window) : QObject(window) {
    for (const CommandInfo& info : kCommands) {
        auto* action = new QAction(tr(info.text), window);
        action->setObjectName(QString::fromLatin1(info.name));
        action->setCheckable(info.checkable);
        const QKeySequence keys(QString::fromLatin1(info.keys), QKeySequence::PortableText);
        if (!keys.isEmpty()) {
            action->setShortcut(keys);
        }
        if (*info.icon != '\0') {
            action->setIcon(icon(QString::fromLatin1(info.icon)));
        }
        const QString explanation = tr(info.explanation);
        action->setStatusTip(explanation);
        const QString shown = keys.toString(QKeySequence::NativeText);
        action->setToolTip(keys.isEmpty() ? explanation : tr("%1 (%2)").arg(explanation, shown));
        window->addAction(action);
        m_actions[static_cast<std::size_t>(info.command)] = action;
    }
    action(Command::Quit)->setMenuRole(QAction::QuitRole);
    action(Command::About)->setMenuRole(QAction::AboutRole);
}

void Commands::setEnabled(std::initializer_list<Command> commands, bool enabled) {
    for (const Command command : commands) {
        action(command)->setEnabled(enabled);
    }
}

QString Commands::groupTitle(CommandGroup group) {
    switch (group) {
        case File:
            return tr("&File");
        case Edit:
            return tr("&Edit");
        case Place:
            return tr("&Place");
        case View:
            return tr("&View");
        case Compare:
            return tr("&Compare");
        case Help:
            return tr("&Help");
    }
    return {};
}

}  // namespace reflet
