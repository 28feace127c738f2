// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/ReflectionMaps.h"

#include "core/base/Stopwatch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

/// Of a map of another tuning or quality: as if its body had moved this many times too far.
constexpr double kOtherTuning = 8.0;
constexpr double kOtherQuality = 1.0;
/// Metres from where a map was made beyond which its distances say nothing about a body.
constexpr double kElsewhere = 6.0;

/// What a map without a level of detail has is all that was tuned.
Detail detailOf(const ReflectionMaps::Wanted& wanted) {
    Detail full;
    full.resolution = wanted.request.settings.resolution;
    return wanted.detail.value_or(full);
}

/// In place of a map that does not fit into a picture any more.
ReflectionMaps::Wanted substituteOf(ReflectionMaps::Wanted wanted) {
    wanted.detail->blend = true;
    wanted.detail->resolution = std::min(kSmallestMap, wanted.detail->resolution);
    wanted.request.settings = settingsOf(*wanted.detail, wanted.tuned);
    wanted.request.method = needsProbes(wanted.asked) ? Method::Blend : Method::Sky;
    wanted.detail->others = false;
    wanted.units = unitsOf(*wanted.detail);
    return wanted;
}

}  // namespace

/// Whether a map was made for the same tuning, method and given map.
bool ReflectionMaps::isBase(const Entry& entry, const Wanted& wanted) {
    return entry.wanted.tuned == wanted.tuned && entry.wanted.request.given == wanted.request.given;
}

bool ReflectionMaps::sameQuality(const Entry& entry, const Wanted& wanted) {
    if (!isBase(entry, wanted))
        return false;
    if (wanted.detail)
        return detailOf(entry.wanted).atLeast(*wanted.detail);
    return entry.wanted.request.settings == wanted.request.settings &&
           entry.wanted.request.method == wanted.request.method;
}

bool ReflectionMaps::serves(const Entry& entry, const Wanted& wanted) {
    const double reuse = wanted.detail ? wanted.detail->reuse : kReuseDistance;
    return sameQuality(entry, wanted) &&
           glm::distance(entry.wanted.request.position, wanted.request.position) <= reuse;
}

MapUpdate ReflectionMaps::updateOf(const Wanted& wanted, const Entry* entry) const {
    MapUpdate update{0.0, wanted.weight, wanted.units, entry == nullptr};
    if (!entry)
        return update;
    const double reuse = wanted.detail ? wanted.detail->reuse : kReuseDistance;
    update.error = glm::distance(entry->wanted.request.position, wanted.request.position) / reuse;
    if (!isBase(*entry, wanted))
        update.error = std::max(update.error, kOtherTuning);
    else if (!sameQuality(*entry, wanted))
        update.error = std::max(update.error, kOtherQuality);
    return update;
}

std::optional<std::size_t> ReflectionMaps::sharing(std::span<const Wanted> wanted, std::size_t i,
                                                   std::span<const std::size_t> candidates) const {
    const Wanted& own = wanted[i];
    if (!own.detail)
        return std::nullopt;
    for (const std::size_t k : candidates) {
        const Wanted& other = wanted[k];
        if (k == i || !other.detail || other.asked != own.asked)
            continue;
        // Kept maps count where they were drawn, the others where they are going to be.
        const auto known = m_maps.find(m_update.keys[k]);
        const bool kept = m_update.sources[k].kind == Source::Kind::Kept;
        const Entry entry = kept ? Entry{known->second.wanted, {}} : Entry{other, {}};
        if (serves(entry, own))
            return k;
    }
    return std::nullopt;
}

void ReflectionMaps::draw(const Wanted& wanted, std::size_t i) {
    m_update.sources[i] = {Source::Kind::Drawn, m_update.drawn.size()};
    m_update.drawn.push_back(wanted);
    m_update.requests.push_back(wanted.request);
    m_report.drawn.push_back(i);
    m_report.units += wanted.detail ? unitsOf(*wanted.detail) : 0.0;
}

void ReflectionMaps::choose(std::span<const Wanted> wanted, double units) {
    std::vector<std::size_t> fresh, open;
    std::map<Key, std::size_t> first;
    const auto entryOf = [&](std::size_t i) {
        const auto known = m_maps.find(m_update.keys[i]);
        return known == m_maps.end() ? nullptr : &known->second;
    };
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Entry* entry = entryOf(i);
        Source& source = m_update.sources[i];
        if (const auto [same, isNew] = first.try_emplace(m_update.keys[i], i); !isNew) {
            source = {Source::Kind::Same, same->second};
        } else if (wanted[i].hidden) {
            source.kind = entry ? Source::Kind::Kept : Source::Kind::None;
        } else if (entry && serves(*entry, wanted[i])) {
            source.kind = Source::Kind::Kept;
            fresh.push_back(i);
        } else {
            open.push_back(i);
        }
    }
    const auto share = [&](std::size_t i, std::span<const std::size_t> with) {
        const auto other = sharing(wanted, i, with);
        if (other) {
            m_update.sources[i] = {Source::Kind::Same, *other};
            m_report.shared.push_back(i);
        }
        return other.has_value();
    };
    std::erase_if(open, [&](std::size_t i) { return share(i, fresh); });

    std::vector<MapUpdate> updates;
    for (const std::size_t i : open)
        updates.push_back(updateOf(wanted[i], entryOf(i)));
    std::vector<std::size_t> drawn;
    std::vector<bool> done(open.size(), false);
    for (const std::size_t k : chooseUpdates(updates, units)) {
        done[k] = true;
        if (share(open[k], drawn))
            continue;
        draw(wanted[open[k]], open[k]);
        drawn.push_back(open[k]);
    }
    for (std::size_t k = 0; k < open.size(); ++k) {
        const std::size_t i = open[k];
        if (done[k] || share(i, drawn))
            continue;
        ++m_report.waiting;
        if (entryOf(i))
            m_update.sources[i].kind = Source::Kind::Kept;
        else
            draw(substituteOf(wanted[i]), i);
    }
}

void ReflectionMaps::begin(std::span<const Wanted> wanted, const LocalMapPass& pass, double units) {
    m_report = {};
    m_update = {};
    m_update.sources.resize(wanted.size());
    for (const Wanted& w : wanted) {
        m_update.keys.emplace_back(w.reflector, w.body, w.asked);
        m_update.positions.push_back(w.request.position);
    }
    choose(wanted, units);
    if (!m_update.requests.empty()) {
        m_update.traced = std::async(std::launch::async, [&pass, requests = m_update.requests] {
            return pass.trace(requests);
        });
    }
}

std::vector<GpuLocalMap> ReflectionMaps::finish(LocalMapPass& pass, CityPass* city) {
    Update update = std::exchange(m_update, {});
    std::map<Key, Entry> kept;
    for (std::size_t i = 0; i < update.keys.size(); ++i) {
        if (update.sources[i].kind == Source::Kind::Kept)
            kept.insert(m_maps.extract(update.keys[i]));
    }
    // Textures of maps that nobody wants any more are drawn over, if nobody else holds them.
    std::vector<std::shared_ptr<Texture>> reuse;
    for (auto& [key, entry] : m_maps) {
        if (auto texture = entry.map.owned; texture)
            reuse.push_back(std::move(texture));
    }
    m_maps.clear();
    std::vector<GpuLocalMap> drawn;
    if (!update.requests.empty()) {
        const Stopwatch watch;
        const LocalMapPass::Traced traced = update.traced.get();
        m_report.waited = 1000.0 * watch.seconds();
        drawn = pass.draw(update.requests, traced, city, std::move(reuse));
    }
    std::vector<GpuLocalMap> maps(update.keys.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Source& source = update.sources[i];
        if (source.kind == Source::Kind::Kept) {
            maps[i] = kept.at(update.keys[i]).map;
        } else if (source.kind == Source::Kind::Drawn) {
            maps[i] = drawn[source.index];
            kept.insert_or_assign(update.keys[i], Entry{update.drawn[source.index], maps[i]});
        }
    }
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (update.sources[i].kind == Source::Kind::Same)
            maps[i] = maps[update.sources[i].index];
    }
    for (std::size_t i = 0; i < maps.size(); ++i) {
        // An older map goes with its body. One with parallax knows what is where it was made, as
        // long as the body has not been put somewhere else.
        const double away = glm::distance(maps[i].center, update.positions[i]);
        if (maps[i].atInfinity || away > kElsewhere)
            maps[i].center = update.positions[i];
    }
    m_maps = std::move(kept);
    return maps;
}

}  // namespace reflet
