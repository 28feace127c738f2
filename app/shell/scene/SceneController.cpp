// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/SceneController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/scene/Glyphs.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/ProjectTree.h"
#include "widgets/panels/SunPanel.h"
#include "widgets/panels/Timeline.h"
#include "widgets/plan/PlanView.h"
#include "widgets/preview/MapPreview.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <QMainWindow>
#include <algorithm>
#include <map>

namespace reflet {

SceneController::SceneController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.document, &ProjectDocument::projectChanged, this, &SceneController::showProject);
    connect(bench.document->selection(), &Selection::changed, this,
            &SceneController::showSelection);
    connect(bench.document->undoStack(), &QUndoStack::indexChanged, this,
            &SceneController::updateActions);
    connectLive();
    connectTime();
    connectViewCommands();
    showProject(ProjectChange::All);
    showSelection();
}

void SceneController::connectLive() {
    LiveCity* live = m_bench.live;
    Viewport* viewport = m_bench.viewport;
    connect(live, &LiveCity::cityChanged, this, &SceneController::showCity);
    connect(live, &LiveCity::lightingChanged, this,
            [live, viewport] { viewport->setLighting(live->lighting()); });
    connect(live, &LiveCity::ambientChanged, this,
            [live, viewport] { viewport->setAmbient(live->ambient()); });
    connect(live, &LiveCity::remsChanged, this,
            [live, viewport] { viewport->setRems(live->rems()); });
    connect(live, &LiveCity::trafficChanged, this, &SceneController::showTraffic);
    connect(live, &LiveCity::probeStatesChanged, this, &SceneController::showGlyphs);
    connect(live, &LiveCity::problem, this, [this](const Error& error) {
        // ModelCheck tells of missing files, and offers to locate them.
        const auto& models = m_bench.document->project().models;
        const bool missing =
            std::any_of(models.begin(), models.end(), [&](const ModelReference& model) {
                const auto file = modelPath(model, m_bench.document->folder());
                std::error_code none;
                return file.string() == error.subject && !std::filesystem::exists(file, none);
            });
        if (!missing) {
            m_bench.notices->tell(error);
        }
    });
    connect(live, &LiveCity::remark, this, [this](const Diagnostic& remark) {
        // How the buildings fit the ground is told with what can be done about it, elsewhere.
        if (remark.severity != Severity::Info && remark.code != "ground-fit") {
            m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                                  QString::fromStdString(remark.remedy));
        }
    });
}

void SceneController::connectTime() {
    Viewport* viewport = m_bench.viewport;
    Timeline* timeline = m_bench.timeline;
    connect(viewport, &Viewport::frameDrawn, this, &SceneController::showFrame);
    connect(viewport, &Viewport::timeChanged, timeline, &Timeline::setTime);
    connect(viewport, &Viewport::playingChanged, timeline, &Timeline::setPlaying);
    connect(viewport, &Viewport::playingChanged, this, [this](bool playing) {
        QAction* play = m_bench.commands->action(Command::Play);
        play->setChecked(playing);
    });
    connect(timeline, &Timeline::playingChanged, viewport, &Viewport::setPlaying);
    connect(timeline, &Timeline::timeChanged, viewport, [viewport](double seconds, DragPhase) {
        viewport->setPlaying(false);
        viewport->setTime(seconds);
    });
    connect(timeline, &Timeline::speedChanged, viewport, &Viewport::setSpeed);
    connect(viewport, &Viewport::timeChanged, m_bench.plan, &PlanView::setTime);
    connect(viewport, &Viewport::cameraChanged, this,
            [this, viewport] { m_bench.plan->setCamera(viewport->camera()); });
}

void SceneController::connectViewCommands() {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    Viewport* viewport = m_bench.viewport;
    on(Command::Play, [viewport](bool play) { viewport->setPlaying(play); });
    on(Command::Frame, [this, viewport] {
        const auto& document = *m_bench.document;
        const Box box = boxOf(document.project(), document.selection()->items());
        box.empty() ? viewport->frameSelection() : viewport->frameBox(box);
    });
    on(Command::FrameAll, [viewport] { viewport->frameAll(); });
    on(Command::Walk, [viewport](bool walk) { viewport->setWalking(walk); });
    on(Command::Follow, [this, viewport](bool follow) {
        const auto selected = m_bench.document->selection()->ids(ProjectItem::Kind::Reflector);
        const auto& all = m_bench.document->project().reflectors;
        std::string id = selected.empty() ? std::string() : selected.back();
        if (id.empty() && !all.empty()) {
            id = all.front().id;
        }
        viewport->follow(follow ? id : std::string());
    });
    on(Command::HeightfieldShown, [viewport](bool shown) { viewport->setHeightfieldShown(shown); });
    on(Command::PreviewSphere, [this] { showGlyphs(); });
    connect(m_bench.inspector, &Inspector::previewToggled, this, &SceneController::showSpheres);
    on(Command::PlanBeside, [this](bool shown) { m_bench.plan->setVisible(shown); });
    connect(viewport, &Viewport::walkingChanged, m_bench.commands->action(Command::Walk),
            &QAction::setChecked);
    connect(viewport, &Viewport::followedChanged, this, [this](const QString& reflector) {
        m_bench.commands->action(Command::Follow)->setChecked(!reflector.isEmpty());
    });
    auto frame = [this, viewport](const ProjectItem& item) {
        const Box box = boxOf(m_bench.document->project(), {item});
        if (!box.empty()) {
            viewport->frameBox(box);
        }
    };
    connect(m_bench.tree, &ProjectTree::frameRequested, this, frame);
    connect(m_bench.plan, &PlanView::activated, this, frame);
    connect(m_bench.plan, &PlanView::cameraDragged, this,
            [viewport](const Camera& camera, DragPhase) {
                viewport->setWalking(false);
                viewport->follow({});
                viewport->setCamera(camera, false);
            });
}

void SceneController::showSpheres(const std::vector<std::string>& probes, bool shown) {
    for (const std::string& id : probes) {
        shown ? void(m_spheres.insert(id)) : void(m_spheres.erase(id));
    }
    // The command shows those of whatever is selected: these are, and shall not be shown.
    if (!shown) {
        m_bench.commands->action(Command::PreviewSphere)->setChecked(false);
    }
    showGlyphs();
}

void SceneController::showProject(ProjectChanges what) {
    const Project& project = m_bench.document->project();
    Viewport* viewport = m_bench.viewport;
    m_bench.tree->setProject(project);
    const QString crs = QString::fromStdString(project.frame.crs.value_or(""));
    m_bench.inspector->setProject(project, crs);
    if (what & ProjectChange::Models) {
        m_bench.plan->setFrame(project.frame, crs);
    }
    if (what & ProjectChange::Tuning) {
        viewport->setTuning(project.tuning);
        m_bench.tuning->setTuning(project.tuning);
    }
    if (what & ProjectChange::Bake) {
        m_bench.tuning->setBake(project.bake);
    }
    if (what & ProjectChange::Exposure) {
        viewport->setExposure(project.exposure);
        m_bench.preview->setExposure(project.exposure);
        m_bench.sun->setExposure(project.exposure);
    }
    if (what & ProjectChange::Light) {
        m_bench.sun->setDate(project.date);
        m_bench.sun->setTurbidity(project.turbidity);
    }
    if (what & (ProjectChange::Probes | ProjectChange::Routes | ProjectChange::Models)) {
        showGlyphs();
    }
    updateActions();
}

void SceneController::showGlyphs() {
    const ProjectDocument& document = *m_bench.document;
    const Project& project = document.project();
    LiveCity* live = m_bench.live;
    const bool preview = m_bench.commands->action(Command::PreviewSphere)->isChecked();
    auto probes = probeGlyphs(
        project, *document.selection(),
        [live](const std::string& id) { return live->probeState(id); }, preview);
    for (ProbeGlyph& glyph : probes) {
        glyph.preview = glyph.preview || m_spheres.count(glyph.id) > 0;
    }
    std::map<std::string, ProbeState> states;
    std::map<std::string, ProbeFacts> facts;
    for (const ProbeGlyph& glyph : probes) {
        states[glyph.id] = glyph.state;
        ProbeFacts& fact = facts[glyph.id];
        fact.state = glyph.state;
        fact.problem = live->probeProblem(glyph.id);
        fact.preview = glyph.preview;
        if (const auto ground = live->groundHeight(glyph.position.x, glyph.position.y)) {
            fact.groundHeight = *ground + project.frame.origin.z;
        }
    }
    m_bench.inspector->setProbeFacts(std::move(facts));
    m_bench.tree->setProbeStates(std::move(states));
    auto routes = routeGlyphs(project, *document.selection());
    m_bench.plan->setProbes(probes);
    m_bench.plan->setRoutes(routes);
    if (!m_glyphsShown) {
        probes.clear();
        routes.clear();
    }
    m_bench.viewport->setProbes(std::move(probes));
    m_bench.viewport->setRoutes(std::move(routes));
}

void SceneController::setGlyphsShown(bool shown) {
    m_glyphsShown = shown;
    showGlyphs();
}

void SceneController::showSelection() {
    const Selection& selection = *m_bench.document->selection();
    m_bench.tree->setSelection(selection.items());
    m_bench.inspector->setSelection(selection.items());
    const auto reflectors = selection.ids(ProjectItem::Kind::Reflector);
    const std::string reflector = reflectors.empty() ? std::string() : reflectors.back();
    m_bench.viewport->setSelectedReflector(reflector);
    m_bench.plan->setSelectedReflector(reflector);
    showGlyphs();
    updateActions();
}

void SceneController::showCity() {
    const auto city = m_bench.live->city();
    m_bench.viewport->setCity(city);
    m_awaitsPicture = city && m_bench.viewport->isVisible();
    if (m_awaitsPicture) {
        m_bench.live->holdWork();
    }
    m_bench.plan->setCity(city);
    m_bench.plan->setHeightfield(city ? city->heightfield : nullptr);
    if (city) {
        const auto place =
            geoPosition(m_bench.document->project().frame, city->model->bounds().center());
        m_bench.sun->setPlace(place ? std::optional<GeoPosition>(*place) : std::nullopt);
        if (m_frameNextCity) {
            m_frameNextCity = false;
            m_bench.plan->frameAll();
        }
    }
}

void SceneController::showTraffic() {
    const auto traffic = m_bench.live->traffic();
    m_bench.viewport->setTraffic(traffic);
    m_bench.plan->setTraffic(traffic);
    m_bench.timeline->setDuration(traffic ? traffic->duration() : 0.0);
}

void SceneController::showFrame(const FrameStatistics& statistics, double framesPerSecond) {
    m_bench.tuning->setFrame(statistics, framesPerSecond);
    if (m_awaitsPicture && statistics.triangles > 0) {
        m_awaitsPicture = false;
        m_bench.live->letWorkGoOn();
    }
}

void SceneController::updateActions() {
    const ProjectDocument& document = *m_bench.document;
    const Commands& commands = *m_bench.commands;
    QUndoStack* stack = m_bench.document->undoStack();
    QAction* undo = commands.action(Command::Undo);
    undo->setEnabled(stack->canUndo());
    undo->setText(stack->canUndo() ? tr("&Undo: %1").arg(stack->undoText()) : tr("&Undo"));
    undo->setIconText(tr("Undo"));
    QAction* redo = commands.action(Command::Redo);
    redo->setEnabled(stack->canRedo());
    redo->setText(stack->canRedo() ? tr("&Redo: %1").arg(stack->redoText()) : tr("&Redo"));
    redo->setIconText(tr("Redo"));

    const bool selected = !document.selection()->isEmpty();
    m_bench.commands->setEnabled({Command::Delete, Command::Duplicate}, selected);
    const Project& project = document.project();
    m_bench.commands->setEnabled({Command::MakeItReflect}, !project.routes.empty());
    m_bench.commands->setEnabled({Command::Follow, Command::CheckReference},
                                 !project.reflectors.empty());
    m_bench.commands->setEnabled({Command::BakeNow}, !project.probes.empty());
    m_bench.commands->setEnabled(
        {Command::AddCity, Command::PlaceModel, Command::DrawRoute, Command::PlaceProbe,
         Command::SavePicture, Command::SaveFilm, Command::FrameAll},
        !project.models.empty());
}

}  // namespace reflet
