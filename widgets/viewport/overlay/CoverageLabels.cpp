// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/overlay/CoverageLabels.h"

#include "widgets/coverage/CoverageLegend.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/viewport/overlay/Plates.h"

#include <QPainter>
#include <algorithm>

namespace reflet {

namespace {

constexpr double kFarthest = 150.0;  // metres: stretches farther away have colours alone
constexpr double kHidden = 1.5;      // metres that the city may lie before what is labelled
constexpr double kLift = 1.2;        // metres over the running surface
constexpr double kGhostLift = 1.0;   // metres over a suggested probe
constexpr int kMargin = 12;

glm::dvec3 middleOf(const std::vector<glm::dvec3>& line) {
    return line.size() % 2 == 1 ? line[line.size() / 2]
                                : 0.5 * (line[line.size() / 2 - 1] + line[line.size() / 2]);
}

bool isSeen(const ViewGeometry& view, const Ground& ground, const glm::dvec3& place) {
    const ProjectedPoint point = view.project(place);
    const bool inside = point.depth > 0.0 && point.pixel.x > 0.0 && point.pixel.y > 0.0 &&
                        point.pixel.x < view.width() && point.pixel.y < view.height();
    if (!inside)
        return false;
    const auto met = ground.pointUnder(view.ray(point.pixel));
    const glm::dvec3& eye = view.camera().position;
    return !met || glm::distance(*met, eye) + kHidden > glm::distance(place, eye);
}

QPointF toPoint(const glm::dvec2& pixel) {
    return {pixel.x, pixel.y};
}

QRectF boxOf(const CoverageLabels::Label& label, const QFontMetricsF& metrics) {
    const QSizeF size(metrics.horizontalAdvance(label.text) + 10.0, metrics.height() + 2.0);
    return {label.at - QPointF(0.5 * size.width(), 0.5 * size.height()), size};
}

}  // namespace

CoverageLabels::CoverageLabels(QWidget* parent)
    : QWidget(parent), m_legend(new CoverageLegend(this)) {
    setObjectName(QStringLiteral("coverageLabels"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    m_legend->move(kMargin, kMargin);
    hide();
}

void CoverageLabels::setCoverage(std::shared_ptr<const CoverageOverlay> coverage) {
    m_coverage = std::move(coverage);
    m_legend->setVisible(m_coverage && !(m_coverage->bands.empty() && m_coverage->spots.empty()));
    m_legend->setGhosts(m_coverage && !m_coverage->ghosts.empty());
    setVisible(m_coverage != nullptr);
}

/// Labels that would lie over one another are left out.
void CoverageLabels::offer(const Label& label) {
    const QFontMetricsF metrics(font());
    const QRectF box = boxOf(label, metrics);
    const bool free = std::none_of(m_labels.begin(), m_labels.end(), [&](const Label& other) {
        return boxOf(other, metrics).intersects(box);
    });
    if (free)
        m_labels.push_back(label);
}

void CoverageLabels::setView(const ViewGeometry& view, const Ground& ground) {
    if (!m_coverage)
        return;
    if (parentWidget() != nullptr)
        setGeometry(parentWidget()->rect());
    m_labels.clear();
    for (const GhostProbe& ghost : m_coverage->ghosts) {
        const glm::dvec3 place = ghost.position + glm::dvec3(0.0, 0.0, kGhostLift);
        if (isSeen(view, ground, place))
            offer({toPoint(view.project(place).pixel),
                   QStringLiteral("%1 · %2").arg(ghost.number).arg(gainText(ghost.gain)), true});
    }
    std::vector<std::pair<double, const CoveredBand*>> near;
    for (const CoveredBand& band : m_coverage->bands) {
        if (band.line.size() < 2)
            continue;
        const double away = glm::distance(middleOf(band.line), view.camera().position);
        if (away < kFarthest)
            near.emplace_back(away, &band);
    }
    std::sort(near.begin(), near.end());
    for (const auto& [away, band] : near) {
        const glm::dvec3 place = middleOf(band->line) + glm::dvec3(0.0, 0.0, kLift);
        if (isSeen(view, ground, place))
            offer({toPoint(view.project(place).pixel), percentText(band->coverage, 0), false});
    }
    update();
}

void CoverageLabels::paintEvent(QPaintEvent* /*event*/) {
    const PlateColors colors(palette());
    const QFontMetricsF metrics(font());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const Label& label : m_labels) {
        const QRectF box = boxOf(label, metrics);
        paintPlate(painter, box, colors);
        if (label.ghost) {
            painter.setPen(QPen(ghostTone(), 2.0));
            painter.setBrush(Qt::NoBrush);
            painter.drawRoundedRect(box, 4.0, 4.0);
        }
        painter.setPen(colors.text);
        painter.drawText(box, Qt::AlignCenter, label.text);
    }
}

}  // namespace reflet
