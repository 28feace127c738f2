// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/MakeItReflect.h"
#include "app/shell/Workbench.h"
#include "core/rendering/ViewRenderer.h"

#include <QObject>
#include <optional>
#include <set>
#include <string>

namespace reflet {

/// *Make it reflect* and the pictures of the probes: asks the live city, and says how it went.
class ReflectController : public QObject {
    Q_OBJECT
public:
    ReflectController(Workbench& bench, QObject* parent);

    /// For the selected route, or the last: probes along it, a vehicle, and the camera on the
    /// pavement; one step of undo. A route that is being drawn is ended first.
    void makeItReflect();

Q_SIGNALS:
    void reflects();  ///< probes stand along the route, and something drives there

private:
    void adopt(const ReflectResult& result);
    /// Goes to the pavement as soon as the vehicle is there, and along with the vehicle when it has
    /// passed, unless the user has gone elsewhere.
    void showFromPavement();
    void watch(double seconds);
    void goAlong();
    void updateBaking();
    /// Once for each probe that stands in something.
    void offerFreePlaces();
    [[nodiscard]] const RouteSpec* chosenRoute() const;

    Workbench& m_bench;
    std::set<std::string> m_refused;  ///< probes whose free place was offered
    std::string m_toShow;             ///< the reflector to go to; empty = none
    struct Watch {
        std::string reflector;
        Camera camera;       ///< on the pavement
        double until = 0.0;  ///< second of the drive at which it has passed
    };
    std::optional<Watch> m_watch;
};

}  // namespace reflet
