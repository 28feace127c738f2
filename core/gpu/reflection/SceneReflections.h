// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/reflection/BodyPass.h"
#include "core/gpu/reflection/DetailPlanner.h"
#include "core/gpu/reflection/MapBodiesPass.h"
#include "core/gpu/reflection/ReflectionMaps.h"
#include "core/gpu/reflection/VisibleBodies.h"

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// A body in the picture, with where it may be seen.
struct SceneBody {
    DrawnBody drawn;
    std::string reflector;
    glm::dvec3 mapCenter{0.0};
    glm::dvec3 vehicleMiddle{0.0};
    ViewColumns columns;
    float pixels = 0.0F;  ///< of the picture that it may take along its longest edge
    double interest = 1.0;
};

/// The local maps of all bodies of a picture, on both sides of the wipe: which are drawn, how
/// finely and when, and the other vehicles in them. Belongs to a SceneRenderer.
class SceneReflections {
public:
    void setCity(std::shared_ptr<const DrawnCity> city);
    /// City, light or REMs are others: all maps are drawn again.
    void invalidate();

    /// Tells how far bodies moved since the last picture: DrawnBody::smear. First of all.
    void smear(const FrameRequest& request, std::span<SceneBody> bodies);
    /// Begins the maps of all bodies left of the split, then of all right of it.
    void begin(const FrameRequest& request, std::span<const SceneBody> bodies, float split,
               const LocalMapPass& pass, FrameStatistics& statistics);
    /// The maps of all bodies left of the split, then right of it; those not seen there are empty.
    [[nodiscard]] std::vector<GpuLocalMap> finish(LocalMapPass& pass, CityPass* city,
                                                  FrameStatistics& statistics);
    /// Draws all other vehicles into the maps of both sides, where a map shows the city only.
    void drawIntoMaps(const FrameRequest& request, VehicleMeshes& vehicles, MapBodiesPass& pass,
                      BodyPass& bodyPass, std::vector<GpuLocalMap>& maps);
    /// The last: what the picture took.
    void took(const FrameStatistics& statistics);

private:
    void want(const FrameRequest& request, std::size_t body, Method method, std::size_t place,
              FrameStatistics& statistics);
    void planDetails(const FrameRequest& request);
    void count(FrameStatistics& statistics) const;
    void drawSide(const FrameRequest& request, std::size_t first,
                  std::span<const MapBodiesPass::Other> others, MapBodiesPass& pass,
                  BodyPass& bodyPass, std::vector<GpuLocalMap>& maps);

    ReflectionMaps m_maps;
    DetailPlanner m_planner;
    std::vector<SceneBody> m_bodies;               ///< of this picture
    std::vector<DetailPlanner::Choice> m_choices;  ///< of the same; empty: no level of detail
    std::vector<ReflectionMaps::Wanted> m_wanted;
    std::vector<std::size_t> m_places;  ///< of what is wanted: body, or body + all for the right
    std::vector<bool> m_isNew;          ///< of the same: drawn in this picture
    std::size_t m_leftMaps = 0;         ///< how many of them are left of the split
    double m_copyUnits = 0.0;           ///< of other vehicles in maps, of this picture
    std::map<std::pair<std::string, std::size_t>, glm::dvec3> m_centers;  ///< of the last picture
};

}  // namespace reflet
