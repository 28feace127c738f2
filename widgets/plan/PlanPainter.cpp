// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/PlanPainter.h"

#include "widgets/common/Look.h"
#include "widgets/plan/CoveragePainter.h"

#include <QCoreApplication>
#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kRibbonMetres = 3.0;
constexpr double kLeastRibbon = 3.0;   ///< pixels
constexpr double kLabelScale = 2.5;    ///< pixels a metre from which all probes show their ids
constexpr double kLeastVehicle = 7.0;  ///< pixels across a vehicle that stays visible from afar
constexpr double kMiddleRoom = 40.0;
const QColor kCasing(20, 24, 28, 210);
const QColor kHighlight(255, 255, 255);
const QColor kVehicle(248, 248, 244);

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::PlanView)
};

QPolygonF polyline(const std::vector<glm::dvec3>& points, const PlanTransform& transform) {
    QPolygonF result;
    for (const glm::dvec3& point : points)
        result << transform.toWidget(point);
    return result;
}

/// Small chevrons along the line: which way it is driven.
void paintDirection(QPainter& painter, const QPolygonF& line) {
    constexpr double kEvery = 90.0;
    constexpr double kArm = 4.0;
    double next = 0.5 * kEvery;
    for (qsizetype i = 0; i + 1 < line.size(); ++i) {
        const QPointF along = line[i + 1] - line[i];
        const double length = std::hypot(along.x(), along.y());
        for (; next < length; next += kEvery) {
            const QPointF unit = along / length;
            const QPointF side(-unit.y(), unit.x());
            const QPointF tip = line[i] + unit * next;
            painter.drawPolyline(
                QPolygonF({tip - kArm * (unit + side), tip, tip - kArm * (unit - side)}));
        }
        next -= length;
    }
}

void paintHandles(QPainter& painter, const PlanScene& scene, const RouteGlyph& route,
                  const PlanTransform& transform) {
    const auto is = [&](const PlanHit& hit, PlanHit::Kind kind, std::size_t index) {
        return hit == PlanHit{kind, route.id, int(index)};
    };
    for (std::size_t i = 0; i + 1 < route.handles.size(); ++i) {
        const QPointF a = transform.toWidget(route.handles[i]);
        const QPointF b = transform.toWidget(route.handles[i + 1]);
        if (std::hypot(a.x() - b.x(), a.y() - b.y()) <= kMiddleRoom)
            continue;
        const bool hovered = is(scene.hover, PlanHit::Kind::Middle, i);
        painter.setPen(QPen(kCasing, 1.2));
        painter.setBrush(hovered ? QColor(DataColor::kYellow) : QColor(255, 255, 255, 200));
        painter.drawEllipse(0.5 * (a + b), hovered ? 5.0 : 3.5, hovered ? 5.0 : 3.5);
    }
    for (std::size_t i = 0; i < route.handles.size(); ++i) {
        const QPointF p = transform.toWidget(route.handles[i]);
        const bool chosen = is(scene.chosenCorner, PlanHit::Kind::Corner, i);
        const double half = chosen || is(scene.hover, PlanHit::Kind::Corner, i) ? 6.0 : 4.5;
        painter.setPen(QPen(kCasing, 1.5));
        painter.setBrush(chosen ? QColor(DataColor::kYellow) : kHighlight);
        painter.drawRect(QRectF(p.x() - half, p.y() - half, 2.0 * half, 2.0 * half));
    }
}

void paintRoutes(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    const double width = std::max(kLeastRibbon, kRibbonMetres * transform.scale);
    for (const RouteGlyph& route : scene.routes) {
        const QPolygonF line = polyline(route.line, transform);
        const bool hovered = scene.hover == PlanHit{PlanHit::Kind::Route, route.id, 0};
        QColor ribbon(DataColor::kBlue);
        ribbon.setAlpha(route.selected || hovered ? 230 : 170);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(route.selected ? QColor(DataColor::kYellow)
                                           : QColor(255, 255, 255, hovered ? 255 : 190),
                            width + (route.selected ? 5.0 : 2.5), Qt::SolidLine, Qt::RoundCap,
                            Qt::RoundJoin));
        painter.drawPolyline(line);
        painter.setPen(QPen(ribbon, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPolyline(line);
        painter.setPen(QPen(Qt::white, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        paintDirection(painter, line);
    }
    for (const RouteGlyph& route : scene.routes)
        if (route.selected)
            paintHandles(painter, scene, route, transform);
}

void paintVehicles(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    for (const PlacedReflector& placed : scene.placed()) {
        const bool selected = placed.id == scene.selectedReflector;
        const bool hovered = scene.hover == PlanHit{PlanHit::Kind::Reflector, placed.id, 0};
        const auto outlines = scene.outlines(placed);
        painter.setPen(QPen(selected || hovered ? kHighlight : kCasing, selected ? 2.5 : 1.5));
        QRectF bounds;
        for (const auto& outline : outlines) {
            QPolygonF polygon;
            for (const glm::dvec2& corner : outline)
                polygon << transform.toWidget(corner);
            bounds |= polygon.boundingRect();
            painter.setBrush(selected ? QColor(DataColor::kVermilion) : kVehicle);
            painter.drawPolygon(polygon);
        }
        if (outlines.empty())
            continue;
        if (std::max(bounds.width(), bounds.height()) < kLeastVehicle) {
            const QPointF middle = transform.toWidget(placed.middle());
            painter.drawRect(QRectF(middle.x() - 3.5, middle.y() - 3.5, 7.0, 7.0));
            continue;
        }
        // The front: its corners come first in each outline.
        const auto& front = outlines.front();
        const QPointF right = transform.toWidget(front[0]);
        const QPointF left = transform.toWidget(front[1]);
        const QPointF back = transform.toWidget(front[2]) - left;
        const double length = std::hypot(back.x(), back.y());
        const double wide = std::hypot(right.x() - left.x(), right.y() - left.y());
        if (length < 1.0)
            continue;
        const QPointF inwards = back / length * std::min(length, wide);
        painter.setPen(Qt::NoPen);
        painter.setBrush(kCasing);
        painter.drawPolygon(QPolygonF({0.5 * (left + right) + 0.15 * inwards,
                                       left + 0.2 * (right - left) + 0.75 * inwards,
                                       right - 0.2 * (right - left) + 0.75 * inwards}));
    }
}

void paintProbes(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    const double radius = probeRadius(transform.scale);
    const QRectF view(-20.0, -20.0, transform.size.width() + 40.0, transform.size.height() + 40.0);
    std::vector<QRectF> labels;  // ids that would lie over one another are left out
    for (const ProbeGlyph& probe : scene.probes) {
        const QPointF at = transform.toWidget(probe.position);
        if (!view.contains(at))
            continue;
        const bool hovered =
            probe.hovered || scene.hover == PlanHit{PlanHit::Kind::Probe, probe.id, 0};
        if (probe.selected || hovered) {
            painter.setPen(QPen(kCasing, 1.0));
            painter.setBrush(probe.selected ? QColor(DataColor::kYellow) : kHighlight);
            painter.drawEllipse(at, radius + 4.0, radius + 4.0);
        }
        paintProbeMark(painter, at, radius, probe.state);
        const bool wanted = probe.selected || hovered;
        if (!wanted && transform.scale < kLabelScale)
            continue;
        const QString label = QString::fromStdString(probe.id);
        const QFontMetricsF metrics(painter.font());
        const QRectF box(at + QPointF(radius + 6.0, -0.5 * metrics.height()),
                         QSizeF(metrics.horizontalAdvance(label) + 4.0, metrics.height()));
        const bool free = std::none_of(labels.begin(), labels.end(),
                                       [&](const QRectF& other) { return other.intersects(box); });
        if (!wanted && !free)
            continue;
        labels.push_back(box);
        paintHaloText(painter, at + QPointF(radius + 6.0, 0.35 * metrics.height()), label);
    }
}

void paintCamera(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    if (!scene.camera)
        return;
    const QPointF eye = transform.toWidget(scene.camera->position);
    const QPointF tip = scene.cameraTip(transform);
    const QPointF ahead = tip - eye;
    // The cone shows the horizontal field of a picture of 16:9.
    const double half = std::atan(std::tan(0.5 * scene.camera->verticalFov) * 16.0 / 9.0);
    const double spread = std::tan(std::min(half, 1.2));
    const QPointF side(-ahead.y() * spread, ahead.x() * spread);
    QColor fill(DataColor::kPurple);
    fill.setAlpha(90);
    painter.setBrush(fill);
    painter.setPen(QPen(QColor(DataColor::kPurple).darker(160), 1.5));
    painter.drawPolygon(QPolygonF({eye, tip + side, tip - side}));
    const bool onEye = scene.hover.kind == PlanHit::Kind::CameraEye;
    const bool onTip = scene.hover.kind == PlanHit::Kind::CameraTarget;
    painter.setPen(QPen(kHighlight, 1.5));
    painter.setBrush(QColor(DataColor::kPurple).darker(140));
    painter.drawEllipse(eye, onEye ? 7.5 : 6.0, onEye ? 7.5 : 6.0);
    painter.drawEllipse(tip, onTip ? 5.5 : 3.5, onTip ? 5.5 : 3.5);
}

void paintTool(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    std::vector<glm::dvec3> points = scene.draft;
    if (!points.empty() && scene.draftCursor)
        points.push_back(*scene.draftCursor);
    const QPolygonF line = polyline(points, transform);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(kHighlight, 5.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
    painter.setPen(QPen(QColor(DataColor::kBlue), 2.5, Qt::DashLine, Qt::FlatCap, Qt::RoundJoin));
    painter.drawPolyline(line);
    painter.setPen(QPen(kCasing, 1.5));
    painter.setBrush(kHighlight);
    for (const glm::dvec3& point : scene.draft) {
        const QPointF p = transform.toWidget(point);
        painter.drawRect(QRectF(p.x() - 4.0, p.y() - 4.0, 8.0, 8.0));
    }
    if (scene.placing && scene.draftCursor) {
        painter.setOpacity(0.65);
        paintProbeMark(painter, transform.toWidget(*scene.draftCursor),
                       probeRadius(transform.scale), ProbeState::Missing);
        painter.setOpacity(1.0);
    }
    if (scene.keyCursor) {
        constexpr double kArm = 12.0;
        for (const auto& [color, wide] : {std::pair{kHighlight, 4.0}, {kCasing, 1.5}}) {
            painter.setPen(QPen(color, wide));
            painter.drawLine(*scene.keyCursor - QPointF(kArm, 0.0),
                             *scene.keyCursor + QPointF(kArm, 0.0));
            painter.drawLine(*scene.keyCursor - QPointF(0.0, kArm),
                             *scene.keyCursor + QPointF(0.0, kArm));
        }
    }
}

/// The largest of 1, 2, 5, 10 ... metres that is at most `most`.
double niceLength(double most) {
    double length = std::pow(10.0, std::floor(std::log10(most)));
    for (const double factor : {5.0, 2.0})
        if (length * factor <= most)
            return length * factor;
    return length;
}

void paintPill(QPainter& painter, const QRectF& box, const QPalette& palette) {
    QColor ground = palette.color(QPalette::Window);
    ground.setAlpha(225);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(box, 4.0, 4.0);
}

}  // namespace

void paintHaloText(QPainter& painter, const QPointF& at, const QString& text) {
    QPainterPath path;
    path.addText(at, painter.font(), text);
    painter.setPen(
        QPen(QColor(255, 255, 255, 220), 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
    painter.fillPath(path, QColor(20, 24, 28));
}

void paintGround(QPainter& painter, const PlanPicture& picture, const PlanTransform& transform,
                 const QPalette& palette) {
    const double ratio = painter.device()->devicePixelRatioF();
    // The level whose pixels are just not larger than the screen's.
    const double wanted = 1.0 / (transform.scale * ratio);
    const double level = std::floor(std::log2(std::max(1.0, wanted / picture.metresAPixel)));
    const auto index = std::min(std::size_t(level), picture.levels.size() - 1);
    const QImage& image = picture.levels[index];
    const double across = picture.width() / image.width();
    const double down = picture.height() / image.height();

    const glm::dvec2 first = transform.toFrame({0.0, 0.0});
    const glm::dvec2 last = transform.toFrame({transform.size.width(), transform.size.height()});
    // Whole pixels around what is visible, so that nothing shifts when the view moves.
    const QRect visible(QPoint(int(std::floor((first.x - picture.west) / across)) - 1,
                               int(std::floor((picture.north - first.y) / down)) - 1),
                        QPoint(int(std::ceil((last.x - picture.west) / across)) + 1,
                               int(std::ceil((picture.north - last.y) / down)) + 1));
    const QRect source = visible.intersected(image.rect());
    if (source.isEmpty())
        return;
    const QPointF topLeft = transform.toWidget(
        glm::dvec2(picture.west + source.left() * across, picture.north - source.top() * down));
    const QRectF target(topLeft, QSizeF(source.width() * across * transform.scale,
                                        source.height() * down * transform.scale));
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(target, image, source);
    if (isDark(palette))
        painter.fillRect(target, QColor(10, 14, 20, 110));
}

void paintScene(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    painter.setRenderHint(QPainter::Antialiasing);
    if (scene.coverage)
        paintCoverage(painter, *scene.coverage, transform);
    paintRoutes(painter, scene, transform);
    paintVehicles(painter, scene, transform);
    paintCamera(painter, scene, transform);
    paintGhosts(painter, scene, transform);
    paintProbes(painter, scene, transform);
    paintTool(painter, scene, transform);
}

void paintFrame(QPainter& painter, const PlanTransform& transform, const QString& text,
                const QPalette& palette) {
    painter.setRenderHint(QPainter::Antialiasing);
    const QFontMetricsF metrics(painter.font());
    const double line = metrics.height();
    const double bottom = transform.size.height() - 8.0;
    const QColor ink = palette.color(QPalette::WindowText);

    constexpr double kBarShare = 0.28;  // of the width, at most
    const double length = niceLength(
        std::max(1e-3, std::min(160.0, kBarShare * transform.size.width()) / transform.scale));
    const double wide = length * transform.scale;
    const QLocale locale;
    const QString label = length >= 1000.0
                              ? Words::tr("%1 km").arg(locale.toString(length / 1000.0))
                              : Words::tr("%1 m").arg(locale.toString(length));
    const double right = transform.size.width() - 14.0;
    const QRectF bar(right - wide, bottom - 8.0, wide, 4.0);
    paintPill(painter, bar.adjusted(-8.0, -line - 4.0, 8.0, 7.0), palette);
    painter.setPen(QPen(ink, 1.5));
    painter.drawPolyline(
        QPolygonF({bar.topLeft(), bar.bottomLeft(), bar.bottomRight(), bar.topRight()}));
    painter.drawText(QRectF(bar.left() - 6.0, bar.top() - line - 1.0, wide + 12.0, line),
                     Qt::AlignCenter, label);

    const QRectF north(transform.size.width() - 32.0, 8.0, 24.0, 24.0 + line);
    paintPill(painter, north, palette);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ink);
    const QPointF top(north.center().x(), north.top() + 4.0);
    painter.drawPolygon(QPolygonF(
        {top, top + QPointF(6.0, 16.0), top + QPointF(0.0, 12.0), top + QPointF(-6.0, 16.0)}));
    painter.setPen(ink);
    painter.drawText(QRectF(north.left(), north.bottom() - line - 2.0, north.width(), line),
                     Qt::AlignCenter, Words::tr("N", "north"));

    if (text.isEmpty())
        return;
    const double room = bar.left() - 8.0 - 8.0 - 18.0;
    const QString shown = metrics.elidedText(text, Qt::ElideRight, room);
    const QRectF pill(8.0, bottom - line - 5.0, metrics.horizontalAdvance(shown) + 12.0,
                      line + 8.0);
    if (room < 3.0 * line)
        return;
    paintPill(painter, pill, palette);
    painter.setPen(ink);
    painter.drawText(pill, Qt::AlignCenter, shown);
}

}  // namespace reflet
