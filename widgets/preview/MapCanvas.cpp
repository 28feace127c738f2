// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/preview/MapCanvas.h"

#include "widgets/common/Look.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QPointer>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kMargin = 0.96;
constexpr double kZoomANotch = 1.25;
constexpr double kNotch = 120.0;
constexpr double kMostTexelPixels = 64.0;
constexpr double kKeyPan = 40.0;

}  // namespace

MapCanvas::MapCanvas(QWidget* parent) : QWidget(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setToolTip(tr("Wheel: zoom to single texels; drag: move; double click or Home: all of it"));
    setAccessibleName(tr("Environment map"));
}

MapCanvas::~MapCanvas() = default;

void MapCanvas::setSource(MapSource source) {
    const bool sameSize = m_source.radiance && source.radiance &&
                          m_source.radiance->resolution() == source.radiance->resolution();
    m_source = std::move(source);
    if (!sameSize) {
        m_zoom = 1.0;
        m_shift = {};
    }
    repaintMap();
}

void MapCanvas::setExposure(float exposure) {
    if (m_exposure == exposure)
        return;
    m_exposure = exposure;
    if (m_quantity == MapQuantity::Radiance)
        repaintMap();
}

void MapCanvas::setProjection(MapProjection projection) {
    if (m_projection == projection)
        return;
    m_projection = projection;
    m_zoom = 1.0;
    m_shift = {};
    m_image = {};
    repaintMap();
}

void MapCanvas::setQuantity(MapQuantity quantity) {
    if (m_quantity == quantity)
        return;
    m_quantity = quantity;
    repaintMap();
}

/// On a thread of its own; the older picture stays until the new one is there.
void MapCanvas::repaintMap() {
    const quint64 number = ++m_number;
    m_painter = {};
    if (!m_source.radiance) {
        m_image = {};
        update();
        return;
    }
    m_painter = std::jthread([this, number, source = m_source, projection = m_projection,
                              quantity = m_quantity, exposure = m_exposure,
                              target = QPointer<MapCanvas>(this)](const std::stop_token& stop) {
        QImage image = paintMap(source, projection, quantity, exposure, stop);
        if (image.isNull())
            return;
        QMetaObject::invokeMethod(
            this,
            [target, image, number] {
                if (!target || target->m_number != number)
                    return;
                target->m_image = image;
                target->update();
                Q_EMIT target->painted();
            },
            Qt::QueuedConnection);
    });
}

QSizeF MapCanvas::pictureSize() const {
    if (!m_image.isNull())
        return QSizeF(m_image.size());
    return {4.0, 3.0};
}

double MapCanvas::fittedScale() const {
    const QSizeF size = pictureSize();
    return kMargin * std::min(width() / size.width(), height() / size.height());
}

QRectF MapCanvas::target() const {
    const QSizeF size = pictureSize() * (fittedScale() * m_zoom);
    const QPointF middle = QPointF(0.5 * width(), 0.5 * height()) + m_shift;
    return {middle - QPointF(0.5 * size.width(), 0.5 * size.height()), size};
}

void MapCanvas::zoom(double factor, const QPointF& point) {
    const double most = std::max(1.0, kMostTexelPixels / fittedScale());
    const double next = std::clamp(m_zoom * factor, 1.0, most);
    const QPointF middle = QPointF(0.5 * width(), 0.5 * height()) + m_shift;
    m_shift += (point - middle) * (1.0 - next / m_zoom);
    m_zoom = next;
    if (m_zoom == 1.0)
        m_shift = {};
    update();
}

std::optional<std::pair<Texel, glm::dvec3>> MapCanvas::at(const QPointF& point) const {
    if (m_image.isNull() || !m_source.radiance)
        return std::nullopt;
    const QRectF rect = target();
    const double x = (point.x() - rect.left()) / rect.width();
    const double y = (point.y() - rect.top()) / rect.height();
    const int n = m_source.radiance->resolution();
    if (m_projection == MapProjection::Sphere) {
        const auto direction = ballDirection(2.0 * x - 1.0, 1.0 - 2.0 * y);
        if (!direction)
            return std::nullopt;
        return std::pair(texelAt(n, *direction), *direction);
    }
    const auto texel = crossTexel(n, {int(std::floor(x * 4.0 * n)), int(std::floor(y * 3.0 * n))});
    if (!texel)
        return std::nullopt;
    return std::pair(*texel, texelDirection(n, texel->face, texel->column, texel->row));
}

void MapCanvas::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (m_image.isNull()) {
        painter.setPen(mutedText(palette()));
        painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                         m_source.radiance ? tr("being drawn …")
                                           : tr("Select a reflection probe that is baked, or a "
                                                "vehicle, to see what it sees."));
        return;
    }
    const QRectF where = target();
    const double scale = where.width() / m_image.width() * devicePixelRatioF();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, scale < 1.0);
    painter.drawImage(where, m_image);
    if (m_projection == MapProjection::Cross)
        paintFaceNames(painter, where);
}

void MapCanvas::paintFaceNames(QPainter& painter, const QRectF& rect) const {
    painter.setRenderHint(QPainter::Antialiasing);
    const double face = rect.width() / 4.0;
    for (int i = 0; i < 6; ++i) {
        const CrossFace& place = crossFaces()[std::size_t(i)];
        const QRectF square(rect.left() + place.column * face, rect.top() + place.row * face, face,
                            face);
        painter.setPen(QPen(QColor(255, 255, 255, 90), 1.0));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(square);
        QPainterPath path;
        path.addText(square.topLeft() + QPointF(5.0, fontMetrics().ascent() + 3.0), font(),
                     faceName(i));
        painter.setPen(QPen(QColor(0, 0, 0, 170), 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPath(path);
        painter.fillPath(path, Qt::white);
    }
}

void MapCanvas::point(const QPointF& position) {
    if (const auto found = at(position))
        Q_EMIT pointed(true, found->first, found->second);
    else
        Q_EMIT pointed(false, Texel{}, glm::dvec3(0.0, 1.0, 0.0));
}

void MapCanvas::wheelEvent(QWheelEvent* event) {
    zoom(std::pow(kZoomANotch, event->angleDelta().y() / kNotch), event->position());
    point(event->position());
    event->accept();
}

void MapCanvas::mousePressEvent(QMouseEvent* event) {
    m_last = event->position();
}

void MapCanvas::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & (Qt::LeftButton | Qt::MiddleButton)) {
        if (m_zoom > 1.0)
            m_shift += event->position() - m_last;
        m_last = event->position();
        update();
    }
    point(event->position());
}

void MapCanvas::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
    m_zoom = 1.0;
    m_shift = {};
    update();
}

void MapCanvas::keyPressEvent(QKeyEvent* event) {
    const QPointF middle(0.5 * width(), 0.5 * height());
    switch (event->key()) {
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            zoom(kZoomANotch, middle);
            return;
        case Qt::Key_Minus:
            zoom(1.0 / kZoomANotch, middle);
            return;
        case Qt::Key_Home:
            mouseDoubleClickEvent(nullptr);
            return;
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
            if (m_zoom > 1.0) {
                const bool across = event->key() == Qt::Key_Left || event->key() == Qt::Key_Right;
                const bool forth = event->key() == Qt::Key_Left || event->key() == Qt::Key_Up;
                const double way = forth ? kKeyPan : -kKeyPan;
                m_shift += across ? QPointF(way, 0.0) : QPointF(0.0, way);
                update();
            }
            return;
        default:
            QWidget::keyPressEvent(event);
    }
}

void MapCanvas::leaveEvent(QEvent* event) {
    QWidget::leaveEvent(event);
    Q_EMIT pointed(false, Texel{}, glm::dvec3(0.0, 1.0, 0.0));
}

}  // namespace reflet
