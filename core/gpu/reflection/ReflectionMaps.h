// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/reflection/LocalMapPass.h"

#include <map>
#include <tuple>

namespace reflet {

/// The local maps of the bodies in a picture, kept from frame to frame. A map is drawn anew when
/// its body has moved by more than kReuseDistance, when its tuning or given map is another, and
/// after invalidate().
class ReflectionMaps {
public:
    /// Metres. At 2 m from a wall the parallax of 2 cm is half a degree: a texel of a 128² face.
    static constexpr double kReuseDistance = 0.02;

    /// Something that everything depends on has changed: city, light or REMs.
    void invalidate() { m_maps.clear(); }

    struct Wanted {
        std::string reflector;
        std::size_t body = 0;
        LocalMapRequest request;
    };
    /// One map for each, in order. Maps that were not wanted this time are dropped.
    [[nodiscard]] std::vector<GpuLocalMap> update(std::span<const Wanted> wanted,
                                                  LocalMapPass& pass, CityPass* city);

    /// Indices of those that the last update drew; the others were kept.
    [[nodiscard]] const std::vector<std::size_t>& drawn() const { return m_drawn; }

private:
    using Key = std::tuple<std::string, std::size_t, Method>;
    struct Entry {
        LocalMapRequest request;
        GpuLocalMap map;
    };
    [[nodiscard]] static bool serves(const Entry& entry, const LocalMapRequest& request);

    std::map<Key, Entry> m_maps;
    std::vector<std::size_t> m_drawn;
};

}  // namespace reflet
