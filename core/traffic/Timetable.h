// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/Vehicle.h"

#include <cstddef>
#include <string>
#include <vector>

namespace reflet {

struct Drive;

/// How much of its route a vehicle takes, seen from above, relative to its middle.
struct VehicleExtent {
    double front = 0.0;  ///< metres ahead of the middle, > 0
    double rear = 0.0;   ///< metres behind it, > 0
    double half = 0.0;   ///< half its width, metres
    double height = 0.0;
};
[[nodiscard]] VehicleExtent extentOf(const Vehicle& vehicle);

/// Where everybody is at any time under the rules of traffic, worked out once in steps of kStep
/// from time 0, so that the window, films and pictures agree:
///  - Who sees somebody ahead on its way brakes, and stops kGap metres behind.
///  - Where two routes cross or merge, who comes first goes first; the other waits before the
///  place.
///    Who cannot leave a place before the next one must have both.
///  - People go first: vehicles that can still stop do, and go on when the crossing is free. People
///    wait for a vehicle that cannot stop, and pass through each other.
///  - Nobody moves into somebody else. Those who stand within each other at time 0 do not see each
///    other until they have parted.
/// Who meets nobody drives at a steady speed to the end of its route and waits there.
/// Vehicles that face each other on one track wait for ever. A value; safe to read from several
/// threads.
class Timetable {
public:
    static constexpr double kStep = 0.1;        ///< seconds
    static constexpr double kLongest = 1800.0;  ///< seconds: later, everybody stands
    static constexpr double kGap = 1.5;         ///< metres

    Timetable() = default;
    explicit Timetable(const std::vector<Drive>& drives);
    /// Everybody as if alone.
    [[nodiscard]] static Timetable steady(const std::vector<Drive>& drives);

    /// Metres along its route; not beyond its end.
    [[nodiscard]] double station(std::size_t drive, double seconds) const;
    /// Metres a second.
    [[nodiscard]] double speed(std::size_t drive, double seconds) const;
    /// The first second at which it has come that far; where it never does, that of its last move.
    [[nodiscard]] double secondsAt(std::size_t drive, double station) const;
    /// Seconds until the last one has stopped for good; 0 when none moves.
    [[nodiscard]] double duration() const;

private:
    struct Course {
        double start = 0.0, speed = 0.0, length = 0.0;
        std::vector<double> stations;  ///< every kStep; empty: steady
        [[nodiscard]] double at(double seconds) const;
        [[nodiscard]] double lastMove() const;
    };
    std::vector<Course> m_courses;
};

}  // namespace reflet
