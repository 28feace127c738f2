// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/ReflectController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Render.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/plan/PlanView.h"
#include "widgets/viewport/Viewport.h"

#include <algorithm>

namespace reflet {
namespace {

constexpr double kRunUp = 4.0;      // seconds of the drive before the vehicle stands in the picture
constexpr double kPassage = 4.0;    // seconds after it: it has left the picture
constexpr double kPoorSight = 0.2;  // of streetSight()
constexpr double kTouched = 1.0;    // metres: less comes from the ground

}  // namespace

ReflectController::ReflectController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    LiveCity* live = bench.live;
    on(Command::MakeItReflect, [this] { makeItReflect(); });
    on(Command::BakeNow, [live] { live->bakeNow(); });
    on(Command::CancelBaking, [live] { live->cancelBaking(); });
    on(Command::AutoBake, [live](bool automatic) { live->setAutoBake(automatic); });
    bench.commands->action(Command::AutoBake)->setChecked(live->autoBake());
    connect(bench.inspector, &Inspector::bakeRequested, live, [live] { live->bakeNow(); });
    connect(live, &LiveCity::bakingChanged, this, &ReflectController::updateBaking);
    connect(live, &LiveCity::probeStatesChanged, this, &ReflectController::offerFreePlaces);
    connect(live, &LiveCity::trafficChanged, this, &ReflectController::showFromPavement);
    connect(bench.viewport, &Viewport::timeChanged, this, &ReflectController::watch);
    updateBaking();
}

void ReflectController::updateBaking() {
    m_bench.commands->setEnabled({Command::CancelBaking}, m_bench.live->baking());
}

void ReflectController::offerFreePlaces() {
    for (const Probe& probe : m_bench.document->project().probes) {
        const QString problem = m_bench.live->probeProblem(probe.id);
        const auto place = m_bench.live->freePlace(probe.id);
        if (problem.isEmpty()) {
            m_refused.erase(probe.id);
            continue;
        }
        if (!place || !m_refused.insert(probe.id).second) {
            continue;
        }
        m_bench.notices->tell(Severity::Warning,
                              tr("%1: %2").arg(QString::fromStdString(probe.id), problem),
                              {{tr("Move it to the nearest free place"), [this, id = probe.id] {
                                    // Where it is free may have changed since.
                                    if (const auto free = m_bench.live->freePlace(id)) {
                                        m_bench.document->moveProbe(id, *free);
                                    }
                                }}});
    }
}

const RouteSpec* ReflectController::chosenRoute() const {
    const auto& routes = m_bench.document->project().routes;
    const auto selected = m_bench.document->selection()->ids(ProjectItem::Kind::Route);
    for (const RouteSpec& route : routes) {
        if (!selected.empty() && route.id == selected.back()) {
            return &route;
        }
    }
    return routes.empty() ? nullptr : &routes.back();
}

void ReflectController::makeItReflect() {
    m_bench.viewport->finishRoute();
    m_bench.plan->finishRoute();
    const RouteSpec* route = chosenRoute();
    const auto prepared = m_bench.live->prepared();
    if (!route || !prepared) {
        m_bench.notices->tell(Severity::Info, tr("First a street to drive along is needed."),
                              {{tr("Draw a route"), [this] {
                                    m_bench.commands->action(Command::DrawRoute)->trigger();
                                }}});
        return;
    }
    const int step = m_bench.document->undoStack()->index();
    m_bench.jobs->run<ReflectResult>(
        {.title = tr("Making it reflect"), .lane = QStringLiteral("makeItReflect")},
        [prepared, spec = *route](const JobContext& job) {
            return reflet::makeItReflect(*prepared, spec, {}, job);
        },
        this,
        [this, step](const Result<ReflectResult>& result) {
            if (!result) {
                m_bench.notices->tell(result.error());
            } else if (m_bench.document->undoStack()->index() != step) {
                makeItReflect();  // the project was changed meanwhile
            } else {
                adopt(*result);
            }
        });
}

void ReflectController::adopt(const ReflectResult& result) {
    m_toShow = result.reflector;
    m_bench.document->replaceProject(result.project, tr("Make it reflect"));
    m_bench.document->selection()->clear();
    for (const Diagnostic& remark : result.remarks) {
        m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                              QString::fromStdString(remark.remedy));
    }
    showFromPavement();
    Q_EMIT reflects();
}

void ReflectController::showFromPavement() {
    const auto traffic = m_bench.live->traffic();
    if (m_toShow.empty() || !traffic) {
        return;
    }
    const auto index = traffic->find(m_toShow);
    if (!index) {
        return;
    }
    m_toShow.clear();
    const auto& views = m_bench.document->project().views;
    const auto view = std::find_if(views.begin(), views.end(), [&](const View& v) {
        return v.name == traffic->drive(*index).id;
    });
    const auto city = m_bench.live->prepared();
    if (view == views.end() || !city) {
        return;
    }
    Viewport& viewport = *m_bench.viewport;
    const Camera camera = cameraOf(*view, m_bench.document->project().frame);
    viewport.setWalking(false);
    viewport.follow({});
    viewport.setTime(std::max(0.0, view->time - kRunUp));
    viewport.setCamera(camera, true);
    viewport.setPlaying(true);
    m_watch = Watch{traffic->drive(*index).id, camera, view->time + kPassage};
    if (streetSight(*city, traffic->at(*index, view->time), camera.position) < kPoorSight) {
        goAlong();  // between walls: from nowhere on foot would it be seen
    }
}

void ReflectController::goAlong() {
    m_bench.viewport->follow(m_watch->reflector);
    m_watch.reset();
}

void ReflectController::watch(double seconds) {
    if (!m_watch || seconds < m_watch->until) {
        return;
    }
    const Viewport& viewport = *m_bench.viewport;
    const Camera camera = viewport.camera();
    const bool untouched = viewport.playing() && !viewport.walking() &&
                           viewport.followed().empty() &&
                           glm::distance(camera.position, m_watch->camera.position) < kTouched &&
                           glm::distance(camera.target, m_watch->camera.target) < kTouched;
    if (untouched) {
        goAlong();
    }
    m_watch.reset();
}

}  // namespace reflet
