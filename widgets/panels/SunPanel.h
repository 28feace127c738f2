// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/geo/SunPosition.h"
#include "widgets/ViewIntents.h"

#include <QWidget>
#include <memory>
#include <optional>

namespace reflet {

/// Date, time, haze and exposure. The day's slider shows when the sun is up.
class SunPanel : public QWidget {
    Q_OBJECT

public:
    explicit SunPanel(QWidget* parent = nullptr);
    ~SunPanel() override;

    void setDate(const DateTime& date);
    /// Where the city lies; nullopt for local metres: the sun's position is then not known.
    void setPlace(std::optional<GeoPosition> place);
    void setTurbidity(float turbidity);
    void setExposure(float exposure);

Q_SIGNALS:
    void dateChanged(reflet::DateTime date, reflet::DragPhase phase);
    void turbidityChanged(float turbidity, reflet::DragPhase phase);
    void exposureChanged(float exposure, reflet::DragPhase phase);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
