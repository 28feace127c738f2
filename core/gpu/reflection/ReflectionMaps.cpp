// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/ReflectionMaps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace reflet {

bool ReflectionMaps::serves(const Entry& entry, const LocalMapRequest& request) {
    return entry.request.settings == request.settings && entry.request.given == request.given &&
           glm::distance(entry.request.position, request.position) <= kReuseDistance;
}

std::set<ReflectionMaps::Key> ReflectionMaps::chosen(std::span<const Wanted> wanted,
                                                     const Budget& budget) const {
    struct Stale {
        double angle;  // radians by which its place has moved, as seen from the eye
        std::size_t texels;
        Key key;
    };
    std::set<Key> keys;
    std::vector<Stale> stale;
    std::size_t spent = 0;
    for (const Wanted& w : wanted) {
        const Key key{w.reflector, w.body, w.request.method};
        const auto edge = std::size_t(std::max(w.request.settings.resolution, 1));
        const auto known = m_maps.find(key);
        if (known == m_maps.end()) {
            spent += 6 * edge * edge;
            continue;
        }
        const Entry& entry = known->second;
        if (serves(entry, w.request))
            continue;
        const double away = std::max(glm::distance(w.request.position, budget.eye), 1.0);
        const double moved = glm::distance(entry.request.position, w.request.position);
        stale.push_back({moved / away, 6 * edge * edge, key});
    }
    std::stable_sort(stale.begin(), stale.end(),
                     [](const Stale& a, const Stale& b) { return a.angle > b.angle; });
    for (const Stale& s : stale) {
        // One at least, or a map that is dearer than the budget would never be drawn.
        if (!keys.empty() && (spent >= budget.texels || s.texels > budget.texels - spent))
            break;
        spent += s.texels;
        keys.insert(s.key);
    }
    return keys;
}

void ReflectionMaps::begin(std::span<const Wanted> wanted, const LocalMapPass& pass,
                           const Budget& budget) {
    const std::set<Key> due = chosen(wanted, budget);
    m_drawn.clear();
    m_update = {};
    Update& update = m_update;
    update.maps.resize(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Wanted& w = wanted[i];
        const Key key{w.reflector, w.body, w.request.method};
        update.keys.push_back(key);
        const auto known = m_maps.find(key);
        if (known != m_maps.end() && !due.contains(key)) {
            update.maps[i] = known->second.map;
            update.maps[i].center = w.request.position;  // an older map goes with its body
            update.kept.insert(m_maps.extract(known));
        } else if (update.kept.contains(key)) {
            update.maps[i] = update.kept.at(key).map;  // wanted twice
        } else {
            m_drawn.push_back(i);
            update.requests.push_back(w.request);
        }
    }
    if (!update.requests.empty()) {
        update.traced = std::async(std::launch::async, [&pass, requests = update.requests] {
            return pass.trace(requests);
        });
    }
}

std::vector<GpuLocalMap> ReflectionMaps::finish(LocalMapPass& pass, CityPass* city) {
    Update update = std::exchange(m_update, {});
    // Textures of maps that nobody wants any more are drawn over, if nobody else holds them.
    std::vector<std::shared_ptr<Texture>> reuse;
    for (auto& [key, entry] : m_maps) {
        if (auto texture = entry.map.owned; texture)
            reuse.push_back(std::move(texture));
    }
    m_maps.clear();
    if (!update.requests.empty()) {
        const LocalMapPass::Traced traced = update.traced.get();
        const std::vector<GpuLocalMap> drawn =
            pass.draw(update.requests, traced, city, std::move(reuse));
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            const std::size_t i = m_drawn[k];
            update.maps[i] = drawn[k];
            update.kept.insert_or_assign(update.keys[i], Entry{update.requests[k], drawn[k]});
        }
    }
    m_maps = std::move(update.kept);
    return std::move(update.maps);
}

}  // namespace reflet
