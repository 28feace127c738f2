// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/CoveragePainter.h"

#include "core/gpu/overlay/CoverageOverlay.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/plan/PlanPainter.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kBandMetres = 6.0;
constexpr double kLeastBand = 11.0;  // pixels
constexpr double kGhostAside = 5.0;  // pixels between a suggested probe and its words
constexpr double kLabelAside = 6.0;  // pixels between a band and its percentage
constexpr double kSpotMetres = 1.4;  // across a dot of a façade
constexpr double kLeastSpot = 2.5;   // pixels
constexpr double kSpotScale = 0.8;   // pixels a metre from which façades are dotted
const QColor kEdge(255, 255, 255, 230);

QPolygonF onWidget(const std::vector<glm::dvec3>& line, const PlanTransform& transform) {
    QPolygonF result;
    for (const glm::dvec3& point : line)
        result << transform.toWidget(point);
    return result;
}

/// White stripes across a line: what is covered poorly.
void hatch(QPainter& painter, const QPolygonF& line, double width) {
    constexpr double kEvery = 6.0;
    painter.setPen(QPen(QColor(255, 255, 255, 220), 1.5));
    double next = 0.5 * kEvery;
    for (qsizetype i = 0; i + 1 < line.size(); ++i) {
        const QPointF along = line[i + 1] - line[i];
        const double length = std::hypot(along.x(), along.y());
        for (; next < length; next += kEvery) {
            const QPointF unit = along / length;
            const QPointF side(-unit.y(), unit.x());
            const QPointF middle = line[i] + unit * next;
            painter.drawLine(middle + 0.45 * width * (side + 0.5 * unit),
                             middle - 0.45 * width * (side + 0.5 * unit));
        }
        next -= length;
    }
}

void paintBands(QPainter& painter, const CoverageOverlay& coverage, const PlanTransform& transform,
                double width) {
    painter.setBrush(Qt::NoBrush);
    for (const CoveredBand& band : coverage.bands) {
        painter.setPen(QPen(kEdge, width + 3.0, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
        painter.drawPolyline(onWidget(band.line, transform));
    }
    for (const CoveredBand& band : coverage.bands) {
        const QPolygonF line = onWidget(band.line, transform);
        painter.setPen(
            QPen(coverageTone(band.coverage), width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
        painter.drawPolyline(line);
        if (band.coverage < kPoorlyCovered)
            hatch(painter, line, width);
    }
}

void paintSpots(QPainter& painter, const CoverageOverlay& coverage,
                const PlanTransform& transform) {
    if (transform.scale < kSpotScale)
        return;
    const QRectF view(QPointF(0.0, 0.0), transform.size);
    const double most = std::max(kLeastSpot, kSpotMetres * transform.scale);
    for (const CoveredSpot& spot : coverage.spots) {
        const QPointF at = transform.toWidget(spot.middle);
        if (!view.contains(at))
            continue;
        const bool poor = spot.coverage < kPoorlyCovered;
        const double edge = poor ? std::max(most, 4.0) : 0.7 * most;
        painter.setPen(poor ? QPen(coverageTone(spot.coverage), 1.4) : Qt::NoPen);
        painter.setBrush(poor ? QColor(Qt::white) : coverageTone(spot.coverage));
        painter.drawRect(QRectF(at - 0.5 * QPointF(edge, edge), QSizeF(edge, edge)));
    }
}

/// What stands beside a suggested probe, and where; no two of them overlap.
struct GhostLabel {
    std::size_t ghost = 0;
    QString text;
    QRectF box;
};
/// hovered: the id of one that is told in full in any case.
std::vector<GhostLabel> ghostLabels(const CoverageOverlay& coverage, const PlanTransform& transform,
                                    const QFont& font, const std::string& hovered) {
    const double aside = ghostRadius(transform.scale) + kGhostAside;
    const QFontMetricsF metrics(font);
    std::vector<GhostLabel> labels;
    for (std::size_t i = 0; i < coverage.ghosts.size(); ++i) {
        const GhostProbe& ghost = coverage.ghosts[i];
        const QPointF at = transform.toWidget(ghost.position);
        const QString number = QString::number(ghost.number);
        const QString whole = QStringLiteral("%1 · %2").arg(number, gainText(ghost.gain));
        for (const QString& text : {whole, number}) {
            const QRectF box(at + QPointF(aside, -0.5 * metrics.height()),
                             QSizeF(metrics.horizontalAdvance(text), metrics.height()));
            const bool free =
                std::none_of(labels.begin(), labels.end(),
                             [&](const GhostLabel& other) { return other.box.intersects(box); });
            if (free || ghost.id == hovered) {
                labels.push_back({i, text, box});
                break;
            }
        }
    }
    return labels;
}

/// The percentages, the poorest first: of those that would overlap, the others are left out.
void paintPercentages(QPainter& painter, const CoverageOverlay& coverage,
                      const PlanTransform& transform, double width) {
    std::vector<QRectF> taken;
    for (const GhostLabel& label : ghostLabels(coverage, transform, painter.font(), {}))
        taken.push_back(label.box);
    std::vector<const CoveredBand*> bands;
    for (const CoveredBand& band : coverage.bands)
        if (band.line.size() >= 2)
            bands.push_back(&band);
    std::stable_sort(bands.begin(), bands.end(), [](const CoveredBand* a, const CoveredBand* b) {
        return a->coverage < b->coverage;
    });
    const QFontMetricsF metrics(painter.font());
    const QRectF view(QPointF(0.0, 0.0), transform.size);
    for (const CoveredBand* band : bands) {
        const QPointF a = transform.toWidget(band->line.front());
        const QPointF b = transform.toWidget(band->line.back());
        const QPointF along = b - a;
        const double length = std::max(1e-6, std::hypot(along.x(), along.y()));
        QPointF side(-along.y() / length, along.x() / length);
        if (side.y() < 0.0 || (side.y() < 0.1 && side.x() < 0.0))
            side = -side;
        const QString text = percentText(band->coverage, 0);
        const QSizeF size(metrics.horizontalAdvance(text), metrics.height());
        const double away =
            0.5 * width + kLabelAside +
            0.5 * (std::abs(side.x()) * size.width() + std::abs(side.y()) * size.height());
        const QPointF middle = 0.5 * (a + b) + away * side;
        const QRectF box(middle - QPointF(0.5 * size.width(), 0.5 * size.height()), size);
        const bool free = view.contains(box) &&
                          std::none_of(taken.begin(), taken.end(), [&](const QRectF& other) {
                              return other.intersects(box.adjusted(-5.0, -1.0, 5.0, 1.0));
                          });
        if (!free)
            continue;
        taken.push_back(box);
        paintHaloText(painter, box.topLeft() + QPointF(0.0, metrics.ascent()), text);
    }
}

}  // namespace

void paintCoverage(QPainter& painter, const CoverageOverlay& coverage,
                   const PlanTransform& transform) {
    const double width = std::max(kLeastBand, kBandMetres * transform.scale);
    paintSpots(painter, coverage, transform);
    paintBands(painter, coverage, transform, width);
    paintPercentages(painter, coverage, transform, width);
}

void paintGhosts(QPainter& painter, const PlanScene& scene, const PlanTransform& transform) {
    if (!scene.coverage)
        return;
    const double radius = ghostRadius(transform.scale);
    for (const GhostProbe& ghost : scene.coverage->ghosts) {
        const bool hovered = scene.hover == PlanHit{PlanHit::Kind::Ghost, ghost.id, 0};
        paintGhostMark(painter, transform.toWidget(ghost.position),
                       hovered ? radius + 2.0 : radius);
    }
    const std::string hovered =
        scene.hover.kind == PlanHit::Kind::Ghost ? scene.hover.id : std::string();
    const QFontMetricsF metrics(painter.font());
    for (const GhostLabel& label : ghostLabels(*scene.coverage, transform, painter.font(), hovered))
        paintHaloText(painter, label.box.topLeft() + QPointF(0.0, metrics.ascent()), label.text);
}

}  // namespace reflet
