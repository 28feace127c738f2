// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"

#include <glm/vec3.hpp>

#include <QObject>
#include <string>

namespace reflet {

/// Shows what the selected probe saw, or what the selected vehicle reflects where it stands.
class PreviewController : public QObject {
    Q_OBJECT
public:
    PreviewController(Workbench& bench, QObject* parent);

private:
    void show();
    /// Reconstructs the vehicle's local map in the background.
    void showVehicle(const std::string& reflector);
    /// Which probes show what the selected vehicle mirrors in a direction, and why others do not.
    void explain(const glm::dvec3& direction);

    Workbench& m_bench;
};

}  // namespace reflet
