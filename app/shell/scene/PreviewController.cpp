// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/PreviewController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Reconstruct.h"
#include "app/shell/Notices.h"
#include "core/reconstruction/RemVerdicts.h"
#include "widgets/common/Look.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/preview/MapPreview.h"
#include "widgets/viewport/Viewport.h"

#include <QDockWidget>

namespace reflet {

namespace {

QString sentenceOf(const RemVerdict& verdict, const QString& id) {
    switch (verdict.reason) {
        case RemVerdict::Reason::Shown:
            return PreviewController::tr("%1 shows it, weight %2")
                .arg(id, percentText(verdict.weight, 0));
        case RemVerdict::Reason::Hidden:
            return PreviewController::tr("%1 does not: it is hidden from there").arg(id);
        case RemVerdict::Reason::Angle:
            return PreviewController::tr("%1 does not: it sees it at an angle of %2°")
                .arg(id, QString::number(verdict.angle * 180.0 / kPi, 'f', 0));
        case RemVerdict::Reason::Farther:
            break;
    }
    return PreviewController::tr("%1 does not: it stands farther away, %2")
        .arg(id, metresText(verdict.distance, 0));
}

/// Who shows it, and of the others the nearest.
QString verdictText(const DirectionVerdict& verdict, const RemSet& rems) {
    constexpr qsizetype kMost = 5;
    QStringList lines;
    if (verdict.uncovered)
        lines << PreviewController::tr("No probe sees this: something else is shown.");
    for (const RemVerdict& each : verdict.rems) {
        if (lines.size() < kMost)
            lines << sentenceOf(each, QString::fromStdString(rems[each.rem].id));
    }
    return lines.join(QLatin1Char('\n'));
}

}  // namespace

PreviewController::PreviewController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    connect(bench.document->selection(), &Selection::changed, this, &PreviewController::show);
    connect(bench.live, &LiveCity::remsChanged, this, &PreviewController::show);
    connect(bench.live, &LiveCity::trafficChanged, this, &PreviewController::show);
    connect(bench.viewport, &Viewport::playingChanged, this, &PreviewController::show);
    connect(bench.viewport, &Viewport::timeChanged, this, [this] {
        if (!m_bench.viewport->playing()) {
            show();
        }
    });
    if (auto* dock = qobject_cast<QDockWidget*>(bench.preview->parentWidget())) {
        connect(dock, &QDockWidget::visibilityChanged, this, &PreviewController::show);
    }
    connect(bench.preview, &MapPreview::directionHovered, this, &PreviewController::explain);
    connect(bench.preview, &MapPreview::directionLeft, this,
            [this] { m_bench.preview->setExplanation({}); });
    show();
}

void PreviewController::explain(const glm::dvec3& direction) {
    const Selection& selection = *m_bench.document->selection();
    const auto reflectors = selection.ids(ProjectItem::Kind::Reflector);
    const auto prepared = m_bench.live->prepared();
    const auto traffic = m_bench.live->traffic();
    const RemSet rems = m_bench.live->rems();
    const bool vehicle = selection.ids(ProjectItem::Kind::Probe).empty() && !reflectors.empty();
    const auto index =
        vehicle && traffic ? traffic->find(reflectors.back()) : Result<std::size_t>(std::size_t{0});
    if (!vehicle || !prepared || !traffic || !index || rems.empty() ||
        m_bench.viewport->playing()) {
        m_bench.preview->setExplanation({});
        return;
    }
    const auto near = prepared->preparedRems(rems);
    const ReconstructionInput input{&prepared->tracer(), rems, prepared->diameter(), near.get()};
    const DirectionVerdict verdict =
        explainDirection(input, traffic->at(*index, m_bench.viewport->time()).middle(), direction,
                         prepared->project().tuning);
    m_bench.preview->setExplanation(verdictText(verdict, rems));
}

void PreviewController::show() {
    const Selection& selection = *m_bench.document->selection();
    const auto probes = selection.ids(ProjectItem::Kind::Probe);
    const auto reflectors = selection.ids(ProjectItem::Kind::Reflector);
    if (!probes.empty()) {
        m_bench.preview->setReference(m_bench.live->rem(probes.back()),
                                      QString::fromStdString(probes.back()));
    } else if (!reflectors.empty()) {
        showVehicle(reflectors.back());
    } else {
        m_bench.preview->setReference(nullptr, tr("Select a reflection probe or a vehicle"));
    }
}

void PreviewController::showVehicle(const std::string& reflector) {
    if (!m_bench.preview->isVisible()) {
        return;
    }
    if (m_bench.viewport->playing()) {
        m_bench.preview->setLocalMap(
            nullptr,
            tr("Stop the drive to see what %1 reflects").arg(QString::fromStdString(reflector)));
        return;
    }
    const auto traffic = m_bench.live->traffic();
    const auto prepared = m_bench.live->prepared();
    if (!traffic || !prepared) {
        return;
    }
    const auto index = traffic->find(reflector);
    if (!index) {
        return;
    }
    using Map = std::shared_ptr<const LocalEnvironmentMap>;
    m_bench.jobs->run<Map>(
        {.title = tr("Looking around"),
         .lane = QStringLiteral("localMapPreview"),
         .visible = false},
        [prepared, rems = m_bench.live->rems(),
         place = traffic->at(*index, m_bench.viewport->time()).middle()](
            const JobContext& job) -> Result<Map> {
            auto map = reconstruct(*prepared, rems, nullptr, Method::Mem, place, job);
            if (!map) {
                return tl::unexpected(map.error());
            }
            return std::make_shared<const LocalEnvironmentMap>(std::move(*map));
        },
        this,
        [this, reflector](const Result<Map>& map) {
            const auto now = m_bench.document->selection()->ids(ProjectItem::Kind::Reflector);
            if (now.empty() || now.back() != reflector) {
                return;
            }
            const QString name = QString::fromStdString(reflector);
            if (map) {
                m_bench.preview->setLocalMap(*map, tr("What %1 reflects here").arg(name));
            } else if (map.error().code != ErrorCode::Cancelled) {
                m_bench.preview->setLocalMap(nullptr, name + QStringLiteral(": ") +
                                                          QString::fromStdString(map.error().what));
            }
        });
}

}  // namespace reflet
