// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/MainWindow.h"

#include "app/document/Autosave.h"
#include "app/document/LiveCity.h"
#include "app/document/Recovery.h"
#include "app/shell/Commands.h"
#include "app/shell/Icons.h"
#include "app/shell/KeyGuard.h"
#include "app/shell/Notices.h"
#include "app/shell/Theme.h"
#include "app/shell/WindowLayout.h"
#include "app/shell/coverage/CoverageController.h"
#include "app/shell/coverage/DriveWatch.h"
#include "app/shell/coverage/SuggestController.h"
#include "app/shell/files/FileController.h"
#include "app/shell/files/ModelCheck.h"
#include "app/shell/files/PlaceController.h"
#include "app/shell/files/ReportController.h"
#include "app/shell/files/UpdateController.h"
#include "app/shell/overlays/Help.h"
#include "app/shell/overlays/Stage.h"
#include "app/shell/pictures/PictureController.h"
#include "app/shell/scene/CompareController.h"
#include "app/shell/scene/EditController.h"
#include "app/shell/scene/OpeningView.h"
#include "app/shell/scene/PreviewController.h"
#include "app/shell/scene/ReflectController.h"
#include "app/shell/scene/SceneController.h"
#include "app/shell/tour/TourController.h"
#include "app/shell/vehicles/VehicleController.h"
#include "widgets/viewport/Viewport.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDropEvent>
#include <QMenu>
#include <QMimeData>
#include <QStatusBar>

namespace reflet {
namespace {

constexpr QSize kFirstSize(1440, 900);
constexpr int kShutdownMilliseconds = 5000;

QStringList localFiles(const QMimeData& data) {
    QStringList files;
    for (const QUrl& url : data.urls()) {
        if (url.isLocalFile()) {
            files << url.toLocalFile();
        }
    }
    return files;
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("mainWindow"));
    setAcceptDrops(true);
    resize(kFirstSize);
    m_bench.window = this;
    m_bench.document = &m_document;
    m_bench.jobs = &m_jobs;
    m_bench.live = new LiveCity(m_document, m_jobs, this);
    m_bench.commands = new Commands(this);
    m_layout = new WindowLayout(m_bench, this);
    m_layout->setUndoStack(m_document.undoStack());
    m_files = new FileController(m_bench, m_layout->recentMenu(), this);
    new ModelCheck(m_bench, this);
    new PlaceController(m_bench, this);
    auto* update = new UpdateController(m_bench, this);
    auto* report = new ReportController(m_bench, this);
    connect(m_files, &FileController::imported, report, &ReportController::tellNextCity);
    connect(update, &UpdateController::updated, report, &ReportController::tellNextCity);
    connect(report, &ReportController::panelWanted, m_layout,
            [this] { m_layout->showPanel(QStringLiteral("remarksDock")); });
    m_scene = new SceneController(m_bench, this);
    m_openingView = new OpeningView(m_bench, this);
    connect(m_files, &FileController::opened, m_openingView, &OpeningView::projectOpened);
    m_edit = new EditController(m_bench, this);
    auto* vehicles = new VehicleController(m_bench, *m_edit, this);
    connect(m_files, &FileController::vehicleDropped, vehicles, &VehicleController::bringIn);
    auto* coverage = new CoverageController(m_bench, this);
    connect(coverage, &CoverageController::panelWanted, m_layout,
            [this] { m_layout->showPanel(QStringLiteral("coverageDock")); });
    auto* suggest = new SuggestController(m_bench, *coverage, this);
    new DriveWatch(m_bench, *suggest, this);
    connect(m_edit, &EditController::groundMenuOpens, suggest, &SuggestController::extendMenu);
    m_compare = new CompareController(m_bench, this);
    new PreviewController(m_bench, this);
    m_reflect = new ReflectController(m_bench, this);
    m_tour = new TourController(m_bench, {m_files, m_edit, m_compare, m_reflect, m_scene}, this);
    m_pictures = new PictureController(m_bench, *m_compare, m_layout->viewsMenu(), this);
    connect(m_pictures, &PictureController::savedSomething, m_tour,
            &TourController::savedSomething);
    m_autosave = new Autosave(m_document, {}, this);
    connect(m_autosave, &Autosave::failed, this,
            [this](const Error& error) { m_bench.notices->tell(error); });
    connect(m_files, &FileController::opened, m_scene, &SceneController::frameNextCity);
    connect(m_bench.viewport, &Viewport::graphicsProblem, m_bench.stage, &Stage::showProblem);
    connect(m_files, &FileController::opened, this, &MainWindow::showTitle);
    connect(&m_document, &ProjectDocument::fileChanged, this, &MainWindow::showTitle);
    connect(m_document.undoStack(), &QUndoStack::cleanChanged, this, &MainWindow::showTitle);
    connect(&m_document, &ProjectDocument::projectChanged, this, &MainWindow::showTitle);
    connectWindowCommands();
    makeThemeMenu();
    qApp->installEventFilter(new KeyGuard(this));
    m_layout->restore();
    showTitle();
    statusBar()->setSizeGripEnabled(false);
}

MainWindow::~MainWindow() {
    m_jobs.cancelAll();
    m_jobs.wait(kShutdownMilliseconds);
}

void MainWindow::connectWindowCommands() {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    on(Command::Quit, [this] { close(); });
    on(Command::ResetLayout, [this] { m_layout->reset(); });
    on(Command::FullScreen, [this](bool full) { full ? showFullScreen() : showNormal(); });
    on(Command::Keys, [this] { showKeys(*m_bench.commands, this); });
    on(Command::About, [this] { showAbout(this); });
    on(Command::WhatAmISeeing, [this] { showExplanation(this); });
}

void MainWindow::makeThemeMenu() {
    auto* menu = findChild<QMenu*>(QStringLiteral("themeMenu"));
    auto* group = new QActionGroup(this);
    const std::pair<ThemeChoice, QString> choices[] = {
        {ThemeChoice::System, tr("As the &desktop")},
        {ThemeChoice::Light, tr("&Light")},
        {ThemeChoice::Dark, tr("&Dark")},
    };
    for (const auto& [choice, text] : choices) {
        QAction* action = menu->addAction(text);
        action->setCheckable(true);
        action->setChecked(choice == savedTheme());
        group->addAction(action);
        connect(action, &QAction::triggered, this, [choice = choice] {
            saveTheme(choice);
            applyTheme(*qApp, choice);
        });
    }
}

void MainWindow::start(const StartOptions& options) {
    m_files->setSampleFolder(options.samples);
    if (options.files.isEmpty()) {
        m_files->openSample(QStringLiteral("square"));
    } else {
        m_files->openPaths(options.files);
    }
    offerRecovery();
}

void MainWindow::offerRecovery() {
    for (const RecoverableProject& found : Recovery().list()) {
        const QString name = QString::fromStdString(found.name);
        m_bench.notices->tell(Severity::Warning,
                              tr("Reflet ended without saving “%1” (%2).")
                                  .arg(name, locale().toString(found.time, QLocale::ShortFormat)),
                              {{tr("Bring it back"),
                                [this, found] {
                                    m_files->guardUnsaved([this, found] {
                                        if (const auto back = Recovery().recover(found, m_document);
                                            !back) {
                                            m_bench.notices->tell(back.error());
                                            return;
                                        }
                                        // The autosave of this window keeps it from now on.
                                        if (m_autosave->saveNow()) {
                                            Recovery().discard(found);
                                        }
                                        m_files->noteOpened();
                                    });
                                }},
                               {tr("Throw it away"), [found] { Recovery().discard(found); }}});
    }
}

void MainWindow::showTitle() {
    const auto file = m_document.file();
    QString name = file.empty() ? QString::fromStdString(m_document.project().name)
                                : QString::fromStdString(file.stem().string());
    if (m_document.project().models.empty() && file.empty()) {
        setWindowTitle(QStringLiteral("Reflet"));
        return;
    }
    if (m_files && m_files->showsDemo()) {
        name = tr("%1 (sample)").arg(name);
    } else if (m_document.isReadOnly()) {
        name = tr("%1 (to look at)").arg(name);
    }
    setWindowTitle(QStringLiteral("%1[*] – Reflet").arg(name));
    setWindowModified(m_document.isDirty());
    setWindowFilePath(QString::fromStdString(file.string()));
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (m_document.isDirty() && !m_mayClose) {
        event->ignore();
        m_files->guardUnsaved([this] {
            m_mayClose = true;
            close();
        });
        return;
    }
    m_layout->save();
    m_openingView->remember();
    m_jobs.cancelAll();
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (!localFiles(*event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
        m_hintBeforeDrag = m_bench.stage->hint();
        m_bench.stage->setHint(tr("Drop a city, a project or a vehicle"));
    }
}

void MainWindow::dragLeaveEvent(QDragLeaveEvent* /*event*/) {
    m_bench.stage->setHint(m_hintBeforeDrag);
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QStringList files = localFiles(*event->mimeData());
    m_bench.stage->setHint(m_hintBeforeDrag);
    if (!files.isEmpty()) {
        event->acceptProposedAction();
        m_files->openPaths(files);
    }
}

void MainWindow::changeEvent(QEvent* event) {
    if (event->type() == QEvent::WindowStateChange && m_bench.commands) {
        m_bench.commands->action(Command::FullScreen)->setChecked(isFullScreen());
    }
    QMainWindow::changeEvent(event);
}

}  // namespace reflet
