// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/rendering/ViewRenderer.h"

#include <span>
#include <vector>

namespace reflet {

/// What pictures by rays and by OpenGL have in common.
inline constexpr float kFadeHalf = 0.5F;  ///< metres: half a cross-fade between coupled bodies
/// Share of the sky's light that fills a cabin through its windows.
inline constexpr float kCabinLight = 0.16F;

/// How vehicles look: follows a ray that may meet them, through their windows, until it ends at
/// something opaque or in the sky. Reads only; safe to use from several threads.
class BodyShading {
public:
    BodyShading(const RadianceScene& scene, std::span<const PlacedBody> bodies);

    struct Seen {
        glm::vec3 radiance{0.0F};
        bool reflector = false;  ///< the first thing met was a reflecting part
    };
    /// What comes along a ray (unit direction) whose first hit is known.
    [[nodiscard]] Seen along(const glm::vec3& origin, const glm::vec3& direction,
                             const SceneHit& hit) const {
        return follow(origin, direction, hit, false);
    }
    /// The same for a ray that comes from a mirror: what the vehicles that it meets mirror
    /// themselves is the city alone.
    [[nodiscard]] glm::vec3 inMirror(const glm::vec3& origin, const glm::vec3& direction,
                                     const SceneHit& hit) const {
        return follow(origin, direction, hit, true).radiance;
    }

private:
    struct Surface {
        glm::vec3 point{0.0F};
        glm::vec3 normal{0.0F};     // interpolated, on the viewer's side
        glm::vec3 geometric{0.0F};  // of the triangle, on the viewer's side
        const VehicleMaterial* material = nullptr;
        bool front = true;
    };
    /// The neighbour that a body's map is faded into, and where.
    struct Coupling {
        std::size_t other = 0;
        glm::vec3 axis{0.0F};  // from this centre to the other's, divided by its squared length
        float band = 0.0F;     // half width of the fade, as a share of that distance
    };

    [[nodiscard]] Seen follow(const glm::vec3& origin, const glm::vec3& direction,
                              const SceneHit& hit, bool inMirror) const;
    [[nodiscard]] Surface surfaceAt(const SceneHit& hit, const glm::vec3& origin,
                                    const glm::vec3& direction) const;
    [[nodiscard]] glm::vec3 outside(const Surface& s, std::size_t body, const glm::vec3& direction,
                                    bool inMirror) const;
    [[nodiscard]] glm::vec3 inside(const Surface& s) const;
    [[nodiscard]] glm::vec3 mirror(const Surface& s, std::size_t body, const glm::vec3& direction,
                                   bool inMirror) const;
    /// What a body's mirror shows in a direction (unit) from a point of its surface: its local map,
    /// or rays.
    [[nodiscard]] glm::vec3 mirrored(std::size_t body, const glm::vec3& point,
                                     const glm::vec3& direction, bool inMirror) const;
    [[nodiscard]] glm::vec3 sunGlint(const Surface& s, const glm::vec3& reflected) const;
    [[nodiscard]] glm::vec3 traced(std::size_t body, glm::vec3 origin, const glm::vec3& direction,
                                   bool inMirror) const;
    void findCouplings();

    const RadianceScene& m_scene;
    std::span<const PlacedBody> m_bodies;
    std::vector<glm::mat3> m_rotation;  // project_from_body, per body
    std::vector<std::vector<Coupling>> m_couplings;
    glm::vec3 m_interiorLight{0.0F};
};

}  // namespace reflet
