// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/GroundModels.h"
#include "app/pipeline/Place.h"
#include "app/shell/Workbench.h"
#include "app/shell/files/PlaceDialog.h"

#include <QObject>
#include <string>
#include <vector>

namespace reflet {

/// Places models that are in local coordinates, as one step that can be undone, and offers to move
/// a terrain that does not fit the buildings, and to exchange east and north where a model then
/// lies where its CRS is used.
class PlaceController : public QObject {
    Q_OBJECT
public:
    PlaceController(Workbench& bench, QObject* parent);

private:
    [[nodiscard]] std::vector<PlaceableModel> models() const;
    void ask();
    void place(const PlaceRequest& request, PlaceDialog* dialog);
    void offerToMoveTerrain();
    void tellFit(const GroundFit& fit);
    void offerToExchangeAxes();
    void exchangeAxes(const std::vector<std::string>& models);

    Workbench& m_bench;
    std::vector<std::string> m_offered;  ///< models that it was offered for last
};

}  // namespace reflet
