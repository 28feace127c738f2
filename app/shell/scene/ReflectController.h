// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"

#include <QObject>

namespace reflet {

/// *Make it reflect* and the pictures of the probes: asks the live city, and says how it went.
class ReflectController : public QObject {
    Q_OBJECT
public:
    ReflectController(Workbench& bench, QObject* parent);

    void makeItReflect();

Q_SIGNALS:
    void reflects();  ///< probes stand along the routes, and something drives there

private:
    Workbench& m_bench;
};

}  // namespace reflet
