// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/AmbientVolume.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/Frame.h"

#include <memory>

namespace reflet {

struct CityMesh;

/// Draws the city with its vehicles and what is laid over them, with OpenGL 4.5 core. Belongs to
/// the thread and the context (any: EGL's, Qt's) in which it was made; that context must be current
/// at every call and when it is destroyed. Leaves no OpenGL state behind that others must know but
/// that the framebuffer, viewport and program bindings may change.
class SceneRenderer {
public:
    /// Compiles the shaders. ResourceLimit for a context below 4.5, with what was found and how
    /// software rendering helps; Internal, with the driver's words, when a shader does not compile;
    /// Usage when REFLET_PROBE_MEMORY has a value that is not known.
    [[nodiscard]] static Result<std::unique_ptr<SceneRenderer>> create();
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// Uploads a city; null = none (only the sky is drawn). Builds its mesh where it has none,
    /// which takes some 100 ms for a large city.
    void setCity(std::shared_ptr<const DrawnCity> city);
    void setLighting(const Lighting& lighting);
    /// Soft light between the buildings; null = open sky everywhere.
    void setAmbient(std::shared_ptr<const AmbientVolume> ambient);
    /// Maps that the new set has in common with the old one are not uploaded again.
    void setRems(const RemSet& rems);

    /// Draws into a framebuffer object of the caller, of the request's size and with an 8-bit
    /// colour attachment; display values (sRGB), rows as OpenGL has them, from the bottom.
    FrameStatistics draw(const FrameRequest& request, unsigned framebuffer);
    /// The same, read back, rows from the top.
    [[nodiscard]] DisplayImage drawImage(const FrameRequest& request,
                                         FrameStatistics* statistics = nullptr);

    /// The local map at a place as this renderer makes it, read back. Not for Method::RayTrace,
    /// which gives the multiple environment maps' answer.
    [[nodiscard]] LocalEnvironmentMap localMap(Method method, const glm::dvec3& position,
                                               const MemSettings& settings);
    /// Milliseconds until that map is made, without reading it back, and without the shadows that
    /// Method::Rerender shares between maps. everyPart: as LocalMapRequest has it.
    [[nodiscard]] double timeLocalMap(Method method, const glm::dvec3& position,
                                      const MemSettings& settings, bool everyPart = false);

    /// A reference map drawn in place of traced (core/gpu/city/CityBaker).
    [[nodiscard]] Result<ReferenceEnvironmentMap> bake(const std::string& id,
                                                       const glm::dvec3& position,
                                                       const BakeSettings& settings);

private:
    SceneRenderer();
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
