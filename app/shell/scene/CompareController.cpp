// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/CompareController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/PreparedCity.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <algorithm>
#include <utility>

namespace reflet {
namespace {

constexpr double kEnough = 0.5;     // of a vehicle's bodies, to see what it reflects
constexpr double kFarthest = 60.0;  // metres: a car is then some 50 pixels long

/// The share of the bodies' centres that lie in the picture, near by and before any wall.
double shownShare(const ViewGeometry& view, const HeightfieldTracer& tracer,
                  const PlacedReflector& vehicle) {
    const glm::dvec3 eye = view.camera().position;
    std::size_t shown = 0;
    for (std::size_t i = 0; i < vehicle.poses.size(); ++i) {
        const glm::dvec3 center = vehicle.mapCenter(i);
        const ProjectedPoint point = view.project(center);
        const bool inside = point.depth > 0.0 && point.pixel.x > 0.0 && point.pixel.y > 0.0 &&
                            point.pixel.x < view.width() && point.pixel.y < view.height();
        const HeightfieldHit hit = tracer.trace({eye, center - eye});
        const bool free = !hit.hit || hit.t >= 1.0;
        shown += inside && free && glm::distance(eye, center) < kFarthest ? 1 : 0;
    }
    return double(shown) / double(std::max<std::size_t>(vehicle.poses.size(), 1));
}

/// What a peak signal-to-noise ratio means to the eye; %1 stands for its figure.
QString closeness(double psnr) {
    constexpr double kAlike = 40.0, kClose = 30.0, kFair = 22.0;
    if (psnr >= kAlike)
        return CompareController::tr(
            "The reflections can hardly be told from the ray traced reference (%1 dB).");
    if (psnr >= kClose)
        return CompareController::tr(
            "The reflections come very close to the ray traced reference (%1 dB).");
    if (psnr >= kFair)
        return CompareController::tr(
            "The reflections resemble the ray traced reference (%1 dB): look at edges.");
    return CompareController::tr(
        "The reflections differ from the ray traced reference (%1 dB): more probes may help.");
}

}  // namespace

CompareController::CompareController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    on(Command::Compare, [this](bool compared) { setCompared(compared); });
    on(Command::SwapSides, [this] { swapSides(); });
    on(Command::CheckReference, [this] { checkReference(); });
    connect(bench.tuning, &TuningPanel::methodsChanged, this, &CompareController::chooseMethods);
    connect(bench.tuning, &TuningPanel::measureRequested, this, &CompareController::measure);
    connect(bench.live, &LiveCity::figuresChanged, this, &CompareController::showFigures);
    connect(bench.live, &LiveCity::measuringFailed, this, [this] {
        m_asked = false;
        m_bench.tuning->setMeasuring(false);
        withoutReference();
    });
    connect(bench.viewport, &Viewport::playingChanged, this, [this](bool playing) {
        if (playing) {
            driveGoesOn();
        }
    });
    setMethods(Method::Mem, std::nullopt);
}

void CompareController::setMethods(Method left, std::optional<Method> right) {
    m_left = left;
    m_right = right;
    m_bench.viewport->setMethods(left, right);
    m_bench.tuning->setMethods(left, right);
    m_bench.commands->action(Command::Compare)->setChecked(right.has_value());
    m_bench.commands->action(Command::SwapSides)->setEnabled(right.has_value());
}

void CompareController::chooseMethods(Method left, std::optional<Method> right) {
    const bool hadReference = showsReference();
    if (!hadReference) {
        m_leftBefore = m_left;
        m_rightBefore = m_right;
    }
    setMethods(left, right);
    // The reference is of one pose: the vehicle is held for it.
    if (showsReference() && !hadReference) {
        measure();
    }
}

void CompareController::setCompared(bool compared) {
    if (compared) {
        setMethods(Method::Sky, m_left == Method::Sky ? Method::Mem : m_left);
    } else {
        setMethods(m_right.value_or(Method::Mem) == Method::RayTrace ? Method::Mem
                                                                     : m_right.value_or(m_left),
                   std::nullopt);
    }
}

void CompareController::swapSides() {
    if (m_right) {
        setMethods(*m_right, m_left);
    }
}

void CompareController::checkReference() {
    if (m_bench.document->project().reflectors.empty()) {
        m_bench.notices->tell(Severity::Info,
                              tr("There is no vehicle whose reflections could be checked."), {},
                              tr("Draw a route and add a vehicle."));
        return;
    }
    if (!m_bench.live->prepared() || m_bench.live->traffic()->size() == 0) {
        m_bench.notices->tell(Severity::Info, tr("The city is still being opened."), {},
                              tr("Check again when it is there."));
        return;
    }
    m_asked = true;
    if (showsReference()) {
        measure();
    } else {
        chooseMethods(Method::Mem, Method::RayTrace);
    }
    bringIntoView(measuredReflector());
}

void CompareController::bringIntoView(const std::string& reflector) {
    Viewport& viewport = *m_bench.viewport;
    const LiveCity& live = *m_bench.live;
    const auto index = live.traffic()->find(reflector);
    if (!index || !live.prepared() || viewport.followed() == reflector) {
        return;
    }
    const PlacedReflector placed = live.traffic()->at(*index, viewport.time());
    if (shownShare(viewport.geometry(), live.prepared()->tracer(), placed) < kEnough) {
        viewport.setWalking(false);
        viewport.follow({});
        viewport.setCamera(live.streetCamera(*index, viewport.time()), true);
    }
}

bool CompareController::showsReference() const {
    return m_left == Method::RayTrace || m_right == Method::RayTrace;
}

std::string CompareController::measuredReflector() const {
    const auto selected = m_bench.document->selection()->ids(ProjectItem::Kind::Reflector);
    if (!selected.empty()) {
        return selected.back();
    }
    const auto& all = m_bench.document->project().reflectors;
    return all.empty() ? std::string() : all.front().id;
}

void CompareController::measure() {
    const std::string reflector = measuredReflector();
    if (reflector.empty()) {
        return;
    }
    m_bench.viewport->setPlaying(false);
    m_bench.tuning->setMeasuring(true);
    m_bench.live->measure(m_bench.viewport->time(), reflector,
                          {Method::Sky, Method::Nearest, Method::Blend, Method::Box, Method::Mem});
}

void CompareController::showFigures() {
    const auto figures = m_bench.live->figures();
    const bool asked = std::exchange(m_asked, false);
    m_bench.viewport->setGivenMaps(m_bench.live->referenceMaps());
    m_bench.tuning->setMeasuring(false);
    if (!figures) {
        m_bench.tuning->setFigures({}, {});
        withoutReference();
        return;
    }
    std::vector<MethodRow> rows;
    for (const auto& [method, measured] : figures->methods) {
        MethodRow row;
        row.method = method;
        row.psnr = measured.map.psnr;
        row.ssim = measured.map.ssim;
        row.milliseconds = measured.milliseconds;
        row.quads = std::size_t(measured.quads);
        row.rays = std::size_t(measured.rays);
        row.uncovered = measured.uncoveredShare;
        row.flip = measured.map.flip;
        if (measured.surfaces)
            row.wrongSurface = measured.surfaces->wrong;
        rows.push_back(row);
    }
    m_bench.tuning->setFigures(rows, tr("%1, %2 m along its route")
                                         .arg(QString::fromStdString(figures->reflector))
                                         .arg(figures->station, 0, 'f', 1));
    m_bench.tuning->setFiguresStale(false);
    const auto mem = figures->methods.find(Method::Mem);
    if (asked && mem != figures->methods.end() && mem->second.map.psnr) {
        m_bench.notices->tell(
            Severity::Info, closeness(*mem->second.map.psnr).arg(*mem->second.map.psnr, 0, 'f', 1),
            {}, tr("The panel “Tuning” compares all methods; more dB are better."));
    }
    Q_EMIT checked();
}

void CompareController::withoutReference() {
    if (showsReference() && m_bench.live->referenceMaps().empty())
        setMethods(m_leftBefore, m_rightBefore);
}

void CompareController::driveGoesOn() {
    if (showsReference()) {
        setMethods(m_leftBefore, m_rightBefore);
    }
    m_bench.tuning->setFiguresStale(true);
}

}  // namespace reflet
