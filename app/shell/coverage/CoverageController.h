// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectChanges.h"
#include "app/shell/Workbench.h"
#include "app/shell/coverage/CoverageWork.h"

#include <QObject>
#include <functional>
#include <memory>

namespace reflet {

/// The coverage panel and the heat map: measures in the background when asked, and from then on
/// follows the probes while they are placed, moved and removed.
class CoverageController : public QObject {
    Q_OBJECT
public:
    CoverageController(Workbench& bench, QObject* parent);

    /// Measures anew; what was known is shown until then.
    void measure();
    /// Suggested probes, drawn over the heat map or without it.
    void setGhosts(std::vector<GhostProbe> ghosts);
    /// Null: nothing was measured since the routes or the city changed. Only to be used by jobs of
    /// watchLane().
    [[nodiscard]] std::shared_ptr<CoverageWatch> watch() const { return m_watch; }
    [[nodiscard]] static QString watchLane() { return QStringLiteral("coverageWatch"); }
    /// Calls `then` as soon as there is a watch: at once, or after measuring. The last one counts.
    void withWatch(std::function<void()> then);

Q_SIGNALS:
    void panelWanted();
    /// The routes, the city or the views changed: what was worked out for them is void.
    void outdated();

private:
    void projectChanged(ProjectChanges what);
    void forget(const QString& why);
    /// Brings the figures up to date in the background; of changes that come meanwhile, the latest.
    void follow();
    void show(ShownCoverage shown);
    void showMap();
    void updatePossible();
    void goTo(const glm::dvec3& place);

    Workbench& m_bench;
    std::shared_ptr<CoverageWatch> m_watch;
    std::shared_ptr<const ShownCoverage> m_shown;
    std::vector<GhostProbe> m_ghosts;
    std::function<void()> m_then;
    bool m_measuring = false;
    bool m_following = false;  ///< a job is at it
    bool m_behind = false;     ///< probes have changed since it began
};

}  // namespace reflet
