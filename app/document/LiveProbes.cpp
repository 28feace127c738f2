// SPDX-License-Identifier: GPL-3.0-or-later
// LiveCity's reflection probes: which maps they have, which they should have, and the way there.
#include "app/document/LiveCity.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/base/BackgroundWork.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

const QString kProbeLane = QStringLiteral("probes");
/// Maps that are read between two publications.
constexpr std::size_t kReadAtOnce = 8;

using Maps = std::vector<std::pair<std::string, RemSet::Pointer>>;

/// A refusal, with the nearest place where the probe could stand.
struct Refusal {
    Error error;
    std::optional<glm::dvec3> freePlace;
};
struct Baked {
    RemSet::Pointer map;
    std::optional<Refusal> refusal;
};

Result<Baked> bake(const PreparedCity& city, const Probe& probe, const JobContext& job) {
    auto map = bakeProbe(city, probe, job);
    if (map)
        return Baked{std::move(*map), std::nullopt};
    if (map.error().code != ErrorCode::Refused)
        return tl::unexpected(map.error());
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    auto free = nearestFreePosition(**scene, &city.heightfield(), city.inFrame(probe.position));
    if (free)
        *free += city.project().frame.origin;
    return Baked{nullptr, Refusal{map.error(), free}};
}

}  // namespace

ProbeState LiveCity::probeState(const std::string& id) const {
    const auto found = m_records.find(id);
    if (found == m_records.end())
        return ProbeState::Missing;
    const Record& record = found->second;
    if (record.map && record.mapKey == record.wanted)
        return ProbeState::Fresh;
    if (!m_bakingId.empty() && m_bakingId == id && m_bakingKey == record.wanted)
        return ProbeState::Baking;
    if (record.refused == record.wanted && !record.wanted.empty())
        return ProbeState::Refused;
    return record.map ? ProbeState::Stale : ProbeState::Missing;
}

QString LiveCity::probeProblem(const std::string& id) const {
    return probeState(id) == ProbeState::Refused ? m_records.at(id).reason : QString();
}

std::optional<glm::dvec3> LiveCity::freePlace(const std::string& id) const {
    return probeState(id) == ProbeState::Refused ? m_records.at(id).freePlace : std::nullopt;
}

std::shared_ptr<const ReferenceEnvironmentMap> LiveCity::rem(const std::string& id) const {
    const auto found = m_records.find(id);
    return found != m_records.end() ? found->second.map : nullptr;
}

bool LiveCity::baking() const {
    return !m_bakingId.empty();
}

int LiveCity::probesToBake() const {
    return int(std::count_if(m_document.project().probes.begin(), m_document.project().probes.end(),
                             [&](const Probe& probe) {
                                 const ProbeState state = probeState(probe.id);
                                 return state != ProbeState::Fresh && state != ProbeState::Refused;
                             }));
}

void LiveCity::setAutoBake(bool on) {
    m_autoBake = on;
    if (on) {
        m_stopped = false;
        pump();
    } else if (!m_bakeAll && baking()) {
        stopBaking();
        Q_EMIT probeStatesChanged();
    }
}

void LiveCity::bakeNow() {
    m_bakeAll = true;
    m_stopped = false;
    pump();
}

void LiveCity::cancelBaking() {
    m_stopped = true;
    m_bakeAll = false;
    stopBaking();
    Q_EMIT probeStatesChanged();
}

void LiveCity::stopBaking() {
    const bool was = baking();
    m_jobs.cancelLane(kProbeLane);
    m_bakingId.clear();
    m_bakingKey.clear();
    m_reading = false;
    if (was)
        Q_EMIT bakingChanged();
}

/// Says which map each probe should have now, and drops what belongs to no probe any more.
void LiveCity::matchProbes() {
    if (!m_prepared || m_loading)
        return;
    std::map<std::string, Record> records;
    for (const Probe& probe : m_document.project().probes) {
        Record& record = records[probe.id];
        if (const auto before = m_records.find(probe.id); before != m_records.end())
            record = std::move(before->second);
        record.wanted = probeKey(*m_prepared, probe);
    }
    m_records = std::move(records);
    const auto baked = m_records.find(m_bakingId);
    if (baking() && (baked == m_records.end() || baked->second.wanted != m_bakingKey))
        stopBaking();
    publishRems();
    Q_EMIT probeStatesChanged();
    m_settle.start();
}

void LiveCity::publishRems() {
    RemSet rems;
    for (const Probe& probe : m_document.project().probes) {
        const auto found = m_records.find(probe.id);
        if (found != m_records.end() && found->second.map)
            rems.add(found->second.map);
    }
    if (rems == m_rems)
        return;
    m_rems = std::move(rems);
    Q_EMIT remsChanged();
}

const Probe* LiveCity::probe(const std::string& id) const {
    const auto& probes = m_document.project().probes;
    const auto found = std::find_if(probes.begin(), probes.end(),
                                    [&](const Probe& probe) { return probe.id == id; });
    return found != probes.end() ? &*found : nullptr;
}

/// Takes the next step towards all maps being fresh, unless one is being taken.
void LiveCity::pump() {
    if (!m_prepared || m_loading || m_reading || m_held.isActive() || m_document.isDragging()) {
        if (m_document.isDragging())
            m_settle.start();
        return;
    }
    readCached();
    if (!m_reading && !baking() && !m_stopped && (m_autoBake || m_bakeAll))
        bakeNext();
}

void LiveCity::readCached() {
    std::vector<Probe> probes;
    for (const Probe& probe : m_document.project().probes) {
        const Record& record = m_records[probe.id];
        if (record.mapKey != record.wanted && record.looked != record.wanted &&
            probes.size() < kReadAtOnce) {
            probes.push_back(probe);
        }
    }
    if (probes.empty() || baking())
        return;
    m_reading = true;
    m_jobs.run<Maps>(
        {tr("Reading baked maps"), kProbeLane, true, false},
        [city = m_prepared, probes](const JobContext& job) -> Result<Maps> {
            Maps maps(probes.size());
            for (std::size_t i = 0; i < probes.size(); ++i)
                maps[i].first = probeKey(*city, probes[i]);
            auto read = cachedRems(*city, probes, job);
            keepRems(*city, probes, read, job);
            for (std::size_t i = 0; i < probes.size(); ++i)
                maps[i].second = std::move(read[i]);
            return maps;
        },
        this,
        [this, probes](Result<Maps> maps) {
            if (!maps && maps.error().code == ErrorCode::Cancelled)
                return;
            m_reading = false;
            for (std::size_t i = 0; i < probes.size(); ++i) {
                const auto found = m_records.find(probes[i].id);
                if (found == m_records.end())
                    continue;
                if (maps && (*maps)[i].second) {
                    accept(probes[i].id, (*maps)[i].first, (*maps)[i].second);
                } else {
                    found->second.looked = maps ? (*maps)[i].first : found->second.wanted;
                }
            }
            publishRems();
            Q_EMIT probeStatesChanged();
            pump();
        });
}

/// The map is put to use when it is what the probe should have.
void LiveCity::accept(const std::string& id, const std::string& key, RemSet::Pointer map) {
    const auto found = m_records.find(id);
    if (found == m_records.end() || found->second.wanted != key)
        return;
    discard(std::exchange(found->second.map, std::move(map)));
    found->second.mapKey = key;
}

void LiveCity::refuse(const std::string& id, const std::string& key, const Error& error) {
    const auto found = m_records.find(id);
    if (found == m_records.end())
        return;
    found->second.refused = key;
    found->second.reason = QString::fromStdString(error.what);
    if (!error.remedy.empty())
        found->second.reason += QStringLiteral(". ") + QString::fromStdString(error.remedy);
}

/// The nearest to the selected vehicle, or to the first.
const Probe* LiveCity::nextToBake() const {
    std::optional<glm::dvec3> place;
    if (m_traffic->size() > 0) {
        std::size_t index = 0;
        for (const ProjectItem& item : m_document.selection()->items()) {
            if (item.kind != ProjectItem::Kind::Reflector)
                continue;
            if (const auto found = m_traffic->find(item.id))
                index = *found;
        }
        place = m_traffic->at(index, 0.0).middle() + m_document.project().frame.origin;
    }
    const Probe* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Probe& probe : m_document.project().probes) {
        const ProbeState state = probeState(probe.id);
        if (state != ProbeState::Missing && state != ProbeState::Stale)
            continue;
        // A probe that was just moved comes before all others: somebody is looking at it.
        const bool selected =
            m_document.selection()->contains({ProjectItem::Kind::Probe, probe.id});
        const double distance =
            selected ? -1.0 : (place ? glm::distance(*place, probe.position) : 0.0);
        if (best == nullptr || distance < least) {
            best = &probe;
            least = distance;
        }
    }
    return best;
}

void LiveCity::bakeNext() {
    const Probe* next = nextToBake();
    if (next == nullptr) {
        m_bakeAll = false;
        return;
    }
    const int left = probesToBake();
    m_bakingId = next->id;
    m_bakingKey = m_records[next->id].wanted;
    const QString title = left > 1 ? tr("Baking reflection probes (%1 to go)").arg(left)
                                   : tr("Baking a reflection probe");
    m_jobs.run<Baked>(
        {title, kProbeLane},
        [city = m_prepared, probe = *next](const JobContext& job) {
            return resultInBackground(
                [&] { return bake(*city, probe, job.phase(probe.id, 0.0, 1.0)); });
        },
        this,
        [this, id = m_bakingId, key = m_bakingKey](Result<Baked> baked) {
            if (!baked && baked.error().code == ErrorCode::Cancelled) {
                // Cancelled in the list of jobs, not by a change: that means stop.
                if (m_bakingId == id && m_bakingKey == key)
                    cancelBaking();
                return;
            }
            m_bakingId.clear();
            m_bakingKey.clear();
            if (baked && baked->map) {
                accept(id, key, baked->map);
            } else if (baked && baked->refusal) {
                refuse(id, key, baked->refusal->error);
                if (const auto found = m_records.find(id); found != m_records.end())
                    found->second.freePlace = baked->refusal->freePlace;
            } else {
                m_stopped = true;
                m_bakeAll = false;
                Q_EMIT problem(baked.error());
            }
            publishRems();
            Q_EMIT probeStatesChanged();
            pump();
            if (!baking())
                Q_EMIT bakingChanged();
        });
    Q_EMIT probeStatesChanged();
    Q_EMIT bakingChanged();
}

}  // namespace reflet
