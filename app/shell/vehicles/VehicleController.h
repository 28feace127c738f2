// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/VehicleFile.h"
#include "app/shell/Workbench.h"

#include <QObject>
#include <QString>
#include <string>

namespace reflet {

class EditController;

/// Brings in vehicles that the user has as files, by drop or by menu: reads the file in the
/// background, shows what is proposed, and puts the vehicle on a route, all in one step of undo.
class VehicleController : public QObject {
    Q_OBJECT
public:
    VehicleController(Workbench& bench, EditController& edit, QObject* parent);

    /// Reads the file, then asks.
    void bringIn(const QString& path);

private:
    void chooseFile();
    void propose(const VehicleOffer& offer);
    void take(VehicleModel model);
    /// A vehicle came in before there was a route for it.
    void putOnRoute(const QString& route);

    Workbench& m_bench;
    EditController& m_edit;
    std::string m_waiting;  ///< id of the vehicle that gets the next route; empty: none
};

}  // namespace reflet
