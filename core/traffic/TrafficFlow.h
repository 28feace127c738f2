// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to core/traffic.
#pragma once

#include "core/traffic/RouteMeetings.h"
#include "core/traffic/Timetable.h"
#include "core/traffic/Traffic.h"

#include <vector>

namespace reflet {

/// The traffic while it is being worked out, step by step (the rules: Timetable).
class TrafficFlow {
public:
    /// The drives must outlive it.
    explicit TrafficFlow(const std::vector<Drive>& drives);

    /// Whether any meets anybody on its way; whether this one may.
    [[nodiscard]] bool interacts() const;
    [[nodiscard]] bool interacts(std::size_t i) const { return m_agents[i].interacts; }
    [[nodiscard]] double station(std::size_t i) const { return m_agents[i].station; }
    /// Nobody will move any more.
    [[nodiscard]] bool settled() const { return m_idle > kIdleSteps; }
    void advance();

private:
    static constexpr int kIdleSteps = 300;

    struct Disc {
        glm::dvec3 at{0.0};
        double radius = 0.0;
    };
    struct Agent {
        const Drive* drive = nullptr;
        VehicleExtent size;
        std::vector<glm::dvec3> way;  ///< of its route, every metre
        bool person = false;
        bool interacts = false;
        double low = 0.0, high = 0.0;  ///< stations between which the whole vehicle is on its route
        double station = 0.0;
        double speed = 0.0;
        std::vector<Disc> discs;  ///< that cover it where it is, seen from above
        std::vector<std::size_t> places;

        [[nodiscard]] double middle() const;  ///< where it stands, on its route as a whole
        [[nodiscard]] double nose() const { return middle() + size.front; }
        [[nodiscard]] double tail() const { return middle() - size.rear; }
        [[nodiscard]] double brakingDistance() const;
    };
    /// Where two agents meet; one at a time may be there.
    struct Place {
        std::size_t agent[2] = {0, 0};
        Stretch stretch[2];
        int holder = -1;                 ///< 0, 1; -1: nobody
        double asked[2] = {-1.0, -1.0};  ///< when, seconds; -1: not
    };

    void findPlaces(std::size_t i, std::size_t j);
    [[nodiscard]] bool meets(std::size_t i, std::size_t j) const;
    [[nodiscard]] static bool inTheWay(const Disc& disc, const Agent& other, double margin);
    [[nodiscard]] static bool inTheWay(const std::vector<Disc>& discs, const Agent& other,
                                       double margin);
    [[nodiscard]] static std::vector<Disc> discsAt(const Agent& agent, double station);
    void updatePlaces();
    [[nodiscard]] bool takes(std::size_t agent, std::size_t place);
    [[nodiscard]] double freeAhead(std::size_t i) const;
    [[nodiscard]] double freeOfPlaces(std::size_t i) const;
    void move(std::size_t i);

    std::vector<Agent> m_agents;
    std::vector<Place> m_places;
    std::vector<std::vector<bool>> m_blind;  ///< pairs that stood within each other
    double m_time = 0.0;
    int m_idle = 0;
};

}  // namespace reflet
