// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/Lighting.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// A decoded texture: 8-bit sRGB with alpha, rows from the top.
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Things that stand in the city for one picture only (a vehicle): they cast shadow and occlude,
/// and report their triangle when hit. Positions are in the project frame.
struct Occluder {
    std::span<const glm::vec3> vertices;
    std::span<const glm::uvec3> triangles;
};

/// Samples of pictures for people stand for about this angle, radians.
inline constexpr float kViewSpread = 5e-4F;

/// What a ray meets.
struct SceneHit {
    float distance = 0.0F;           ///< metres along a unit direction; +infinity for sky
    std::uint32_t triangle = kNone;  ///< of the city model; kNone for sky and occluders
    std::uint32_t occluder = kNone;  ///< index into the occluders, when one was hit
    std::uint32_t occluderTriangle = kNone;
    glm::vec2 barycentric{0.0F};
};

struct SceneParts;

/// The city made ready for rays: a BVH (Embree), materials, textures, procedural façades, light.
/// Diffuse and view-independent, so that a surface point looks the same from every REM (the
/// assumption of Meyer & Loscos 2003, section 4.1). Safe to use from several threads.
///
/// Colours: a surface's texture; else its material; else a procedural look by object type and
/// semantic surface (or normal, where there is none). On walls of buildings without modelled
/// openings, a material without a name or whose name starts with "facade" gives the colour of a
/// procedural façade; any other ("plain …" by custom) is taken as it is.
class RadianceScene {
public:
    /// A scene of a city whose parts are at hand: no BVH of the city is built. textures, looks and
    /// rays are shared with `parts`.
    [[nodiscard]] static Result<std::unique_ptr<RadianceScene>> create(
        const SceneParts& parts, const Lighting& lighting, std::span<const Occluder> occluders,
        const JobContext& job);
    /// `city` must outlive the scene. textures: one per CityModel::textures (an empty image =
    /// missing, the surface gets its material or procedural look).
    [[nodiscard]] static Result<std::unique_ptr<RadianceScene>> create(
        const CityModel& city, std::vector<TextureImage> textures, const Lighting& lighting,
        std::span<const Occluder> occluders, const JobContext& job);
    ~RadianceScene();

    /// The nearest hit along a unit direction, two-sided.
    [[nodiscard]] SceneHit intersect(const glm::vec3& origin, const glm::vec3& direction) const;
    /// Coherent packets: as intersect, for up to 16 rays at a time inside.
    void intersect(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                   std::span<SceneHit> hits) const;
    /// True when something lies between the point and `distance` along the direction.
    /// A point on a surface must be lifted off it by some millimetres first.
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction,
                                float distance) const;
    /// Radiance leaving a hit point of the city towards anywhere (or of the sky). `spread` is the
    /// angle (radians) that the sample stands for: textures and patterns are averaged over it. An
    /// occluder is grey: who knows better shades it itself.
    [[nodiscard]] glm::vec3 shade(const SceneHit& hit, const glm::vec3& origin,
                                  const glm::vec3& direction, float spread = kViewSpread) const;
    /// The same for many hits, with the sun's shadow rays in packets: faster when neighbours in the
    /// spans are neighbours in the city. All spans have one size.
    void shade(std::span<const SceneHit> hits, std::span<const glm::vec3> origins,
               std::span<const glm::vec3> directions, float spread,
               std::span<glm::vec3> radiance) const;
    /// Light on a point of a body that is not part of the city (a vehicle): returns
    /// irradiance / pi from sun (with shadow) and sky (with ambient occlusion).
    [[nodiscard]] glm::vec3 diffuseLight(const glm::vec3& point, const glm::vec3& normal) const;
    /// Ambient light at a point in the air towards +x −x +y −y +z −z: irradiance / pi of sky and
    /// one bounce, as on surfaces of those normals. Coarse, free of noise.
    [[nodiscard]] std::array<glm::vec3, 6> ambientCube(const glm::vec3& point) const;
    [[nodiscard]] const Sky& sky() const;
    [[nodiscard]] const CityModel& city() const;

    /// Whether the point lies inside a building, bridge or other construction, told by the parity
    /// of crossings in many directions, never by the sense of faces (files get it wrong). A place
    /// under the open sky is never inside.
    [[nodiscard]] bool insideSolid(const glm::vec3& point) const;

private:
    struct Impl;
    explicit RadianceScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
