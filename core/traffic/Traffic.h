// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/traffic/Timetable.h"
#include "core/traffic/Vehicle.h"

#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// A vehicle where it is at some time, all its bodies.
struct PlacedReflector {
    std::string id;
    std::shared_ptr<const Vehicle> vehicle;
    double station = 0.0;               ///< metres along its route
    std::vector<RigidTransform> poses;  ///< project frame, one per body
    double interest = 1.0;              ///< Drive::interest

    /// Centre of the local map of a body, project frame.
    [[nodiscard]] glm::dvec3 mapCenter(std::size_t body) const;
    /// The middle body's centre.
    [[nodiscard]] glm::dvec3 middle() const;
    /// Unit driving direction in the plan at the middle body.
    [[nodiscard]] glm::dvec3 heading() const;
};

/// A vehicle that drives a route, at a steady speed where nobody is in its way.
struct Drive {
    std::string id;  ///< of the reflector
    std::string routeId;
    std::shared_ptr<const Vehicle> vehicle;
    std::shared_ptr<const Route> route;
    double speed = 0.0;     ///< metres a second
    double start = 0.0;     ///< metres along the route at time 0
    double interest = 1.0;  ///< how much its reflection matters when not all can be drawn in time
};

/// All moving vehicles of a project, in the project frame. A value; safe to read from several
/// threads.
class Traffic {
public:
    /// Where drives go is worked out by settle(); until then each goes as if it were alone.
    void add(Drive drive);
    void settle() { m_timetable = std::make_shared<const Timetable>(m_drives); }

    [[nodiscard]] std::size_t size() const { return m_drives.size(); }
    [[nodiscard]] const Drive& drive(std::size_t i) const { return m_drives[i]; }
    [[nodiscard]] const Route& route(std::size_t i) const { return *m_drives[i].route; }
    /// Index of the reflector with this id; Usage when there is none.
    [[nodiscard]] Result<std::size_t> find(const std::string& id) const;
    /// The reflector `seconds` after the start, by the rules of Timetable; it waits at the end of
    /// its route.
    [[nodiscard]] PlacedReflector at(std::size_t i, double seconds) const;
    /// The reflector at a distance along its route.
    [[nodiscard]] PlacedReflector atStation(std::size_t i, double station) const;
    /// All reflectors at a time.
    [[nodiscard]] std::vector<PlacedReflector> at(double seconds) const;
    /// Seconds until the last one has reached the end of its route, or stands for good; 0 when none
    /// moves.
    [[nodiscard]] double duration() const { return m_timetable->duration(); }
    /// The first second at which a reflector is so far along its route; where it never comes so
    /// far, that of its last move.
    [[nodiscard]] double secondsAt(std::size_t i, double station) const {
        return m_timetable->secondsAt(i, station);
    }

private:
    std::shared_ptr<const Timetable> m_timetable = std::make_shared<const Timetable>();
    std::vector<Drive> m_drives;
};

}  // namespace reflet
