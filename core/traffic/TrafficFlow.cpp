// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/TrafficFlow.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr double kBraking = 2.0;       // metres a second squared
constexpr double kStarting = 1.2;      // the same
constexpr double kRoom = 0.4;          // metres between the sides of vehicles that pass
constexpr double kTouch = 0.2;         // the least that is ever left
constexpr double kCorner = 0.35;       // of half a vehicle's width: discs in its corners
constexpr double kLine = 1.5;          // metres before a place at which vehicles wait
constexpr double kPersonsLine = 0.4;   // and people
constexpr double kPersonsSight = 2.5;  // metres before a crossing at which people are seen
constexpr double kMerging = 12.0;      // metres of a shared stretch that are entered one by one
constexpr double kLevel = 3.0;         // metres of height: who is higher is not in the way
constexpr double kMoved = 1e-6;

/// The speed from which one stops within `gap`, this step included:
/// v dt + v² / 2b = gap.
double speedWithin(double gap) {
    constexpr double dt = Timetable::kStep;
    if (gap <= 0.0)
        return 0.0;
    return kBraking * (std::sqrt(dt * dt + 2.0 * gap / kBraking) - dt);
}

glm::dvec3 pointOn(const Route& route, double s) {
    const double inside = std::clamp(s, 0.0, route.length());
    return route.at(inside) + route.tangent(inside) * (s - inside);
}

}  // namespace

double TrafficFlow::Agent::middle() const {
    return low <= high ? std::clamp(station, low, high) : 0.5 * (low + high);
}

double TrafficFlow::Agent::brakingDistance() const {
    return person ? 0.0 : speed * speed / (2.0 * kBraking) + speed * Timetable::kStep;
}

TrafficFlow::TrafficFlow(const std::vector<Drive>& drives) {
    for (const Drive& drive : drives) {
        Agent agent;
        agent.drive = &drive;
        agent.size = extentOf(*drive.vehicle);
        agent.way = sampled(*drive.route);
        agent.person = drive.vehicle->walks;
        agent.station = std::clamp(drive.start, 0.0, drive.route->length());
        agent.speed = drive.speed;
        agent.low = agent.size.rear;
        agent.high = drive.route->length() - agent.size.front;
        agent.discs = discsAt(agent, agent.middle());
        m_agents.push_back(std::move(agent));
    }
    const std::size_t count = m_agents.size();
    m_blind.assign(count, std::vector<bool>(count, false));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j) {
            findPlaces(i, j);
            m_blind[i][j] = m_blind[j][i] = meets(i, j);
        }
    }
}

bool TrafficFlow::interacts() const {
    return std::any_of(m_agents.begin(), m_agents.end(),
                       [](const Agent& agent) { return agent.interacts; });
}

/// Discs of the vehicle's width along its middle line, and small ones in its corners.
std::vector<TrafficFlow::Disc> TrafficFlow::discsAt(const Agent& agent, double station) {
    const Route& route = *agent.drive->route;
    const double r = agent.size.half;
    const double tail = station - agent.size.rear;
    const double nose = station + agent.size.front;
    const double from = std::min(tail + r, station);
    const double to = std::max(nose - r, station);
    const int count = std::max(1, int(std::ceil((to - from) / std::max(r, 0.25))));
    std::vector<Disc> discs;
    for (int k = 0; k <= count; ++k)
        discs.push_back({pointOn(route, from + (to - from) * k / count), r});
    const double small = kCorner * r;
    for (const double s : {tail + small, nose - small}) {
        const glm::dvec3 along = route.tangent(std::clamp(s, 0.0, route.length()));
        const glm::dvec3 aside = (r - small) * glm::dvec3(-along.y, along.x, 0.0);
        discs.push_back({pointOn(route, s) + aside, small});
        discs.push_back({pointOn(route, s) - aside, small});
    }
    return discs;
}

bool TrafficFlow::inTheWay(const Disc& disc, const Agent& other, double margin) {
    return std::any_of(other.discs.begin(), other.discs.end(), [&](const Disc& q) {
        return std::abs(disc.at.z - q.at.z) < kLevel &&
               glm::distance(glm::dvec2(disc.at), glm::dvec2(q.at)) <
                   disc.radius + q.radius + margin;
    });
}

bool TrafficFlow::inTheWay(const std::vector<Disc>& discs, const Agent& other, double margin) {
    return std::any_of(discs.begin(), discs.end(),
                       [&](const Disc& disc) { return inTheWay(disc, other, margin); });
}

bool TrafficFlow::meets(std::size_t i, std::size_t j) const {
    return inTheWay(m_agents[i].discs, m_agents[j], kTouch);
}

void TrafficFlow::findPlaces(std::size_t i, std::size_t j) {
    Agent& a = m_agents[i];
    Agent& b = m_agents[j];
    if (a.person && b.person)
        return;
    const double reach = a.size.half + b.size.half + kRoom;
    for (const Meeting& meeting : meetings(a.way, b.way, reach, kLevel)) {
        a.interacts = b.interacts = true;
        Place place{{i, j}, {meeting.first, meeting.second}};
        if (meeting.along) {
            // Who starts on the shared stretch has entered it.
            if (meeting.first.from <= 0.0 && meeting.second.from <= 0.0)
                continue;
            for (Stretch& stretch : place.stretch)
                stretch.to = std::min(stretch.to, stretch.from + kMerging);
        }
        a.places.push_back(m_places.size());
        b.places.push_back(m_places.size());
        m_places.push_back(place);
    }
}

/// Gives a place to an agent, and all that it enters before it has left that one; or none.
bool TrafficFlow::takes(std::size_t agent, std::size_t first) {
    const Agent& a = m_agents[agent];
    const auto sideOf = [&](const Place& p) { return p.agent[0] == agent ? 0 : 1; };
    const Place& wanted = m_places[first];
    double until = wanted.stretch[sideOf(wanted)].to;
    std::vector<std::size_t> all;
    for (bool grown = true; grown;) {
        grown = false;
        for (const std::size_t p : a.places) {
            const Place& place = m_places[p];
            const Stretch& mine = place.stretch[sideOf(place)];
            const bool known = std::find(all.begin(), all.end(), p) != all.end();
            if (known || mine.to <= a.tail() ||
                mine.from > until + a.size.front + a.size.rear + kLine)
                continue;
            if (mine.from < wanted.stretch[sideOf(wanted)].from && a.nose() <= mine.from)
                continue;  // comes before: asked for by itself
            all.push_back(p);
            until = std::max(until, mine.to);
            grown = true;
        }
    }
    for (const std::size_t p : all) {
        if (m_places[p].holder == 1 - sideOf(m_places[p]))
            return false;
    }
    for (const std::size_t p : all)
        m_places[p].holder = sideOf(m_places[p]);
    return true;
}

void TrafficFlow::updatePlaces() {
    for (std::size_t p = 0; p < m_places.size(); ++p) {
        Place& place = m_places[p];
        bool inside[2], asks[2], canStop[2];
        for (int side = 0; side < 2; ++side) {
            const Agent& agent = m_agents[place.agent[side]];
            const Stretch& stretch = place.stretch[side];
            const double before = stretch.from - agent.nose();
            inside[side] = before < 0.0 && agent.tail() < stretch.to;
            const double sight =
                agent.person ? kPersonsSight : agent.brakingDistance() + kLine + agent.speed + 1.0;
            asks[side] = before >= 0.0 && before <= sight && agent.drive->speed > 0.0;
            canStop[side] = before - agent.brakingDistance() >= 0.3;
            if (!asks[side])
                place.asked[side] = -1.0;
            else if (place.asked[side] < 0.0)
                place.asked[side] = m_time;
        }
        if (place.holder >= 0 && !inside[place.holder] && !asks[place.holder]) {
            const Agent& holder = m_agents[place.agent[place.holder]];
            if (holder.tail() >= place.stretch[place.holder].to)
                place.holder = -1;  // has left it
        }
        for (int side = 0; side < 2; ++side) {
            if (place.holder < 0 && inside[side])
                place.holder = side;
        }
        const int person = m_agents[place.agent[0]].person   ? 0
                           : m_agents[place.agent[1]].person ? 1
                                                             : -1;
        // A vehicle that has the place, but not reached it, leaves it to people.
        if (person >= 0 && asks[person] && place.holder == 1 - person && !inside[1 - person] &&
            canStop[1 - person])
            place.holder = -1;
        if (place.holder >= 0)
            continue;
        // People go first, but not before a vehicle that can no longer stop.
        const int first = person < 0                                 ? -1
                          : asks[1 - person] && !canStop[1 - person] ? 1 - person
                                                                     : person;
        int order[2] = {0, 1};
        const bool secondFirst =
            first == 1 || (first < 0 && asks[1] && (!asks[0] || place.asked[1] < place.asked[0]));
        if (secondFirst)
            std::swap(order[0], order[1]);
        for (const int side : order) {
            if (asks[side] && place.holder < 0 && takes(place.agent[side], p))
                break;
        }
    }
}

/// Metres to where it must stop for places that are not its own.
double TrafficFlow::freeOfPlaces(std::size_t i) const {
    const Agent& agent = m_agents[i];
    double gap = 1e9;
    for (const std::size_t p : agent.places) {
        const Place& place = m_places[p];
        const int side = place.agent[0] == i ? 0 : 1;
        const double before = place.stretch[side].from - agent.nose();
        if (before < 0.0 || place.holder == side || m_blind[place.agent[0]][place.agent[1]])
            continue;
        gap = std::min(gap, std::max(0.0, before - (agent.person ? kPersonsLine : kLine)));
    }
    return gap;
}

/// Metres to where it must stop for somebody who is on its way now.
double TrafficFlow::freeAhead(std::size_t i) const {
    const Agent& agent = m_agents[i];
    const double sight = agent.brakingDistance() + Timetable::kGap + 2.0;
    const Route& route = *agent.drive->route;
    const double first = agent.nose() - std::min(agent.size.half, agent.size.front);
    double gap = 1e9;
    for (std::size_t j = 0; j < m_agents.size(); ++j) {
        const Agent& other = m_agents[j];
        if (j == i || m_blind[i][j] || (agent.person && other.person) || !other.interacts)
            continue;
        const double around = agent.size.front + other.size.front + other.size.rear + sight + 10.0;
        if (glm::distance(agent.discs.front().at, other.discs.front().at) >
            around + agent.size.rear)
            continue;
        for (double d = 0.25; d <= sight + Timetable::kGap; d += 0.25) {
            const Disc there{pointOn(route, first + d), agent.size.half};
            const bool met = inTheWay(there, other, 0.5 * kRoom);
            if (met) {
                gap = std::min(
                    gap, std::max(0.0, d - 0.25 - (agent.person ? kPersonsLine : Timetable::kGap)));
                break;
            }
        }
    }
    return gap;
}

void TrafficFlow::move(std::size_t i) {
    constexpr double dt = Timetable::kStep;
    Agent& agent = m_agents[i];
    const double steady = agent.drive->speed;
    const double end = agent.drive->route->length();
    if (!(steady > 0.0) || agent.station >= end)
        return;
    const double gap = std::min(freeOfPlaces(i), freeAhead(i));
    double speed = std::min(agent.person ? steady : agent.speed + kStarting * dt, steady);
    speed = agent.person ? (gap < speed * dt ? 0.0 : speed) : std::min(speed, speedWithin(gap));
    const double next = std::min(agent.station + speed * dt, end);
    const double before = agent.station;
    agent.station = next;
    std::vector<Disc> discs = discsAt(agent, agent.middle());
    for (std::size_t j = 0; j < m_agents.size(); ++j) {
        if (j == i || (agent.person && m_agents[j].person) || !m_agents[j].interacts)
            continue;
        const bool touches = inTheWay(discs, m_agents[j], kTouch);
        if (m_blind[i][j]) {
            m_blind[i][j] = m_blind[j][i] = touches;
        } else if (touches) {
            agent.station = before;
            agent.speed = 0.0;
            return;
        }
    }
    agent.speed = speed;
    agent.discs = std::move(discs);
    if (next - before > kMoved)
        m_idle = 0;
}

void TrafficFlow::advance() {
    ++m_idle;
    updatePlaces();
    for (std::size_t i = 0; i < m_agents.size(); ++i) {
        if (m_agents[i].interacts)
            move(i);
    }
    m_time += Timetable::kStep;
}

}  // namespace reflet
