// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/PlanView.h"

#include "core/heightfield/BuiltBounds.h"
#include "widgets/common/Look.h"
#include "widgets/coverage/CoverageLegend.h"
#include "widgets/plan/PlanPainter.h"
#include "widgets/plan/PlanViewImpl.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QLocale>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QPointer>
#include <QToolTip>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

constexpr int kLegendMargin = 8;

}  // namespace

PlanView::Impl::Impl(PlanView* owner, EditIntents* given)
    : view(owner),
      intents(given ? given : new EditIntents(owner)),
      drag([this](const glm::dvec3& position, DragPhase phase) { reportDrag(position, phase); }),
      cameraDrag([this](const Camera& camera, DragPhase phase) {
          Q_EMIT view->cameraDragged(camera, phase);
      }) {}

PlanView::Impl::~Impl() = default;

void PlanView::Impl::forgetPicture() {
    ++pictureNumber;
    painter = {};  // stops and waits for the older one: it looks at the token at each row
    picture = nullptr;
    houses.reset();
    pictureWanted = heightfield != nullptr;
    view->update();
}

void PlanView::Impl::startPicture() {
    if (!pictureWanted)
        return;
    pictureWanted = false;
    // The thread is joined before the view is gone, so that only the queued call needs a guard.
    painter = std::jthread([this, field = heightfield, number = pictureNumber,
                            target = QPointer<PlanView>(view)](const std::stop_token& stop) {
        auto painted = paintPlan(*field, stop);
        if (!painted)
            return;
        QMetaObject::invokeMethod(
            view,
            [target, painted, number] {
                if (target)
                    target->m_impl->takePicture(painted, number);
            },
            Qt::QueuedConnection);
    });
}

void PlanView::Impl::takePicture(std::shared_ptr<const PlanPicture> painted, quint64 number) {
    if (number != pictureNumber)
        return;
    picture = std::move(painted);
    ground = {};
    view->update();
    Q_EMIT view->pictureReady();
}

void PlanView::Impl::renderGround() {
    const bool dark = isDark(view->palette());
    const double ratio = view->devicePixelRatioF();
    const QSize wanted = (QSizeF(view->size()) * ratio).toSize();
    const bool same = !ground.isNull() && ground.size() == wanted && groundDark == dark &&
                      groundTransform.center == transform.center &&
                      groundTransform.scale == transform.scale;
    if (same)
        return;
    ground = QPixmap(wanted);
    ground.setDevicePixelRatio(ratio);
    ground.fill(view->palette().color(QPalette::Base));
    groundTransform = transform;
    groundDark = dark;
    QPainter painter2(&ground);
    paintGround(painter2, *picture, transform, view->palette());
}

QString PlanView::Impl::footer() const {
    if (!cursor)
        return crsName;
    const glm::dvec2 p = transform.toFrame(*cursor);
    QLocale locale;
    locale.setNumberOptions(QLocale::OmitGroupSeparator);
    constexpr double kCentimetreScale = 20.0;  // pixels a metre from which decimals mean something
    const int decimals = transform.scale >= kCentimetreScale ? 2 : 1;
    QString text = tr("E %1  N %2")
                       .arg(locale.toString(p.x + origin.x, 'f', decimals),
                            locale.toString(p.y + origin.y, 'f', decimals));
    if (const auto height = knownGround(p.x, p.y))
        text += tr("  ground %1 m").arg(locale.toString(*height + origin.z, 'f', 1));
    if (!crsName.isEmpty())
        text += QStringLiteral("  ·  ") + crsName;
    return text;
}

std::optional<double> PlanView::Impl::knownGround(double x, double y) const {
    if (!heightfield)
        return std::nullopt;
    const float height = heightfield->groundAt(x, y);
    return isMissing(height) ? std::nullopt : std::optional(double(height));
}

glm::dvec3 PlanView::Impl::onGround(const glm::dvec2& p) const {
    return {p.x, p.y, knownGround(p.x, p.y).value_or(0.0)};
}

std::optional<ProjectItem> PlanView::Impl::itemOf(const PlanHit& hit) {
    switch (hit.kind) {
        case PlanHit::Kind::Probe:
            return ProjectItem{ProjectItem::Kind::Probe, hit.id};
        case PlanHit::Kind::Reflector:
            return ProjectItem{ProjectItem::Kind::Reflector, hit.id};
        case PlanHit::Kind::Corner:
        case PlanHit::Kind::Middle:
        case PlanHit::Kind::Route:
            return ProjectItem{ProjectItem::Kind::Route, hit.id};
        default:
            return std::nullopt;
    }
}

PlanView::PlanView(EditIntents* intents, QWidget* parent)
    : QWidget(parent), m_impl(std::make_unique<Impl>(this, intents)) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    m_impl->legend = new CoverageLegend(this);
    m_impl->legend->move(kLegendMargin, kLegendMargin);
    m_impl->legend->hide();
    setAccessibleName(tr("Plan of the city"));
    setAccessibleDescription(
        tr("The city from above. Arrow keys move the view, plus and minus zoom, Home shows all. "
           "With a tool chosen, arrow keys move a cross and Space puts a point."));
}

PlanView::~PlanView() = default;

EditIntents& PlanView::intents() const {
    return *m_impl->intents;
}

void PlanView::setCity(std::shared_ptr<const DrawnCity> city) {
    setHeightfield(city ? city->heightfield : nullptr);
}

void PlanView::setHeightfield(std::shared_ptr<const Heightfield> heightfield) {
    if (m_impl->heightfield == heightfield)
        return;
    const bool first = !m_impl->heightfield;
    m_impl->heightfield = std::move(heightfield);
    m_impl->forgetPicture();
    if (isVisible())
        m_impl->startPicture();
    if (first && !m_impl->framed)
        frameAll();
}

void PlanView::setFrame(const ProjectFrame& frame, const QString& crsName) {
    m_impl->origin = frame.origin;
    m_impl->crsName = crsName;
    update();
}

void PlanView::setProbes(std::vector<ProbeGlyph> probes) {
    if (m_impl->scene.probes == probes)
        return;
    m_impl->scene.probes = std::move(probes);
    update();
}

void PlanView::setRoutes(std::vector<RouteGlyph> routes) {
    if (m_impl->scene.routes == routes)
        return;
    m_impl->scene.routes = std::move(routes);
    const PlanHit& corner = m_impl->scene.chosenCorner;
    const RouteGlyph* route = m_impl->scene.route(corner.id);
    if (!route || !route->selected || corner.index >= int(route->handles.size()))
        m_impl->scene.chosenCorner = {};
    update();
}

void PlanView::setTraffic(std::shared_ptr<const Traffic> traffic) {
    m_impl->scene.traffic = std::move(traffic);
    m_impl->scene.bodyBoxes.clear();
    update();
}

void PlanView::setCoverage(std::shared_ptr<const CoverageOverlay> coverage) {
    if (m_impl->scene.coverage == coverage)
        return;
    m_impl->scene.coverage = std::move(coverage);
    const auto& shown = m_impl->scene.coverage;
    m_impl->legend->setVisible(shown && !(shown->bands.empty() && shown->spots.empty()));
    m_impl->legend->setGhosts(shown && !shown->ghosts.empty());
    if (m_impl->scene.hover.kind == PlanHit::Kind::Ghost)
        m_impl->clearHover();
    update();
}

void PlanView::setTime(double seconds) {
    if (m_impl->scene.time == seconds)
        return;
    m_impl->scene.time = seconds;
    if (m_impl->scene.traffic && m_impl->scene.traffic->size() > 0)
        update();
}

void PlanView::setCamera(const Camera& camera) {
    m_impl->scene.camera = camera;
    update();
}

void PlanView::setSelectedReflector(const std::string& id) {
    m_impl->scene.selectedReflector = id;
    update();
}

void PlanView::setTool(ViewportTool tool) {
    if (m_impl->tool == tool)
        return;
    m_impl->cancelDrag();
    m_impl->tool = tool;
    m_impl->setDraft({});
    m_impl->scene.draftCursor.reset();
    m_impl->scene.keyCursor.reset();
    m_impl->scene.placing = tool == ViewportTool::PlaceProbe;
    m_impl->showCursor();
    update();
}

void PlanView::finishRoute() {
    m_impl->finishRoute();
}

ViewportTool PlanView::tool() const {
    return m_impl->tool;
}

void PlanView::frameAll() {
    m_impl->framed = false;  // and stays all when the widget is resized
    if (isVisible())
        m_impl->fitAll();
}

void PlanView::Impl::fitAll() {
    if (!houses) {
        houses = heightfield ? builtBounds(*heightfield) : Box();
    }
    Box box = *houses;
    if (box.empty()) {
        for (const ProbeGlyph& probe : scene.probes)
            box.add(probe.position);
        for (const RouteGlyph& route : scene.routes)
            for (const glm::dvec3& point : route.line)
                box.add(point);
    }
    transform.fit(box);
    view->update();
}

void PlanView::frameBox(const Box& box) {
    m_impl->transform.fit(box);
    m_impl->framed = true;
    update();
}

QPointF PlanView::toWidget(const glm::dvec3& position) const {
    return m_impl->transform.toWidget(position);
}

glm::dvec3 PlanView::toFrame(const QPointF& point) const {
    return glm::dvec3(m_impl->transform.toFrame(point), 0.0);
}

double PlanView::scale() const {
    return m_impl->transform.scale;
}

double PlanView::groundHeight(double x, double y) const {
    return m_impl->knownGround(x, y).value_or(0.0);
}

QSize PlanView::sizeHint() const {
    return {480, 480};
}

QSize PlanView::minimumSizeHint() const {
    return {160, 120};
}

void PlanView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    if (m_impl->picture) {
        m_impl->renderGround();
        painter.drawPixmap(0, 0, m_impl->ground);
    } else {
        painter.fillRect(rect(), palette().color(QPalette::Base));
        painter.setPen(mutedText(palette()));
        painter.drawText(rect(), Qt::AlignCenter,
                         m_impl->heightfield ? tr("The plan is being drawn …") : tr("No city yet"));
    }
    paintScene(painter, m_impl->scene, m_impl->transform);
    paintFrame(painter, m_impl->transform, m_impl->footer(), palette());
    if (hasFocus()) {
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(palette().color(QPalette::Highlight), 2.0));
        painter.drawRect(rect().adjusted(1, 1, -1, -1));
    }
}

void PlanView::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_impl->startPicture();
    if (!m_impl->framed)
        m_impl->fitAll();
}

void PlanView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    m_impl->transform.size = QSizeF(size());
    if (!m_impl->framed)
        frameAll();
}

bool PlanView::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        auto* help = static_cast<QHelpEvent*>(event);
        const PlanHit hit = hitTest(m_impl->scene, m_impl->transform, help->pos());
        QString text;
        if (const ProbeGlyph* probe = m_impl->scene.probe(hit.id);
            probe && hit.kind == PlanHit::Kind::Probe)
            text = tr("Reflection probe %1, %2")
                       .arg(QString::fromStdString(hit.id), probeStateText(probe->state));
        else if (hit.kind == PlanHit::Kind::Reflector)
            text = tr("Vehicle %1").arg(QString::fromStdString(hit.id));
        else if (hit.kind == PlanHit::Kind::Route)
            text = tr("Route %1").arg(QString::fromStdString(hit.id));
        else if (hit.kind == PlanHit::Kind::Ghost)
            text = tr("A suggested probe: click to accept it");
        else if (hit.kind == PlanHit::Kind::Corner)
            text = tr("Drag to move this corner; Delete removes it");
        else if (hit.kind == PlanHit::Kind::Middle)
            text = tr("Drag to make a corner here");
        else if (hit.kind == PlanHit::Kind::CameraEye)
            text = tr("Where the 3D view stands: drag to go elsewhere");
        else if (hit.kind == PlanHit::Kind::CameraTarget)
            text = tr("Drag to look elsewhere");
        QToolTip::showText(help->globalPos(), text, this);
        return true;
    }
    if (event->type() == QEvent::ShortcutOverride &&
        m_impl->wants(static_cast<QKeyEvent*>(event)->key())) {
        event->accept();  // the window's shortcuts on the same keys wait
        return true;
    }
    if (event->type() == QEvent::NativeGesture) {
        auto* gesture = static_cast<QNativeGestureEvent*>(event);
        if (gesture->gestureType() == Qt::ZoomNativeGesture) {
            m_impl->transform.zoom(1.0 + gesture->value(), gesture->position());
            m_impl->framed = true;
            update();
            return true;
        }
    }
    return QWidget::event(event);
}

}  // namespace reflet
