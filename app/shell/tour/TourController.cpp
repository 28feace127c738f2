// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/tour/TourController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Render.h"
#include "app/shell/Commands.h"
#include "app/shell/files/FileController.h"
#include "app/shell/overlays/Help.h"
#include "app/shell/overlays/Stage.h"
#include "app/shell/overlays/Welcome.h"
#include "app/shell/scene/CompareController.h"
#include "app/shell/scene/EditController.h"
#include "app/shell/scene/ReflectController.h"
#include "app/shell/scene/SceneController.h"
#include "widgets/panels/Checklist.h"
#include "widgets/plan/PlanView.h"
#include "widgets/viewport/Viewport.h"

#include <QMainWindow>
#include <algorithm>

namespace reflet {
namespace {

constexpr double kDemoBefore = 2.5;  // seconds of the drive before the view's moment
constexpr double kDemoAfter = 1.5;   // and after it
/// The sample's view where the vehicle lies across the picture, and a bar that divides the vehicle.
constexpr const char* kDemoView = "close";
constexpr float kDemoWipe = 0.34F;

/// The demonstration's view: that one, else the first. The project has views.
const View& demoView(const Project& project) {
    const auto found = std::find_if(project.views.begin(), project.views.end(),
                                    [](const View& view) { return view.name == kDemoView; });
    return found != project.views.end() ? *found : project.views.front();
}

}  // namespace

TourController::TourController(Workbench& bench, const Others& others, QObject* parent)
    : QObject(parent), m_bench(bench), m_others(others) {
    connectWelcome();
    connectChecklist();
    connect(others.files, &FileController::opened, this, &TourController::leaveDemo);
    connect(others.files, &FileController::demoOpened, this, &TourController::showDemo);
    connect(others.files, &FileController::cityOpened, this, [this] { m_ownCityPending = true; });
    connect(bench.live, &LiveCity::cityChanged, this, [this] {
        if (!m_bench.live->city()) {
            return;
        }
        if (m_demoCityPending) {
            demoCityCame();
        } else if (m_ownCityPending) {
            m_ownCityPending = false;
            cityOpened();
        }
    });
    // The tram's passage begins when there is a tram to be seen.
    connect(bench.live, &LiveCity::trafficChanged, this, [this] {
        if (m_loop) {
            m_bench.viewport->setTime(m_loop->from);
        }
    });
    connect(bench.viewport, &Viewport::timeChanged, this, &TourController::stepDemo);
    connect(bench.intents, &EditIntents::routeGrowing, this, &TourController::routeGrows);
    // Whoever begins something of his own has seen enough.
    for (const Command command :
         {Command::Compare, Command::SwapSides, Command::CheckReference, Command::DrawRoute,
          Command::PlaceProbe, Command::Frame, Command::FrameAll, Command::Walk, Command::Follow}) {
        connect(bench.commands->action(command), &QAction::triggered, this, [this] {
            if (m_stage == Stage::Demo) {
                m_stage = Stage::None;
                endDemo();
            }
        });
    }
    bench.stage->welcome()->hide();
    updateChecklist();
}

// ---- the first ten seconds ----

void TourController::connectWelcome() {
    Welcome* welcome = m_bench.stage->welcome();
    const auto showCaption = [this, welcome] {
        welcome->setCaption(
            tr("A tram passes the arcades. On the right of the bar it reflects them."),
            m_bench.live->rems().empty()
                ? tr("In a moment: Reflet takes its first pictures of the square.")
                : tr("Left: what a vehicle shows without Reflet, the sky alone. Drag the bar."));
    };
    showCaption();
    connect(m_bench.live, &LiveCity::remsChanged, this, showCaption);
    connect(welcome, &Welcome::openCityAsked, m_bench.commands->action(Command::Open),
            &QAction::trigger);
    connect(welcome, &Welcome::explanationAsked, m_bench.commands->action(Command::WhatAmISeeing),
            &QAction::trigger);
    connect(welcome, &Welcome::dismissed, this, &TourController::endDemo);
    connect(welcome, &Welcome::driveAsked, this, [this] {
        endDemo();
        const auto& reflectors = m_bench.document->project().reflectors;
        if (!reflectors.empty()) {
            m_bench.viewport->setTime(0.0);
            m_bench.viewport->follow(reflectors.front().id);
        }
        m_bench.viewport->setPlaying(true);
        m_bench.viewport->setFocus();
    });
}

void TourController::showDemo() {
    m_demoCityPending = true;
    m_stage = Stage::Demo;
    m_others.compare->setMethods(Method::Sky, Method::Mem);
    m_bench.viewport->setWipe(kDemoWipe);
    m_others.scene->setGlyphsShown(false);
    m_bench.viewport->setHudShown(false);  // it lies below the welcome
    m_bench.stage->welcome()->show();
    placeDemoCamera();
    if (m_bench.live->city()) {
        demoCityCame();
    }
}

void TourController::placeDemoCamera() {
    const Project& project = m_bench.document->project();
    if (project.views.empty()) {
        return;
    }
    const View& view = demoView(project);
    m_loop = Loop{std::max(0.0, view.time - kDemoBefore), view.time + kDemoAfter};
    m_bench.viewport->setCamera(cameraOf(view, project.frame), false);
    m_bench.viewport->setTime(m_loop->from);
}

void TourController::demoCityCame() {
    m_demoCityPending = false;
    // Again: without a city there was no ground to stand on.
    placeDemoCamera();
    m_bench.viewport->setPlaying(true);
}

void TourController::endDemo() {
    m_loop.reset();
    m_bench.stage->welcome()->hide();
    m_bench.viewport->setHudShown(true);
    m_others.scene->setGlyphsShown(true);
}

void TourController::stepDemo(double seconds) {
    if (m_loop && seconds > m_loop->to) {
        m_bench.viewport->setTime(m_loop->from);
    }
}

void TourController::leaveDemo() {
    endDemo();
    m_others.compare->setMethods(Method::Mem, std::nullopt);
    m_demoCityPending = false;
    m_bench.stage->setHint({});
    m_stage = Stage::None;
    m_drewRoute = m_madeReflect = m_checked = m_saved = false;
    updateChecklist();
}

// ---- three clicks ----

void TourController::cityOpened() {
    const Project& project = m_bench.document->project();
    m_others.compare->setMethods(Method::Mem, std::nullopt);
    if (!project.models.empty() && project.routes.empty()) {
        m_stage = Stage::RouteStart;
        QAction* draw = m_bench.commands->action(Command::DrawRoute);
        if (!draw->isChecked()) {
            draw->trigger();
        }
    } else if (!project.reflectors.empty()) {
        m_bench.viewport->setPlaying(true);
    }
    showHints();
    updateChecklist();
}

void TourController::routeGrows(int points) {
    if (m_stage == Stage::RouteStart || m_stage == Stage::RouteEnd) {
        m_stage = points == 0 ? Stage::RouteStart : Stage::RouteEnd;
        showHints();
        if (points > 1) {
            m_bench.stage->setHint(tr("Now press “Make it reflect”, or click on to go further"));
            m_bench.commands->setEnabled({Command::MakeItReflect}, true);
        }
    }
}

void TourController::showHints() {
    switch (m_stage) {
        case Stage::RouteStart:
            m_bench.stage->setHint(tr("Click on the street where the tram shall start"));
            break;
        case Stage::RouteEnd:
            m_bench.stage->setHint(tr("Click where it shall go"));
            break;
        case Stage::RouteReady:
            m_bench.stage->setHint(tr("Now press “Make it reflect” (M)"));
            break;
        case Stage::None:
        case Stage::Demo:
        case Stage::Reflecting:
            m_bench.stage->setHint({});
            break;
    }
}

// ---- the first five minutes ----

void TourController::connectChecklist() {
    connect(m_bench.checklist, &Checklist::stepActivated, this, &TourController::activateStep);
    connect(m_bench.checklist, &Checklist::left, this, [this] {
        if (QWidget* dock = m_bench.checklist->parentWidget()) {
            dock->hide();
        }
    });
    connect(m_bench.document, &ProjectDocument::projectChanged, this,
            &TourController::updateChecklist);
    connect(m_others.edit, &EditController::routeDrawn, this, [this] {
        m_drewRoute = true;
        if (m_stage == Stage::RouteStart || m_stage == Stage::RouteEnd) {
            m_stage = Stage::RouteReady;
        }
        showHints();
        updateChecklist();
    });
    connect(m_others.reflect, &ReflectController::reflects, this, [this] {
        m_madeReflect = true;
        m_stage = Stage::Reflecting;
        showHints();
        updateChecklist();
    });
    connect(m_others.compare, &CompareController::checked, this, [this] {
        m_checked = true;
        updateChecklist();
    });
}

void TourController::savedSomething() {
    m_saved = true;
    updateChecklist();
}

void TourController::updateChecklist() {
    const Project& project = m_bench.document->project();
    const bool demo = m_others.files->showsDemo();
    Checklist* list = m_bench.checklist;
    list->setDone(Checklist::OpenCity, !demo && !project.models.empty());
    // What the sample brings along was not done by the user.
    list->setDone(Checklist::DrawRoute, m_drewRoute || (!demo && !project.routes.empty()));
    list->setDone(
        Checklist::MakeItReflect,
        m_madeReflect || (!demo && !project.reflectors.empty() && !project.probes.empty()));
    list->setDone(Checklist::CheckAgainstReference, m_checked);
    list->setDone(Checklist::SaveSomething, m_saved);
    list->setPossible(Checklist::DrawRoute, !project.models.empty());
    list->setPossible(Checklist::MakeItReflect, !project.routes.empty());
    list->setPossible(Checklist::CheckAgainstReference, !project.reflectors.empty());
    list->setPossible(Checklist::SaveSomething, !project.models.empty());
}

void TourController::activateStep(int step) {
    static constexpr Command kCommands[Checklist::kSteps] = {
        Command::Open, Command::DrawRoute, Command::MakeItReflect, Command::CheckReference,
        Command::SavePicture};
    if (step >= 0 && step < Checklist::kSteps) {
        endDemo();
        m_bench.commands->action(kCommands[step])->trigger();
    }
}

}  // namespace reflet
