// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/WindowLayout.h"

#include "app/document/JobRunner.h"
#include "app/shell/Commands.h"
#include "app/shell/Icons.h"
#include "app/shell/JobChip.h"
#include "app/shell/Notices.h"
#include "app/shell/ToolBar.h"
#include "app/shell/overlays/Stage.h"
#include "widgets/coverage/CoveragePanel.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/Checklist.h"
#include "widgets/panels/JobList.h"
#include "widgets/panels/MessageBar.h"
#include "widgets/panels/ProjectTree.h"
#include "widgets/panels/ReportPanel.h"
#include "widgets/panels/SunPanel.h"
#include "widgets/panels/Timeline.h"
#include "widgets/plan/PlanView.h"
#include "widgets/preview/MapPreview.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QUndoView>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr int kToolIcon = 24;
constexpr int kSideIcon = 20;
constexpr int kFirstPanelWidth = 300;
constexpr int kPictureShare = 3;  // of the splitter, against the plan's 2
constexpr int kPlanShare = 2;
constexpr int kLayoutVersion = 1;
const char* const kGeometryKey = "window/geometry";
const char* const kStateKey = "window/state";
const char* const kSplitKey = "window/split";

}  // namespace

WindowLayout::WindowLayout(Workbench& bench, QMainWindow* window)
    : QObject(window), m_bench(bench), m_window(window) {
    auto* messages = new MessageBar;
    messages->setObjectName(QStringLiteral("messageBar"));
    m_bench.notices = new Notices(messages, this);

    m_bench.stage = new Stage;
    m_bench.intents = new EditIntents(this);
    m_bench.viewport = new Viewport(m_bench.intents);
    m_bench.viewport->setObjectName(QStringLiteral("viewport"));
    m_bench.stage->setPicture(m_bench.viewport);
    m_bench.stage->setMessages(messages);
    m_bench.plan = new PlanView(m_bench.intents);
    m_bench.plan->setObjectName(QStringLiteral("planView"));
    m_bench.views = new QSplitter(Qt::Horizontal);
    m_bench.views->setObjectName(QStringLiteral("views"));
    m_bench.views->addWidget(m_bench.stage);
    m_bench.views->addWidget(m_bench.plan);
    m_bench.views->setStretchFactor(0, kPictureShare);
    m_bench.views->setStretchFactor(1, kPlanShare);
    m_bench.views->setChildrenCollapsible(false);
    m_bench.plan->hide();
    m_bench.timeline = new Timeline;
    m_bench.timeline->setObjectName(QStringLiteral("timeline"));

    auto* centre = new QWidget;
    auto* column = new QVBoxLayout(centre);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_bench.views, 1);
    column->addWidget(m_bench.timeline);
    window->setCentralWidget(centre);

    makePanels();
    makeMenus();
    makeToolBar();
    makeSideBar();
    makeStatusBar();
    m_firstState = window->saveState(kLayoutVersion);
}

QDockWidget* WindowLayout::addPanel(const QString& name, const QString& title, const QString& icon,
                                    QWidget* content, Qt::DockWidgetArea area) {
    auto* dock = new QDockWidget(title, m_window);
    dock->setObjectName(name + QStringLiteral("Dock"));
    content->setObjectName(name);
    dock->setWidget(content);
    QAction* toggle = dock->toggleViewAction();
    toggle->setObjectName(name + QStringLiteral("Toggle"));
    toggle->setIcon(reflet::icon(icon));
    connect(toggle, &QAction::triggered, dock, [dock](bool shown) {
        if (shown) {
            dock->raise();
        }
    });
    m_window->addDockWidget(area, dock);
    m_panels.push_back(dock);
    return dock;
}

void WindowLayout::makePanels() {
    const auto left = Qt::LeftDockWidgetArea;
    const auto right = Qt::RightDockWidgetArea;
    m_window->setDockOptions(QMainWindow::AllowTabbedDocks | QMainWindow::AnimatedDocks);
    m_window->setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);

    m_bench.checklist = new Checklist;
    m_bench.tree = new ProjectTree;
    m_bench.inspector = new Inspector;
    m_bench.tuning = new TuningPanel;
    m_bench.preview = new MapPreview;
    m_bench.sun = new SunPanel;
    m_bench.coverage = new CoveragePanel;
    m_bench.report = new ReportPanel;
    m_bench.jobList = new JobList;
    m_history = new QUndoView;
    m_history->setEmptyLabel(tr("As opened"));

    auto add = [&](const char* name, const QString& title, const char* icon, QWidget* widget,
                   Qt::DockWidgetArea area) {
        return addPanel(QString::fromLatin1(name), title, QString::fromLatin1(icon), widget, area);
    };
    QDockWidget* steps = add("checklist", tr("First steps"), "steps", m_bench.checklist, right);
    QDockWidget* tree = add("projectTree", tr("Project"), "tree", m_bench.tree, left);
    QDockWidget* inspector =
        add("inspector", tr("Selected"), "inspector", m_bench.inspector, right);
    QDockWidget* tuning = add("tuning", tr("Tuning"), "tuning", m_bench.tuning, right);
    QDockWidget* coverage = add("coverage", tr("Coverage"), "coverage", m_bench.coverage, right);
    QDockWidget* preview = add("mapPreview", tr("What it saw"), "map", m_bench.preview, right);
    QDockWidget* sun = add("sun", tr("Sun and light"), "sun", m_bench.sun, right);
    QDockWidget* remarks = add("remarks", tr("Import report"), "remarks", m_bench.report, right);
    QDockWidget* jobs = add("jobs", tr("In the background"), "jobs", m_bench.jobList, right);
    QDockWidget* history = add("history", tr("History"), "history", m_history, left);
    for (QDockWidget* dock : {inspector, tuning, coverage, preview, sun, remarks, jobs}) {
        m_window->tabifyDockWidget(steps, dock);
        dock->hide();
    }
    m_window->tabifyDockWidget(tree, history);
    tree->hide();
    history->hide();
    m_window->resizeDocks({steps}, {kFirstPanelWidth}, Qt::Horizontal);
}

void WindowLayout::setUndoStack(QUndoStack* stack) {
    m_history->setStack(stack);
}

void WindowLayout::addCommands(QMenu* menu, std::initializer_list<int> commands) {
    for (const int command : commands) {
        if (command < 0) {
            menu->addSeparator();
        } else {
            menu->addAction(m_bench.commands->action(static_cast<Command>(command)));
        }
    }
}

void WindowLayout::makeMenus() {
    constexpr int kLine = -1;
    auto menuOf = [this](CommandGroup group, const char* name) {
        QMenu* menu = m_window->menuBar()->addMenu(Commands::groupTitle(group));
        menu->setObjectName(QString::fromLatin1(name));
        menu->setToolTipsVisible(true);
        return menu;
    };
    using enum Command;
    auto at = [](Command command) { return static_cast<int>(command); };

    QMenu* file = menuOf(CommandGroup::File, "fileMenu");
    addCommands(file, {at(New), at(Open)});
    m_recent = file->addMenu(tr("Open &recent"));
    m_recent->setObjectName(QStringLiteral("recentMenu"));
    addCommands(
        file, {at(AddCity), at(PlaceModel), at(UpdateModel), at(ShowReport), at(OpenSample), kLine,
               at(Save), at(SaveAs), kLine, at(SavePicture), at(SaveFilm), kLine, at(Quit)});

    addCommands(menuOf(CommandGroup::Edit, "editMenu"),
                {at(Undo), at(Redo), kLine, at(Duplicate), at(Delete)});

    addCommands(menuOf(CommandGroup::Place, "placeMenu"), {at(MakeItReflect),
                                                           kLine,
                                                           at(DrawRoute),
                                                           at(PlaceProbe),
                                                           at(Navigate),
                                                           kLine,
                                                           at(AddTram),
                                                           at(AddBus),
                                                           at(AddCar),
                                                           at(AddSphere),
                                                           at(AddPerson),
                                                           at(AddVehicleFile),
                                                           kLine,
                                                           at(BakeNow),
                                                           at(AutoBake),
                                                           at(CancelBaking),
                                                           kLine,
                                                           at(MeasureCoverage),
                                                           at(SuggestProbes),
                                                           at(AcceptSuggestions),
                                                           at(DismissSuggestions)});

    QMenu* view = menuOf(CommandGroup::View, "viewMenu");
    addCommands(view,
                {at(Play), at(Walk), at(Follow), at(Frame), at(FrameAll), kLine, at(SaveView)});
    m_views = view->addMenu(tr("&Go to view"));
    m_views->setObjectName(QStringLiteral("viewsMenu"));
    addCommands(view, {kLine, at(PlanBeside), at(PreviewSphere), at(HeightfieldShown),
                       at(CoverageShown), kLine});
    QMenu* panels = view->addMenu(tr("Pa&nels"));
    panels->setObjectName(QStringLiteral("panelsMenu"));
    for (QDockWidget* dock : m_panels) {
        panels->addAction(dock->toggleViewAction());
    }
    view->addMenu(tr("&Theme"))->setObjectName(QStringLiteral("themeMenu"));
    addCommands(view, {at(FullScreen), at(ResetLayout)});

    addCommands(menuOf(CommandGroup::Compare, "compareMenu"),
                {at(Compare), at(SwapSides), kLine, at(CheckReference)});
    addCommands(menuOf(CommandGroup::Help, "helpMenu"),
                {at(WhatAmISeeing), at(Keys), kLine, at(About)});
}

void WindowLayout::makeToolBar() {
    auto* bar = new ToolBar(tr("Tools"));
    m_window->addToolBar(bar);
    bar->setObjectName(QStringLiteral("toolBar"));
    bar->setIconSize({kToolIcon, kToolIcon});
    bar->setMovable(false);
    using enum Command;
    auto add = [&](Command command, const QString& label) {
        QAction* action = m_bench.commands->action(command);
        action->setIconText(label);
        bar->addAction(action);
        QWidget* button = bar->widgetForAction(action);
        button->setObjectName(QStringLiteral("tool_") + action->objectName());
        return qobject_cast<QToolButton*>(button);
    };
    add(Open, tr("Open"));
    add(Save, tr("Save"));
    add(Undo, tr("Undo"));
    add(Redo, tr("Redo"));
    bar->addSeparator();
    add(DrawRoute, tr("Draw route"));
    QToolButton* vehicle = add(AddTram, tr("Add vehicle"));
    auto* kinds = new QMenu(vehicle);
    addCommands(kinds, {int(AddTram), int(AddBus), int(AddCar), int(AddSphere), int(AddPerson),
                        int(AddVehicleFile)});
    vehicle->setMenu(kinds);
    vehicle->setPopupMode(QToolButton::InstantPopup);
    add(PlaceProbe, tr("Place probe"));
    QToolButton* reflect = add(MakeItReflect, tr("Make it reflect"));
    QFont bold = reflect->font();
    bold.setBold(true);
    reflect->setFont(bold);
    bar->addSeparator();
    add(Play, tr("Drive"));
    add(Walk, tr("Walk"));
    add(Frame, tr("Frame"));
    add(PlanBeside, tr("Plan"));
    bar->addSeparator();
    add(Compare, tr("Compare"));
    add(CheckReference, tr("Check"));
    bar->addSeparator();
    add(SavePicture, tr("Picture"));
    add(SaveFilm, tr("Film"));
}

void WindowLayout::makeSideBar() {
    auto* bar = new QToolBar(tr("Panels"));
    bar->setObjectName(QStringLiteral("sideBar"));
    bar->setIconSize({kSideIcon, kSideIcon});
    bar->setToolButtonStyle(Qt::ToolButtonIconOnly);
    bar->setMovable(false);
    for (QDockWidget* dock : m_panels) {
        bar->addAction(dock->toggleViewAction());
    }
    m_window->addToolBar(Qt::RightToolBarArea, bar);
}

void WindowLayout::makeStatusBar() {
    auto* chip = new JobChip;
    m_window->statusBar()->addPermanentWidget(chip);
    connect(chip, &JobChip::clicked, this, [this] { showPanel(QStringLiteral("jobsDock")); });
    JobRunner* jobs = m_bench.jobs;
    connect(jobs, &JobRunner::jobsChanged, chip, [this, chip, jobs] {
        const std::vector<JobStatus> running = jobs->jobs();
        chip->setJobs(running);
        std::vector<JobRow> rows;
        for (const JobStatus& job : running) {
            rows.push_back(
                {job.id, job.title, job.phase, job.waiting ? -1.0 : job.fraction, job.cancelling});
        }
        m_bench.jobList->setJobs(rows);
    });
    connect(m_bench.jobList, &JobList::cancelRequested, jobs, &JobRunner::cancel);
}

void WindowLayout::showPanel(const QString& objectName) {
    for (QDockWidget* dock : m_panels) {
        if (dock->objectName() == objectName) {
            dock->show();
            dock->raise();
        }
    }
}

void WindowLayout::save() const {
    QSettings settings;
    settings.setValue(QLatin1String(kGeometryKey), m_window->saveGeometry());
    settings.setValue(QLatin1String(kStateKey), m_window->saveState(kLayoutVersion));
    settings.setValue(QLatin1String(kSplitKey), m_bench.views->saveState());
}

void WindowLayout::restore() {
    const QSettings settings;
    m_window->restoreGeometry(settings.value(QLatin1String(kGeometryKey)).toByteArray());
    m_window->restoreState(settings.value(QLatin1String(kStateKey)).toByteArray(), kLayoutVersion);
    m_bench.views->restoreState(settings.value(QLatin1String(kSplitKey)).toByteArray());
}

void WindowLayout::reset() {
    m_window->restoreState(m_firstState, kLayoutVersion);
    m_bench.plan->hide();
}

}  // namespace reflet
