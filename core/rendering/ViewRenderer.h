// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/environment/EnvironmentMap.h"
#include "core/reconstruction/PixelReflections.h"
#include "core/traffic/Vehicle.h"

#include <span>
#include <vector>

namespace reflet {

/// A pinhole camera in the project frame, z up, no roll.
struct Camera {
    glm::dvec3 position{0.0};
    glm::dvec3 target{1.0, 0.0, 0.0};
    double verticalFov = 0.9;  ///< radians
};

/// A vehicle's body standing in the city, and the local map that it reflects.
struct PlacedBody {
    const Vehicle* vehicle = nullptr;
    std::size_t body = 0;
    RigidTransform project_from_body;
    const LocalEnvironmentMap* map = nullptr;  ///< null: reflections are ray traced (the reference)
    /// Takes the map's place: what it mirrors of the city is looked up ray by ray.
    const PixelReflections* pixels = nullptr;
    std::size_t reflector = 0;  ///< bodies of one number are one vehicle
};

struct ViewSettings {
    int width = 1280;
    int height = 720;
    int samplesPerEdge = 3;  ///< anti-aliasing: this squared samples a pixel
};

/// A picture of linear radiance, rows from the top, and the share of each pixel that reflectors
/// take.
struct RenderedView {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
    std::vector<unsigned char>
        reflector;  ///< 1 where any sample of the pixel met a reflecting part
};

/// The body's vertices where they stand, as the scene's occluder wants them.
[[nodiscard]] std::vector<glm::vec3> projectVertices(const PlacedBody& body);

/// Ray traces the view on the CPU: the city as in the REMs, vehicles with paint (clear coat with
/// Schlick's Fresnel term), chrome, glass and lights; a body's mirror reflection comes from its
/// local map, or from rays when it has none (or looks up what they would meet): into the city and
/// onto other vehicles, through its own bodies (as drawIntoMap() has it), and in a vehicle that is
/// mirrored the city alone. Vehicles shadow the ground and each other. Glass lets what is behind it
/// through (its base colour is its transmittance), once the vehicle's interior, then the city
/// beyond. Where two bodies are rigidly coupled, their maps are cross-faded over the last half
/// metre before the joint. Each pixel takes samplesPerEdge² samples of a rank-1 lattice, spread as
/// a tent of two pixels' width, each weighted by 1 / (1 + its luminance): highlights are resolved
/// as after tone mapping (no fireflies, smooth edges on the display) while the picture stays linear
/// radiance. `scene` must have been made with the bodies as occluders, in the same order. Usage: no
/// size, no samples, or a camera that looks nowhere; ResourceLimit: more than 2^26 pixels.
[[nodiscard]] Result<RenderedView> renderView(const RadianceScene& scene,
                                              std::span<const PlacedBody> bodies,
                                              const Camera& camera, const ViewSettings& settings,
                                              const JobContext& job);

}  // namespace reflet
