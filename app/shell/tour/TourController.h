// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"

#include <QObject>
#include <optional>

namespace reflet {

class CompareController;
class EditController;
class FileController;
class ReflectController;
class SceneController;

/// Leads a stranger: the first ten seconds on the sample, the three clicks on an own city, and the
/// checklist of the first five minutes. Everything in it can be left at any time.
class TourController : public QObject {
    Q_OBJECT
public:
    struct Others {
        FileController* files;
        EditController* edit;
        CompareController* compare;
        ReflectController* reflect;
        SceneController* scene;
    };
    TourController(Workbench& bench, const Others& others, QObject* parent);

    /// For the checklist's last step.
    void savedSomething();

private:
    void connectWelcome();
    void connectChecklist();
    void showDemo();
    void placeDemoCamera();
    void demoCityCame();
    void endDemo();
    void stepDemo(double seconds);
    void leaveDemo();
    void cityOpened();
    void showHints();
    void routeGrows(int points);
    void updateChecklist();
    void activateStep(int step);

    enum class Stage { None, Demo, RouteStart, RouteEnd, RouteReady, Reflecting };
    Workbench& m_bench;
    Others m_others;
    Stage m_stage = Stage::None;
    /// The demo's camera and its few seconds, again and again.
    struct Loop {
        double from = 0.0, to = 0.0;
    };
    std::optional<Loop> m_loop;
    bool m_demoCityPending = false;
    bool m_ownCityPending = false;
    bool m_drewRoute = false;
    bool m_madeReflect = false;
    bool m_checked = false;
    bool m_saved = false;
};

}  // namespace reflet
