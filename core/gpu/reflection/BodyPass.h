// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/Lighting.h"
#include "core/gpu/base/Program.h"
#include "core/gpu/city/CityView.h"
#include "core/gpu/reflection/LocalMapPass.h"
#include "core/gpu/reflection/VehicleMesh.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

class CityPass;

/// A body of a vehicle that stands in the view.
struct DrawnBody {
    const Vehicle* vehicle = nullptr;
    const VehicleMesh::Body* mesh = nullptr;
    VehicleMesh::Level level;  ///< of the mesh
    const Texture* materials = nullptr;
    std::size_t body = 0;
    RigidTransform project_from_body;
    /// The way, project axes, along which what it reflects is smeared; 0: sharp.
    glm::vec3 smear{0.0F};
};

/// The picture that bodies are drawn into; textures of the view's size.
struct BodyTargets {
    const Texture* radiance = nullptr;  ///< RGBA16F
    const Texture* depth = nullptr;     ///< DEPTH32F_STENCIL8, reversed (CityView)
};

/// Draws vehicles with the look of core/rendering/BodyShading: paint under clear coat, chrome,
/// glass that shows the cabin and the street behind it, lights, the sun's glint, and reflections
/// from the bodies' local maps, cross-faded between bodies that are rigidly coupled.
///
/// What the CPU's rays do and this cannot: only the nearest two panes before a thing tint it, and
/// panes of several vehicles one behind another are sorted by vehicle body alone.
class BodyPass {
public:
    [[nodiscard]] static Result<std::unique_ptr<BodyPass>> create();

    void setLighting(const Lighting& lighting);

    /// Whether Part::pixels may be given: the driver has texture units enough (20; OpenGL 4.5 alone
    /// promises 16).
    [[nodiscard]] bool drawsPixels() const { return bool(m_pixels[0]); }

    /// Darkens the ground under and around the bodies, where the sky's light does not reach. The
    /// radiance target must hold the city, the depth target its depth.
    void drawContact(const CityView& view, const BodyTargets& targets,
                     std::span<const DrawnBody> bodies);

    /// maps: one per body. columns: the part [from, to) of the picture that is drawn, in pixels.
    struct Part {
        std::span<const GpuLocalMap> maps;
        int from = 0;
        int to = 0;
        /// For Method::PerPixel: sets what resources/shaders/rem_sight.glsl reads for a body. Then
        /// its maps serve where they show vehicles only: where they differ from cityMaps, the same
        /// without any.
        std::function<void(const Program& program, std::size_t body)> pixels = {};
        std::span<const GpuLocalMap> cityMaps = {};
    };
    /// Draws all bodies in each of the parts. The light must have been bound (CityPass).
    void draw(const CityView& view, const BodyTargets& targets, std::span<const DrawnBody> bodies,
              std::span<const Part> parts);

private:
    BodyPass() = default;
    void resize(int width, int height);
    void drawGlassDepths(const CityView& view, std::span<const DrawnBody> bodies);
    void drawLayer(const CityView& view, std::span<const DrawnBody> bodies, const Part& part,
                   std::span<const std::size_t> order, int layer);
    void setBody(const Program& program, const CityView& view, const DrawnBody& body) const;
    void bindMaps(const Program& program, const CityView& view, std::span<const DrawnBody> bodies,
                  std::span<const GpuLocalMap> maps, std::size_t body);
    void drawDepths(const CityView& view, std::span<const DrawnBody> bodies, bool glass);

    std::array<Program, 3> m_surface;  ///< opaque, panes that face away, panes that face us
    std::array<Program, 3> m_pixels;   ///< the same for Part::pixels
    Program m_depth, m_contact;
    Framebuffer m_framebuffer, m_glassFramebuffer, m_contactFramebuffer;
    /// Reversed depth of the nearest pane that faces us, or not, for a size of views.
    struct Panes {
        Texture front, back;
    };
    std::vector<Panes> m_panes;  ///< the last used first
    VertexArray m_noAttributes;
    Texture m_black;
    std::optional<Sky> m_sky;
};

}  // namespace reflet
