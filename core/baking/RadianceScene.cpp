// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RadianceScene.h"

#include "core/baking/AmbientLight.h"
#include "core/baking/CityAppearance.h"
#include "core/baking/SceneParts.h"
#include "core/baking/SolidTest.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kBatch = 64;
constexpr float kOccluderAlbedo = 0.3F;

/// Metres to lift a point off its surface: millimetres, and more where floats are coarse.
float liftAt(const glm::vec3& p) {
    const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return 4e-3F + 2e-6F * largest;
}

glm::vec3 finiteOrBlack(const glm::vec3& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) ? c : glm::vec3(0.0F);
}

/// Where the rays of a batch meet the city.
struct SurfacePoints {
    std::array<glm::vec3, kBatch> position;
    std::array<glm::vec3, kBatch> normal;  ///< towards the viewer
    std::array<float, kBatch> sunlight;    ///< cosine to the sun where it shines, else 0
};

}  // namespace

struct RadianceScene::Impl {
    SceneParts parts;
    const CityModel& city;
    Sky sky;
    std::shared_ptr<const RayScene> rays;  ///< with the occluders
    CityAppearance appearance;
    LightGatherer gatherer;
    AmbientLight ambient;

    Impl(SceneParts sceneParts, const Lighting& lighting, std::shared_ptr<const RayScene> rayScene)
        : parts(std::move(sceneParts)),
          city(*parts.city),
          sky(lighting),
          rays(std::move(rayScene)),
          appearance(city, parts.looks, parts.textures, sky.night()),
          gatherer(city, *rays, appearance, sky),
          ambient(city, *rays, appearance.looks(), gatherer) {}

    void place(std::span<const SceneHit> hits, std::span<const glm::vec3> directions,
               SurfacePoints& points) const;
    void letSunShine(std::span<const SceneHit> hits, SurfacePoints& points) const;
};

/// From the triangle, not along the ray: the same point from everywhere.
void RadianceScene::Impl::place(std::span<const SceneHit> hits,
                                std::span<const glm::vec3> directions,
                                SurfacePoints& points) const {
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].triangle == kNone) {
            continue;
        }
        const auto& v = city.triangles[hits[i].triangle].vertex;
        const glm::vec3& a = city.vertices[v[0]];
        points.position[i] = a + hits[i].barycentric.x * (city.vertices[v[1]] - a) +
                             hits[i].barycentric.y * (city.vertices[v[2]] - a);
        const glm::vec3 normal = city.normal(hits[i].triangle);
        points.normal[i] = glm::dot(normal, directions[i]) > 0.0F ? -normal : normal;
    }
}

void RadianceScene::Impl::letSunShine(std::span<const SceneHit> hits, SurfacePoints& points) const {
    std::array<glm::vec3, kBatch> origin;
    std::array<glm::vec3, kBatch> direction;
    std::array<float, kBatch> distance;
    std::array<unsigned char, kBatch> shadowed;
    std::array<std::size_t, kBatch> owner;
    std::size_t count = 0;
    const bool day = sky.sunRadiance().g > 0.0F;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        points.sunlight[i] = 0.0F;
        if (!day || hits[i].triangle == kNone) {
            continue;
        }
        const float cosine = glm::dot(points.normal[i], sky.sunDirection());
        if (cosine > 0.0F) {
            points.sunlight[i] = cosine;
            origin[count] = points.position[i] + liftAt(points.position[i]) * points.normal[i];
            direction[count] = sky.sunDirection();
            distance[count] = kInfinity;
            owner[count++] = i;
        }
    }
    rays->occluded({origin.data(), count}, {direction.data(), count}, {distance.data(), count},
                   {shadowed.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
        if (shadowed[k] != 0) {
            points.sunlight[owner[k]] = 0.0F;
        }
    }
}

RadianceScene::RadianceScene(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
RadianceScene::~RadianceScene() = default;

Result<std::unique_ptr<RadianceScene>> RadianceScene::create(const CityModel& city,
                                                             std::vector<TextureImage> textures,
                                                             const Lighting& lighting,
                                                             std::span<const Occluder> occluders,
                                                             const JobContext& job) {
    // The caller keeps the city alive.
    const std::shared_ptr<const CityModel> model(std::shared_ptr<const CityModel>(), &city);
    auto parts =
        makeSceneParts(model, std::make_shared<const SurfaceLooks>(city),
                       std::make_shared<const std::vector<TextureImage>>(std::move(textures)), job);
    if (!parts) {
        return tl::unexpected(parts.error());
    }
    return create(*parts, lighting, occluders, job);
}

Result<std::unique_ptr<RadianceScene>> RadianceScene::create(const SceneParts& parts,
                                                             const Lighting& lighting,
                                                             std::span<const Occluder> occluders,
                                                             const JobContext& job) {
    std::shared_ptr<const RayScene> rays = parts.rays;
    if (!occluders.empty()) {
        auto made = RayScene::withOccluders(parts.rays, occluders, job);
        if (!made) {
            return tl::unexpected(made.error());
        }
        rays = std::move(*made);
    }
    auto impl = std::make_unique<Impl>(parts, lighting, std::move(rays));
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return std::unique_ptr<RadianceScene>(new RadianceScene(std::move(impl)));
}

SceneHit RadianceScene::intersect(const glm::vec3& origin, const glm::vec3& direction) const {
    return m_impl->rays->intersect(origin, direction, kInfinity);
}

void RadianceScene::intersect(std::span<const glm::vec3> origins,
                              std::span<const glm::vec3> directions,
                              std::span<SceneHit> hits) const {
    m_impl->rays->intersect(origins, directions, kInfinity, hits);
}

bool RadianceScene::occluded(const glm::vec3& origin, const glm::vec3& direction,
                             float distance) const {
    return m_impl->rays->occluded(origin, direction, distance);
}

glm::vec3 RadianceScene::shade(const SceneHit& hit, const glm::vec3& origin,
                               const glm::vec3& direction, float spread) const {
    glm::vec3 radiance;
    shade({&hit, 1}, {&origin, 1}, {&direction, 1}, spread, {&radiance, 1});
    return radiance;
}

void RadianceScene::shade(std::span<const SceneHit> hits, std::span<const glm::vec3> origins,
                          std::span<const glm::vec3> directions, float spread,
                          std::span<glm::vec3> radiance) const {
    assert(hits.size() == origins.size() && hits.size() == directions.size() &&
           hits.size() == radiance.size());
    SurfacePoints points;
    for (std::size_t first = 0; first < hits.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, hits.size() - first);
        m_impl->place(hits.subspan(first, count), directions.subspan(first, count), points);
        m_impl->letSunShine(hits.subspan(first, count), points);
        for (std::size_t i = 0; i < count; ++i) {
            const SceneHit& hit = hits[first + i];
            const glm::vec3& direction = directions[first + i];
            if (hit.triangle != kNone) {
                const Appearance look = m_impl->appearance.at(
                    hit.triangle, points.position[i], points.normal[i], hit.barycentric,
                    Footprint{direction, hit.distance * spread});
                const glm::vec3 light = points.sunlight[i] * m_impl->sky.sunRadiance() +
                                        m_impl->ambient.at(hit.triangle, points.position[i],
                                                           points.normal[i], hit.distance * spread);
                radiance[first + i] = finiteOrBlack(look.albedo * light + look.emission);
            } else if (hit.occluder != kNone) {
                const glm::vec3 before = origins[first + i] + (hit.distance - 0.01F) * direction;
                radiance[first + i] = kOccluderAlbedo * diffuseLight(before, -direction);
            } else {
                radiance[first + i] = m_impl->sky.radiance(direction);
            }
        }
    }
}

glm::vec3 RadianceScene::diffuseLight(const glm::vec3& point, const glm::vec3& normal) const {
    glm::vec3 light =
        m_impl->gatherer.gather(point, normal, LightGatherer::Effort::Medium).irradiance;
    const glm::vec3& sun = m_impl->sky.sunDirection();
    const float facing = glm::dot(normal, sun);
    if (facing > 0.0F && m_impl->sky.sunRadiance().g > 0.0F &&
        !occluded(point + liftAt(point) * normal, sun, kInfinity)) {
        light += facing * m_impl->sky.sunRadiance();
    }
    return light;
}

std::array<glm::vec3, 6> RadianceScene::ambientCube(const glm::vec3& point) const {
    return m_impl->gatherer.gatherCube(point);
}

const Sky& RadianceScene::sky() const {
    return m_impl->sky;
}
const CityModel& RadianceScene::city() const {
    return m_impl->city;
}

bool RadianceScene::insideSolid(const glm::vec3& point) const {
    return reflet::insideSolid(m_impl->city, *m_impl->rays, point);
}

}  // namespace reflet
