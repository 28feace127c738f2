// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/AmbientVolume.h"
#include "core/base/JobContext.h"
#include "core/gpu/Frame.h"
#include "core/gpu/city/CityView.h"

#include <memory>
#include <span>
#include <vector>

namespace reflet {

class Program;

/// Where a view of the city is drawn to: textures of the view's size, without multisampling.
struct CityTargets {
    unsigned radiance = 0;  ///< RGBA16F or RGBA32F: linear radiance, alpha 1
    unsigned depth = 0;     ///< DEPTH32F_STENCIL8: reversed depth (CityView); the stencil is used
    /// R32F, or 0 = not wanted: Euclidean distance from the eye in metres, +infinity for sky.
    unsigned distance = 0;
};

/// A body that throws a shadow on the city for one frame.
struct ShadowCaster {
    /// A range of the indices that is the whole body.
    struct Level {
        float error = 0.0F;  ///< metres by which surfaces may lie elsewhere, about
        int firstIndex = 0;
        int indexCount = 0;
    };
    unsigned vertexArray = 0;   ///< positions at location 0, indices of 32 bits
    std::vector<Level> levels;  ///< at least one; errors rise
    glm::mat4 project_from_body{1.0F};
    Box bounds;  ///< project frame
    Box box;     ///< the same, but body frame: tight
};

struct CityStatistics {
    std::size_t triangles = 0;        ///< handed to the GPU for the view
    std::size_t shadowTriangles = 0;  ///< and for shadow maps that had to be drawn anew
};

/// The city's geometry and looks prepared for the GPU, without any OpenGL: build it on any thread.
/// Of the city, its model, looks and textures are needed. null: the job was cancelled.
struct CityMesh;
[[nodiscard]] std::shared_ptr<const CityMesh> buildCityMesh(
    const std::shared_ptr<const DrawnCity>& city, const JobContext& job = {});

/// Draws the city and its sky, lit by sun and sky, as RadianceScene::shade sees them. Belongs to
/// the thread and context in which it was made.
///
/// Deferred: one pass writes the triangle of each pixel and marks the kind of its look in the
/// stencil buffer, then one full-screen pass for each kind shades just its pixels; a pixel is
/// shaded once, however deep the city is.
class CityPass {
public:
    /// Compiles the shaders; Internal with the driver's words when one does not compile.
    [[nodiscard]] static Result<std::unique_ptr<CityPass>> create();
    ~CityPass();
    CityPass(const CityPass&) = delete;
    CityPass& operator=(const CityPass&) = delete;

    /// null: no city, only sky (and below the horizon its haze). Builds the mesh when the city has
    /// none, which takes some 100 ms for a large city.
    void setCity(const std::shared_ptr<const DrawnCity>& city);
    void setLighting(const Lighting& lighting);
    /// null: the open sky everywhere.
    void setAmbient(const std::shared_ptr<const AmbientVolume>& ambient);

    /// Once before the views of a frame: draws the sun's shadow maps around `focus` (those that
    /// changed) and the shadows of moving bodies. moving: the picture is one of a movement, for
    /// which software may draw the city's shadows in parts, over several pictures.
    CityStatistics prepareShadows(const glm::dvec3& focus, std::span<const ShadowCaster> casters,
                                  bool moving = false);
    /// Draws a view, overwriting the targets. A view that comes again is not drawn anew: of a
    /// picture that is kept, only what moving bodies may shadow is shaded (unless the distance is
    /// wanted too), with the same result. Leaves the targets' framebuffer unbound, depth and
    /// stencil test off, and any program bound.
    CityStatistics draw(const CityView& view, const CityTargets& targets);

    /// Binds what `#include "city_light.glsl"` needs for shading other bodies in the same light:
    /// texture units kFirstLightUnit.. and the uniform block CityLight at kLightBinding.
    void bindLight() const;

    static constexpr unsigned kFirstLightUnit = 10;  ///< to 13
    static constexpr unsigned kLightBinding = 7;     ///< of GL_UNIFORM_BUFFER

private:
    CityPass();
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
