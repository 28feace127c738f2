// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/coverage/DriveWatch.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Notices.h"
#include "app/shell/coverage/SuggestController.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/viewport/Viewport.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace reflet {

DriveWatch::DriveWatch(Workbench& bench, SuggestController& suggest, QObject* parent)
    : QObject(parent), m_bench(bench), m_suggest(suggest) {
    connect(bench.viewport, &Viewport::frameDrawn, this, &DriveWatch::count);
    connect(bench.viewport, &Viewport::playingChanged, this, &DriveWatch::forget);
    connect(bench.live, &LiveCity::remsChanged, this, [this] {
        forget();
        m_places.clear();  // what was offered may have been answered
    });
}

void DriveWatch::forget() {
    m_vertices = 0;
    m_uncovered = 0;
    m_since.invalidate();
}

void DriveWatch::count(const FrameStatistics& statistics) {
    // Of a place where probes are still without pictures nothing can be said.
    if (!m_bench.viewport->playing() || m_bench.live->rems().empty() ||
        m_bench.live->probesToBake() > 0) {
        forget();
        return;
    }
    if (!m_since.isValid())
        m_since.start();
    m_vertices += statistics.vertices;
    m_uncovered += statistics.uncovered;
    if (m_since.elapsed() >= kWindow) {
        look();
        forget();
    }
}

void DriveWatch::look() {
    const auto traffic = m_bench.live->traffic();
    if (m_vertices == 0 || !traffic || traffic->size() == 0 ||
        (m_offered.isValid() && m_offered.elapsed() < kPauseAfter))
        return;
    const double share = double(m_uncovered) / double(m_vertices);
    if (share < kMuch)
        return;
    // The vehicle that is looked at: the one gone along with, the selected one, or the first.
    std::string id = m_bench.viewport->followed();
    const auto selected = m_bench.document->selection()->ids(ProjectItem::Kind::Reflector);
    if (id.empty() && !selected.empty())
        id = selected.back();
    const auto index = id.empty() ? Result<std::size_t>(std::size_t{0}) : traffic->find(id);
    if (!index)
        return;
    const PlacedReflector vehicle = traffic->at(*index, m_bench.viewport->time());
    const glm::dvec3 place = vehicle.middle();
    const bool known = std::any_of(m_places.begin(), m_places.end(), [&](const auto& other) {
        return glm::distance(other, place) < kApart;
    });
    if (known)
        return;
    m_places.push_back(place);
    m_offered.start();
    const QString name = QString::fromStdString(vehicle.id);
    m_bench.notices->tell(
        Severity::Info,
        traffic->size() > 1
            ? tr("%1 of what the vehicles mirror here no probe sees.").arg(percentText(share, 0))
            : tr("%1 of what %2 mirrors here no probe sees.").arg(percentText(share, 0), name),
        {{tr("Suggest here"), [this, place] { m_suggest.suggestHere(place); }}});
}

}  // namespace reflet
