// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/reflection/LocalMapPass.h"

#include <future>
#include <map>
#include <set>
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
    static constexpr std::size_t kAll = std::size_t(-1);
    /// How much may be drawn at once. Maps beyond it stay as they are if there are any of the
    /// method: those are drawn first whose body has moved most as seen from the eye.
    struct Budget {
        glm::dvec3 eye{0.0};
        std::size_t texels = kAll;
    };
    /// Chooses which maps are drawn, and lets another thread trace them: between this and finish()
    /// nothing of the pass may be set. Maps that are not wanted this time are dropped.
    void begin(std::span<const Wanted> wanted, const LocalMapPass& pass, const Budget& budget);
    /// One map for each that was wanted, in order.
    [[nodiscard]] std::vector<GpuLocalMap> finish(LocalMapPass& pass, CityPass* city);

    /// Indices of those that the last finish() drew; the others were kept.
    [[nodiscard]] const std::vector<std::size_t>& drawn() const { return m_drawn; }

private:
    using Key = std::tuple<std::string, std::size_t, Method>;
    struct Entry {
        LocalMapRequest request;
        GpuLocalMap map;
    };
    [[nodiscard]] static bool serves(const Entry& entry, const LocalMapRequest& request);
    /// Which of those that have a map that does not quite serve are drawn anew.
    [[nodiscard]] std::set<Key> chosen(std::span<const Wanted> wanted, const Budget& budget) const;

    /// What begin() leaves to finish().
    struct Update {
        std::vector<Key> keys;          ///< of what was wanted
        std::vector<GpuLocalMap> maps;  ///< those that are kept
        std::map<Key, Entry> kept;
        std::vector<LocalMapRequest> requests;  ///< of those to draw: m_drawn
        std::future<LocalMapPass::Traced> traced;
    };

    std::map<Key, Entry> m_maps;
    std::vector<std::size_t> m_drawn;
    Update m_update;
};

}  // namespace reflet
