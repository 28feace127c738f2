// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectChanges.h"
#include "app/shell/Workbench.h"
#include "core/gpu/Frame.h"

#include <QObject>
#include <set>
#include <string>
#include <vector>

namespace reflet {

/// Keeps the views and panels showing what the document and the live city hold.
class SceneController : public QObject {
    Q_OBJECT
public:
    SceneController(Workbench& bench, QObject* parent);

    /// The next city that has been read is shown as a whole in the plan.
    void frameNextCity() { m_frameNextCity = true; }
    /// Probes and routes over the picture, or the picture alone.
    void setGlyphsShown(bool shown);

private:
    void showProject(ProjectChanges what);
    void showGlyphs();
    void showSelection();
    /// The preview spheres of these probes, until they are taken away.
    void showSpheres(const std::vector<std::string>& probes, bool shown);
    void showCity();
    void showTraffic();
    void showFrame(const FrameStatistics& statistics, double framesPerSecond);
    void connectLive();
    void connectTime();
    void connectViewCommands();
    void updateActions();

    Workbench& m_bench;
    std::set<std::string> m_spheres;  ///< probes whose sphere the inspector shows
    bool m_frameNextCity = true;
    bool m_glyphsShown = true;
    bool m_awaitsPicture = false;  ///< the first of a city that just came
};

}  // namespace reflet
