// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/vehicle/VehicleSilhouette.h"

#include "widgets/common/Look.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr int kMaskWidth = 800;     ///< pixels: sharp enough at twice the usual scale
constexpr int kTallestMask = 1600;  ///< pixels; what is still higher is cut off

/// Fills a triangle, its edges included, so that slivers leave no holes.
void fillTriangle(QImage& mask, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const auto low = glm::min(a, glm::min(b, c));
    const auto high = glm::max(a, glm::max(b, c));
    const int x0 = std::max(0, int(std::floor(low.x)));
    const int x1 = std::min(mask.width() - 1, int(std::floor(high.x)));
    const int y0 = std::max(0, int(std::floor(low.y)));
    const int y1 = std::min(mask.height() - 1, int(std::floor(high.y)));
    // Half a pixel around each edge counts.
    const auto inside = [&](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& at) {
        const glm::dvec2 along = q - p;
        const double side = along.x * (at.y - p.y) - along.y * (at.x - p.x);
        return (area < 0.0 ? -side : side) >= -0.5 * (std::abs(along.x) + std::abs(along.y));
    };
    for (int y = y0; y <= y1; ++y) {
        uchar* line = mask.scanLine(y);
        for (int x = x0; x <= x1; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            if (inside(a, b, at) && inside(b, c, at) && inside(c, a, at))
                line[x] = 255;
        }
    }
}

/// A body's vertex in the straight vehicle.
glm::dvec3 placed(const VehicleBody& body, const glm::vec3& vertex) {
    return glm::dvec3(vertex) + glm::dvec3(body.offset, 0.0, 0.0);
}

void drawMask(QPainter& painter, const QImage& mask, const QRectF& where, const QColor& color) {
    QImage coloured(mask.size(), QImage::Format_ARGB32_Premultiplied);
    coloured.fill(color);
    coloured.setAlphaChannel(mask);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(where, coloured);
}

void arrow(QPainter& painter, const QPointF& from, const QPointF& to) {
    constexpr double kHead = 7.0;
    const QPointF way = to - from;
    const double length = std::hypot(way.x(), way.y());
    if (length < kHead)
        return;
    const QPointF unit = way / length;
    const QPointF side(-unit.y(), unit.x());
    painter.drawLine(from, to);
    painter.drawPolygon(QPolygonF(
        {to, to - kHead * unit + 0.5 * kHead * side, to - kHead * unit - 0.5 * kHead * side}));
}

}  // namespace

Box vehicleBox(const Vehicle& vehicle) {
    Box box;
    for (const VehicleBody& body : vehicle.bodies)
        for (const glm::vec3& vertex : body.vertices)
            box.add(placed(body, vertex));
    return box;
}

QImage vehicleMask(const Vehicle& vehicle, SilhouetteView view, int width) {
    const Box box = vehicleBox(vehicle);
    if (box.empty() || !(box.size().x > 0.0))
        return {};
    const int axis = view == SilhouetteView::Side ? 2 : 1;
    const double scale = width / box.size().x;
    const double wanted = std::ceil(box.size()[axis] * scale);
    QImage mask(width, int(std::clamp(wanted, 1.0, double(kTallestMask))), QImage::Format_Alpha8);
    mask.fill(0);
    const auto pixel = [&](const VehicleBody& body, unsigned index) {
        const glm::dvec3 p = placed(body, body.vertices[index]);
        return glm::dvec2((p.x - box.min.x) * scale, (box.max[axis] - p[axis]) * scale);
    };
    for (const VehicleBody& body : vehicle.bodies)
        for (const glm::uvec3& triangle : body.triangles)
            fillTriangle(mask, pixel(body, triangle.x), pixel(body, triangle.y),
                         pixel(body, triangle.z));
    return mask;
}

VehicleSilhouette::VehicleSilhouette(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("The vehicle from the side and from above"));
}

void VehicleSilhouette::setVehicle(std::shared_ptr<const Vehicle> vehicle) {
    m_vehicle = std::move(vehicle);
    m_side = m_vehicle ? vehicleMask(*m_vehicle, SilhouetteView::Side, kMaskWidth) : QImage();
    m_top = m_vehicle ? vehicleMask(*m_vehicle, SilhouetteView::Top, kMaskWidth) : QImage();
    update();
}

void VehicleSilhouette::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (m_side.isNull()) {
        painter.setPen(mutedText(palette()));
        painter.drawText(rect(), Qt::AlignCenter, tr("The vehicle is being read …"));
        return;
    }
    const Box box = vehicleBox(*m_vehicle);
    const glm::dvec3 size = box.size();
    const int line = fontMetrics().height();
    const double room = height() - 4.0 * line;
    const double scale = std::min((width() - 60.0) / size.x, room / (size.z + size.y));
    const double left = 0.5 * (width() - size.x * scale);
    const QRectF side(left, 0.6 * line, size.x * scale, size.z * scale);
    const QRectF top(left, side.bottom() + 2.0 * line, size.x * scale, size.y * scale);
    const QColor ink = palette().color(QPalette::WindowText);
    drawMask(painter, m_side, side, QColor(DataColor::kBlue));
    drawMask(painter, m_top, top, QColor(DataColor::kBlue));

    // The road, where z = 0.
    const double road = side.bottom() + box.min.z * scale;
    painter.setPen(QPen(ink, 1.5));
    painter.drawLine(QPointF(12.0, road), QPointF(width() - 12.0, road));
    // Its length, between the two views.
    const double middle = road + 0.9 * line;
    painter.setBrush(ink);
    const QString length = metresText(size.x, 2);
    const double half = 0.5 * fontMetrics().horizontalAdvance(length) + 6.0;
    const QPointF center(side.center().x(), middle);
    arrow(painter, center - QPointF(half, 0.0), {side.left(), middle});
    arrow(painter, center + QPointF(half, 0.0), {side.right(), middle});
    painter.drawText(QRectF(center.x() - half, middle - 0.5 * line, 2.0 * half, line),
                     Qt::AlignCenter, length);
    // Its front.
    painter.setPen(QPen(QColor(DataColor::kVermilion), 2.5));
    painter.setBrush(QColor(DataColor::kVermilion));
    arrow(painter, {top.center().x(), top.center().y()},
          {std::min(top.right() + 22.0, width() - 4.0), top.center().y()});
    painter.setPen(ink);
    painter.drawText(QRectF(top.left(), top.bottom() + 2.0, top.width() + 26.0, line),
                     Qt::AlignRight, tr("front"));
}

}  // namespace reflet
