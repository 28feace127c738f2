// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/coverage/CoverageController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "widgets/plan/PlanView.h"
#include "widgets/viewport/Viewport.h"

#include <utility>

namespace reflet {

namespace {

constexpr double kSurroundings = 25.0;  // metres around a place that are shown with it
const QString kLane = QStringLiteral("coverage");

}  // namespace

CoverageController::CoverageController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    CoveragePanel* panel = bench.coverage;
    connect(panel, &CoveragePanel::measureRequested, this, &CoverageController::measure);
    connect(panel, &CoveragePanel::cancelRequested, this,
            [this] { m_bench.jobs->cancelLane(kLane); });
    connect(panel, &CoveragePanel::placeActivated, this, &CoverageController::goTo);
    connect(panel, &CoveragePanel::probeActivated, this, [this](const QString& id) {
        m_bench.document->selection()->set({ProjectItem::Kind::Probe, id.toStdString()});
        m_bench.commands->action(Command::Frame)->trigger();
    });
    QAction* map = bench.commands->action(Command::CoverageShown);
    connect(panel, &CoveragePanel::mapToggled, map, [map](bool shown) {
        if (map->isChecked() != shown)
            map->trigger();
    });
    connect(map, &QAction::toggled, this, [this](bool shown) {
        m_bench.coverage->setMapShown(shown);
        showMap();
    });
    connect(map, &QAction::triggered, this, [this](bool shown) {
        if (!shown)
            return;
        Q_EMIT panelWanted();
        if (!m_watch)
            measure();
    });
    connect(bench.commands->action(Command::MeasureCoverage), &QAction::triggered, this, [this] {
        Q_EMIT panelWanted();
        measure();
    });
    connect(bench.document, &ProjectDocument::projectChanged, this,
            &CoverageController::projectChanged);
    connect(bench.live, &LiveCity::cityChanged, this, &CoverageController::updatePossible);
    updatePossible();
}

void CoverageController::updatePossible() {
    const bool possible = m_bench.live->prepared() != nullptr;
    m_bench.coverage->setPossible(possible);
    m_bench.commands->setEnabled({Command::CoverageShown, Command::MeasureCoverage}, possible);
}

void CoverageController::projectChanged(ProjectChanges what) {
    updatePossible();
    if (what & (ProjectChange::Models | ProjectChange::Heightfield)) {
        m_shown.reset();
        m_bench.coverage->setFacts({});
        forget({});
    } else if (what & (ProjectChange::Routes | ProjectChange::Reflectors | ProjectChange::Vehicles |
                       ProjectChange::Views)) {
        forget(m_shown ? tr("Routes, vehicles or views have changed: measure again.") : QString());
    } else if (what & (ProjectChange::Probes | ProjectChange::Bake)) {
        follow();
    }
}

void CoverageController::forget(const QString& why) {
    m_watch.reset();
    m_behind = false;
    m_bench.coverage->setStale(why);
    m_bench.commands->action(Command::CoverageShown)->setChecked(false);
    Q_EMIT outdated();
}

void CoverageController::measure() {
    const auto city = m_bench.live->prepared();
    if (!city)
        return;
    m_measuring = true;
    m_bench.coverage->setMeasuring(true);
    m_bench.jobs->run<MeasuredCoverage>(
        {.title = tr("Measuring coverage"), .lane = kLane},
        [city](const JobContext& job) { return measureCoverage(city, job); }, this,
        [this, city](Result<MeasuredCoverage> measured) {
            if (!measured && measured.error().code == ErrorCode::Cancelled &&
                m_bench.jobs->isBusy(kLane))
                return;  // another measurement took its place
            m_measuring = false;
            m_bench.coverage->setMeasuring(false);
            const auto then = std::exchange(m_then, nullptr);
            if (!measured) {
                m_bench.notices->tell(measured.error());
                if (!m_watch)
                    m_bench.commands->action(Command::CoverageShown)->setChecked(false);
                return;
            }
            m_watch = measured->watch;
            m_bench.coverage->setStale({});
            show(std::move(measured->shown));
            m_bench.commands->action(Command::CoverageShown)->setChecked(true);
            const auto now = m_bench.live->prepared();
            if (now && now->project().probes != city->project().probes)
                follow();
            if (then)
                then();
        });
}

void CoverageController::withWatch(std::function<void()> then) {
    if (m_watch) {
        then();
        return;
    }
    m_then = std::move(then);
    if (!m_measuring)
        measure();
}

void CoverageController::follow() {
    if (!m_watch)
        return;
    if (std::exchange(m_following, true)) {
        m_behind = true;
        return;
    }
    m_behind = false;
    m_bench.jobs->run<ShownCoverage>(
        {.title = tr("Following the probes"),
         .lane = watchLane(),
         .replace = false,
         .visible = false},
        [watch = m_watch, probes = m_bench.document->project().probes](
            const JobContext& /*job*/) -> Result<ShownCoverage> {
            watch->follow(probes);
            return shownCoverage(*watch, probes);
        },
        this,
        [this, watch = m_watch](Result<ShownCoverage> shown) {
            m_following = false;
            if (shown && watch == m_watch) {
                m_bench.coverage->setStale(
                    tr("Followed since it was measured: façades and the picture's own figure come "
                       "with the next measurement."));
                show(std::move(*shown));
            }
            if (m_behind)
                follow();
        });
}

void CoverageController::show(ShownCoverage shown) {
    m_bench.coverage->setFacts(shown.facts);
    m_shown = std::make_shared<const ShownCoverage>(std::move(shown));
    showMap();
}

void CoverageController::setGhosts(std::vector<GhostProbe> ghosts) {
    if (ghosts == m_ghosts)
        return;
    m_ghosts = std::move(ghosts);
    showMap();
}

void CoverageController::showMap() {
    std::shared_ptr<CoverageOverlay> overlay;
    const bool wanted = m_bench.commands->action(Command::CoverageShown)->isChecked();
    if (m_shown && wanted)
        overlay = std::make_shared<CoverageOverlay>(m_shown->overlay);
    if (!m_ghosts.empty()) {
        if (!overlay)
            overlay = std::make_shared<CoverageOverlay>();
        overlay->ghosts = m_ghosts;
    }
    m_bench.viewport->setCoverage(overlay);
    m_bench.plan->setCoverage(overlay);
}

void CoverageController::goTo(const glm::dvec3& place) {
    Box box;
    box.add(place - glm::dvec3(kSurroundings));
    box.add(place + glm::dvec3(kSurroundings));
    m_bench.viewport->frameBox(box);
    m_bench.plan->frameBox(box);
}

}  // namespace reflet
