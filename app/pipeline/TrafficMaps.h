// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/Traffic.h"

#include <map>
#include <memory>
#include <utility>

namespace reflet {

/// The vehicles as they stand at one moment, and the local maps of their bodies with the other
/// vehicles in them. Bodies are counted through all reflectors, as in BodyGeometry::bodies().
class TrafficMaps {
public:
    /// The city must outlive it.
    [[nodiscard]] static Result<TrafficMaps> create(const PreparedCity& city, const RemSet& rems,
                                                    std::vector<PlacedReflector> reflectors,
                                                    const JobContext& job);

    [[nodiscard]] const std::vector<PlacedBody>& bodies() const { return m_geometry->bodies(); }
    /// With all bodies as occluders.
    [[nodiscard]] const RadianceScene& scene() const { return *m_scene; }
    /// The first body of a reflector.
    [[nodiscard]] std::size_t firstBody(std::size_t reflector) const { return m_first[reflector]; }
    [[nodiscard]] glm::dvec3 center(std::size_t body) const;

    /// A body's map by a method, other vehicles drawn into it (core/rendering/MapBodies) but for
    /// Method::Sky, which is the bare sky. Errors as of reconstruct().
    [[nodiscard]] Result<LocalEnvironmentMap> map(std::size_t body, Method method,
                                                  const JobContext& job);

    /// Gives bodies (those of bodies(), as many) that mirror anything what Method::PerPixel reads.
    /// This must outlive them.
    void lookUpPixels(std::vector<PlacedBody>& bodies);

private:
    TrafficMaps() = default;
    [[nodiscard]] Result<const LocalEnvironmentMap*> cityMap(std::size_t body, Method method,
                                                             const JobContext& job);

    const PreparedCity* m_city = nullptr;
    RemSet m_rems;
    std::vector<PlacedReflector> m_reflectors;
    std::vector<std::size_t> m_first;
    std::unique_ptr<BodyGeometry> m_geometry;
    std::unique_ptr<RadianceScene> m_scene;
    std::map<std::pair<std::size_t, Method>, LocalEnvironmentMap> m_cityMaps;
    std::vector<std::unique_ptr<PixelReflections>> m_pixels;  ///< of each reflector
};

/// Ray-traced maps of all bodies of the reflectors, the others in them, one list for each
/// reflector; empty for those that mirror nothing.
[[nodiscard]] Result<std::vector<std::vector<std::shared_ptr<const LocalEnvironmentMap>>>>
tracedMaps(const PreparedCity& city, const std::vector<PlacedReflector>& reflectors,
           const JobContext& job);

}  // namespace reflet
