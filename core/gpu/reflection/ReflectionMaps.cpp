// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/ReflectionMaps.h"

#include <glm/geometric.hpp>

namespace reflet {

bool ReflectionMaps::serves(const Entry& entry, const LocalMapRequest& request) {
    return entry.request.settings == request.settings && entry.request.given == request.given &&
           glm::distance(entry.request.position, request.position) <= kReuseDistance;
}

std::vector<GpuLocalMap> ReflectionMaps::update(std::span<const Wanted> wanted, LocalMapPass& pass,
                                                CityPass* city) {
    m_drawn.clear();
    std::vector<GpuLocalMap> maps(wanted.size());
    std::map<Key, Entry> kept;
    std::vector<LocalMapRequest> requests;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Wanted& w = wanted[i];
        const Key key{w.reflector, w.body, w.request.method};
        const auto known = m_maps.find(key);
        if (known != m_maps.end() && serves(known->second, w.request)) {
            maps[i] = known->second.map;
            kept.insert(m_maps.extract(known));
        } else if (kept.contains(key)) {
            maps[i] = kept.at(key).map;  // wanted twice
        } else {
            m_drawn.push_back(i);
            requests.push_back(w.request);
        }
    }
    // Textures of maps that nobody wants any more are drawn over, if nobody else holds them.
    std::vector<std::shared_ptr<Texture>> reuse;
    for (auto& [key, entry] : m_maps) {
        if (auto texture = entry.map.owned; texture)
            reuse.push_back(std::move(texture));
    }
    m_maps.clear();
    const std::vector<GpuLocalMap> drawn = pass.draw(requests, city, std::move(reuse));
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        const Wanted& w = wanted[m_drawn[k]];
        maps[m_drawn[k]] = drawn[k];
        kept.insert_or_assign({w.reflector, w.body, w.request.method}, Entry{w.request, drawn[k]});
    }
    m_maps = std::move(kept);
    return maps;
}

}  // namespace reflet
