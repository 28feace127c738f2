// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/geo/SunPosition.h"

#include <QWidget>
#include <array>
#include <optional>

namespace reflet {

/// When the sun is up on a day.
struct Daylight {
    static constexpr int kStep = 10;  ///< minutes between samples
    static constexpr std::size_t kSamples = 24 * 60 / kStep + 1;
    std::array<double, kSamples> elevation{};  ///< radians
    std::optional<int> sunrise;                ///< minute of the day; none in polar day and night
    std::optional<int> sunset;
};
[[nodiscard]] Daylight daylightOf(const DateTime& date, const GeoPosition& place);

/// A day from 0 to 24 h: night, twilight, day, and a mark at the present minute.
class DayBand : public QWidget {
public:
    explicit DayBand(QWidget* parent = nullptr);
    void setDay(const std::optional<Daylight>& daylight, int minute);

    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::optional<Daylight> m_daylight;
    int m_minute = 0;
};

}  // namespace reflet
