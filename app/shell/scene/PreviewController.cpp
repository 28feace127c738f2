// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/PreviewController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Reconstruct.h"
#include "app/shell/Notices.h"
#include "widgets/preview/MapPreview.h"
#include "widgets/viewport/Viewport.h"

#include <QDockWidget>

namespace reflet {

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
    show();
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
