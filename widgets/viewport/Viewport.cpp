// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/Viewport.h"

#include "core/gpu/GlContext.h"
#include "core/heightfield/BuiltBounds.h"
#include "widgets/common/Look.h"
#include "widgets/viewport/ViewportImpl.h"
#include "widgets/viewport/overlay/Plates.h"

#include <QStyle>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr int kTickMilliseconds = 16;
constexpr double kProbeRoom = 4.0;      // metres around a probe when it is framed
constexpr double kSteepestAll = -0.45;  // at least so much from above when everything is framed
constexpr double kNearPivot = 15.0;     // metres: pivot where the view meets nothing

}  // namespace

Viewport::Impl::Impl(Viewport& widget, EditIntents* given, Drawing where)
    : q(widget), intents(given != nullptr ? given : new EditIntents(&widget)), drawing(where) {
    const bool pixels =
        drawing == Drawing::Headless || (drawing == Drawing::Automatic && drawsInSoftware());
    if (pixels) {
        q.setAttribute(Qt::WA_OpaquePaintEvent);
    } else {
        makeCanvas();
    }
    mark = new ObjectMark(&q);
    labels = new CoverageLabels(&q);
    hud = new Hud(&q);
    wipeBar = new WipeBar(&q);
    problem = new QLabel(&q);
    problem->setObjectName(QStringLiteral("graphicsProblem"));
    problem->setWordWrap(true);
    problem->setAlignment(Qt::AlignCenter);
    problem->setMargin(32);
    problem->setAutoFillBackground(true);
    problem->setTextInteractionFlags(Qt::TextSelectableByMouse);
    problem->hide();
    state.camera = driver.camera();
    motion.setTimerType(Qt::PreciseTimer);
    motion.setInterval(kTickMilliseconds);
    connect(&motion, &QTimer::timeout, &q, [this] { tick(); });
    connect(wipeBar, &WipeBar::moved, &q, [this](double share) {
        state.wipe = float(share);
        post(true);
        Q_EMIT q.wipeMoved(state.wipe);
    });
    connect(hud, &Hud::northWanted, &q, [this] {
        const Heading heading = headingOf(driver.destination());
        leaveFollowing();
        Camera about = driver.destination();
        about.target = middleOfView();
        flyTo(driver.walking()
                  ? turned(about, std::remainder(0.5 * kPi - heading.yaw, 2.0 * kPi), 0.0)
                  : orbited(driver.destination(), about.target,
                            std::remainder(0.5 * kPi - heading.yaw, 2.0 * kPi), 0.0));
    });
}

// ---- What is shown

void Viewport::Impl::post(bool moving) {
    ++(moving ? state.motion : state.touch);
    if (posting) {
        return;
    }
    posting = true;
    QMetaObject::invokeMethod(
        &q,
        [this] {
            posting = false;
            if (source) {
                source->post(state);
            }
        },
        Qt::QueuedConnection);
}

void Viewport::Impl::cityChanged() {
    state.ground = std::make_shared<const Ground>(state.city);
    driver.setGround(state.ground);
}

void Viewport::Impl::placeReflectors(double seconds) {
    reflectors =
        state.traffic ? boxes.boxed(state.traffic->at(seconds)) : std::vector<BoxedReflector>{};
}

double Viewport::Impl::secondsShown() const {
    return shown && state.playing ? shown->seconds : state.seconds;
}

void Viewport::Impl::rebuildOverlays(bool moving) {
    Overlays overlays = state.overlays;
    overlays.probes = probes;
    overlays.routes = routes;
    for (ProbeGlyph& probe : overlays.probes) {
        probe.hovered = hovered && hovered->kind == Picked::Kind::Probe && hovered->id == probe.id;
        if (dragged && dragged->kind == Picked::Kind::Probe && dragged->id == probe.id) {
            probe.position = dragged->point;
        }
    }
    for (RouteGlyph& route : overlays.routes) {
        if (dragged && dragged->kind == Picked::Kind::RouteHandle && dragged->id == route.id &&
            dragged->index < int(route.handles.size())) {
            route.handles[std::size_t(dragged->index)] = dragged->point;
        }
    }
    overlays.cursor = ghost;
    if (!draft.empty()) {
        RouteGlyph drawn{{}, draft, draft, true};
        if (ghost) {
            drawn.line.push_back(*ghost);
        }
        overlays.routes.push_back(drawn);
    }
    if (!(overlays == state.overlays)) {
        state.overlays = std::move(overlays);
        post(moving);
    }
}

void Viewport::Impl::updateHud() {
    QString text = state.right ? QString() : methodText(state.left);
    const auto append = [&text](const QString& part) {
        text += text.isEmpty() ? part : QStringLiteral("  ·  ") + part;
    };
    if (shown && shown->statistics.referenceMissing) {
        append(tr("the reference is not traced yet"));
    }
    const bool reflects = state.traffic && state.traffic->size() > 0;
    const bool asked = needsProbes(state.left) || (state.right && needsProbes(*state.right));
    if (reflects && asked && state.rems.empty()) {
        append(tr("no probe picture yet: vehicles reflect the sky"));
    }
    if (figuresShown && shown) {
        append(tr("%1 ms").arg(shown->statistics.milliseconds, 0, 'f', 0));
        append(tr("%1 fps").arg(shown->framesPerSecond, 0, 'f', 0));
    }
    hud->setCaption(text);
    const ViewGeometry view = q.geometry();
    const double depth = glm::dot(middleOfView() - view.camera().position, view.forward());
    hud->setView(headingOf(view.camera()).yaw, view.metresPerPixel(depth));
    mark->setView(view);
    labels->setView(view, *state.ground);
}

// ---- The camera

glm::dvec3 Viewport::Impl::middleOfView() const {
    const ViewGeometry view = q.geometry();
    const Ray ray = view.ray({0.5 * view.width(), 0.5 * view.height()});
    return state.ground->pointUnder(ray).value_or(ray.at(kNearPivot));
}

void Viewport::Impl::applyCamera(const Camera& camera) {
    driver.jump(camera);
    cameraMoved();
}

void Viewport::Impl::flyTo(const Camera& camera) {
    driver.fly(camera);
    cameraMoved();
    startMotion();
}

void Viewport::Impl::moveTo(const Camera& camera, bool animate) {
    if (animate && q.isVisible()) {
        flyTo(camera);
    } else {
        applyCamera(camera);
    }
}

void Viewport::Impl::cameraMoved() {
    state.camera = driver.camera();
    post(true);
    updateHud();
    Q_EMIT q.cameraChanged();
}

void Viewport::Impl::startMotion() {
    if (driver.moving() && !motion.isActive()) {
        motionClock.start();
        motion.start();
    }
}

void Viewport::Impl::tick() {
    if (driver.tick(double(motionClock.restart()) / 1000.0)) {
        cameraMoved();
    }
    if (!driver.moving()) {
        motion.stop();
    }
}

void Viewport::Impl::leaveFollowing() {
    if (state.followed.empty()) {
        return;
    }
    if (shown) {
        driver.jump(shown->camera);
        state.camera = driver.camera();
    }
    state.followed.clear();
    post(true);
    Q_EMIT q.followedChanged({});
}

// ---- The widget

Viewport::Viewport(EditIntents* intents, QWidget* parent, Drawing drawing)
    : QWidget(parent), m_impl(std::make_unique<Impl>(*this, intents, drawing)) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAccessibleName(tr("City in three dimensions"));
    setReducedMotion(style()->styleHint(QStyle::SH_Widget_Animation_Duration, nullptr, this) == 0);
    m_impl->updateHud();
}

EditIntents& Viewport::intents() const {
    return *m_impl->intents;
}

void Viewport::setCity(std::shared_ptr<const DrawnCity> city) {
    if (city == m_impl->state.city) {
        return;
    }
    m_impl->state.city = std::move(city);
    markObject({}, {});
    m_impl->cityChanged();
    m_impl->post(false);
    m_impl->startMotion();
}

void Viewport::setLighting(const Lighting& lighting) {
    m_impl->state.lighting = lighting;
    ++m_impl->state.lightRevision;
    m_impl->post(true);
}

void Viewport::setAmbient(std::shared_ptr<const AmbientVolume> ambient) {
    if (ambient != m_impl->state.ambient) {
        m_impl->state.ambient = std::move(ambient);
        m_impl->post(false);
    }
}

void Viewport::setRems(const RemSet& rems) {
    if (!(rems == m_impl->state.rems)) {
        m_impl->state.rems = rems;
        m_impl->post(false);
    }
}

void Viewport::setTraffic(std::shared_ptr<const Traffic> traffic) {
    if (traffic == m_impl->state.traffic) {
        return;
    }
    m_impl->state.traffic = std::move(traffic);
    m_impl->boxes.forget();
    m_impl->placeReflectors(m_impl->secondsShown());
    m_impl->post(m_impl->drag != nullptr);
}

void Viewport::setTuning(const MemSettings& tuning) {
    if (!(tuning == m_impl->state.tuning)) {
        m_impl->state.tuning = tuning;
        m_impl->state.framesPerSecond = 1000.0 / tuning.lod.frameBudget;
        m_impl->post(true);
    }
}

void Viewport::setExposure(float exposure) {
    if (exposure != m_impl->state.exposure) {
        m_impl->state.exposure = exposure;
        m_impl->post(true);
    }
}

void Viewport::setMethods(Method left, std::optional<Method> right) {
    if (left == m_impl->state.left && right == m_impl->state.right) {
        return;
    }
    m_impl->state.left = left;
    m_impl->state.right = right;
    if (right) {
        m_impl->wipeBar->setNames(methodText(left), methodText(*right));
    }
    m_impl->wipeBar->setVisible(right.has_value());
    m_impl->updateHud();
    m_impl->post(false);
}

void Viewport::setWipe(float share) {
    m_impl->wipeBar->setShare(double(share));
    const auto clean = float(m_impl->wipeBar->share());
    if (clean != m_impl->state.wipe) {
        m_impl->state.wipe = clean;
        m_impl->post(true);
    }
}

float Viewport::wipe() const {
    return m_impl->state.wipe;
}

void Viewport::setGivenMaps(GivenMaps maps) {
    m_impl->state.given = std::make_shared<const GivenMaps>(std::move(maps));
    m_impl->post(false);
}

void Viewport::setProbes(std::vector<ProbeGlyph> probes) {
    m_impl->probes = std::move(probes);
    m_impl->rebuildOverlays(m_impl->drag != nullptr);
}

void Viewport::setRoutes(std::vector<RouteGlyph> routes) {
    m_impl->routes = std::move(routes);
    m_impl->rebuildOverlays(m_impl->drag != nullptr);
}

void Viewport::setCoverage(std::shared_ptr<const CoverageOverlay> coverage) {
    Impl& d = *m_impl;
    if (coverage == d.state.overlays.coverage) {
        return;
    }
    d.state.overlays.coverage = coverage;
    d.labels->setCoverage(std::move(coverage));
    d.labels->setView(geometry(), *d.state.ground);
    d.post(d.drag != nullptr);
}

void Viewport::setSelectedReflector(std::string id) {
    if (id != m_impl->state.overlays.selectedReflector) {
        m_impl->state.overlays.selectedReflector = std::move(id);
        m_impl->post(false);
    }
}

void Viewport::setHeightfieldShown(bool shown) {
    if (shown != m_impl->state.overlays.heightfield) {
        m_impl->state.overlays.heightfield = shown;
        m_impl->post(false);
    }
}

void Viewport::setCamera(const Camera& camera, bool animate) {
    m_impl->leaveFollowing();
    m_impl->moveTo(camera, animate);
}

Camera Viewport::camera() const {
    const Impl& d = *m_impl;
    return !d.state.followed.empty() && d.shown ? d.shown->camera : d.driver.camera();
}

std::optional<Camera> Viewport::shownCamera() const {
    return m_impl->shown ? std::optional(m_impl->shown->camera) : std::nullopt;
}

ViewGeometry Viewport::geometry() const {
    return {camera(), double(width()), double(height())};
}

void Viewport::frameBox(const Box& box, bool animate) {
    setWalking(false);
    m_impl->leaveFollowing();
    const Camera from = m_impl->driver.destination();
    m_impl->moveTo(framed({from, double(width()), double(height())}, box), animate);
}

void Viewport::markObject(const Box& box, const QString& name) {
    m_impl->mark->setObject(box, name);
    m_impl->mark->setView(geometry());
}

QString Viewport::markedObject() const {
    return m_impl->mark->name();
}

void Viewport::frameAll(bool animate) {
    const auto& city = m_impl->state.city;
    Box all = city && city->heightfield ? builtBounds(*city->heightfield) : Box();
    for (const BoxedReflector& reflector : m_impl->reflectors) {
        all.add(reflector.bounds());
    }
    if (all.empty()) {
        return;
    }
    setWalking(false);
    m_impl->leaveFollowing();
    Heading heading = headingOf(m_impl->driver.destination());
    heading.pitch = std::min(heading.pitch, kSteepestAll);
    const Camera from = seenFrom(m_impl->driver.destination(), heading);
    m_impl->moveTo(framed({from, double(width()), double(height())}, all), animate);
}

void Viewport::frameSelection() {
    Box box;
    for (const ProbeGlyph& probe : m_impl->probes) {
        if (probe.selected) {
            box.add(probe.position - kProbeRoom);
            box.add(probe.position + kProbeRoom);
        }
    }
    for (const RouteGlyph& route : m_impl->routes) {
        for (std::size_t k = 0; route.selected && k < route.line.size(); ++k) {
            box.add(route.line[k]);
        }
    }
    for (const BoxedReflector& reflector : m_impl->reflectors) {
        if (reflector.id == m_impl->state.overlays.selectedReflector) {
            box.add(reflector.bounds());
        }
    }
    if (box.empty()) {
        frameAll();
    } else {
        frameBox(box);
    }
}

void Viewport::setWalking(bool walking) {
    Impl& d = *m_impl;
    if (walking == d.driver.walking()) {
        return;
    }
    d.leaveFollowing();
    d.walkKeys.clear();
    d.driver.setWalking(walking);
    d.cameraMoved();
    d.startMotion();
    d.updateCursor();
    Q_EMIT walkingChanged(walking);
}

bool Viewport::walking() const {
    return m_impl->driver.walking();
}

void Viewport::follow(std::string reflector) {
    Impl& d = *m_impl;
    if (reflector == d.state.followed) {
        return;
    }
    if (reflector.empty()) {
        d.leaveFollowing();
        return;
    }
    setWalking(false);
    d.driver.interrupt();
    d.state.followed = std::move(reflector);
    d.state.followOffset = {};
    d.post(true);
    Q_EMIT followedChanged(QString::fromStdString(d.state.followed));
}

const std::string& Viewport::followed() const {
    return m_impl->state.followed;
}

void Viewport::setReducedMotion(bool reduced) {
    m_impl->driver.setReducedMotion(reduced);
}

// ---- Time, tools, signs

void Viewport::setTool(ViewportTool tool) {
    m_impl->changeTool(tool, true);
}

ViewportTool Viewport::tool() const {
    return m_impl->tool;
}

void Viewport::finishRoute() {
    if (m_impl->draft.size() >= 2) {
        m_impl->changeTool(ViewportTool::Navigate, true);
    }
}

std::size_t Viewport::draftedPoints() const {
    return m_impl->draft.size();
}

void Viewport::setTime(double seconds) {
    Impl& d = *m_impl;
    if (!std::isfinite(seconds) || (!d.state.playing && seconds == d.state.seconds)) {
        return;
    }
    d.state.seconds = seconds;
    ++d.state.clock;
    d.placeReflectors(seconds);
    d.post(true);
    Q_EMIT timeChanged(seconds);
}

double Viewport::time() const {
    return m_impl->secondsShown();
}

void Viewport::setPlaying(bool playing) {
    Impl& d = *m_impl;
    if (playing == d.state.playing) {
        return;
    }
    d.state.seconds = d.secondsShown();
    d.state.playing = playing;
    ++d.state.clock;
    d.post(true);
    Q_EMIT playingChanged(playing);
}

void Viewport::setSpeed(double factor) {
    Impl& d = *m_impl;
    if (!std::isfinite(factor) || factor <= 0.0 || factor == d.state.speed) {
        return;
    }
    d.state.seconds = d.secondsShown();
    d.state.speed = factor;
    ++d.state.clock;
    d.post(false);
}

bool Viewport::playing() const {
    return m_impl->state.playing;
}

void Viewport::setHudShown(bool shown) {
    m_impl->hud->setShown(shown);
}

void Viewport::setFiguresShown(bool shown) {
    m_impl->figuresShown = shown;
    m_impl->updateHud();
}

QSize Viewport::sizeHint() const {
    return {960, 600};
}

QSize Viewport::minimumSizeHint() const {
    return {240, 160};
}

}  // namespace reflet
