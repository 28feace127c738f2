// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Place.h"
#include "app/shell/Workbench.h"

#include <QObject>

namespace reflet {

/// Places models that are in local coordinates, as one step that can be undone, and offers to move
/// a terrain that does not fit the buildings.
class PlaceController : public QObject {
    Q_OBJECT
public:
    PlaceController(Workbench& bench, QObject* parent);

    void place(const PlaceRequest& request);

private:
    void ask();
    void offerToMoveTerrain();

    Workbench& m_bench;
};

}  // namespace reflet
