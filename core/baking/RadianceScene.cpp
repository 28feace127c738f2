// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RadianceScene.h"

#include "core/baking/AmbientLight.h"
#include "core/baking/CityAppearance.h"
#include "core/baking/RayScene.h"
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

}  // namespace

struct RadianceScene::Impl {
    const CityModel& city;
    Sky sky;
    std::unique_ptr<RayScene> rays;
    CityAppearance appearance;
    AmbientLight ambient;

    Impl(const CityModel& model, std::vector<TextureImage> textures, const Lighting& lighting,
         std::unique_ptr<RayScene> rayScene)
        : city(model),
          sky(lighting),
          rays(std::move(rayScene)),
          appearance(model, std::move(textures), sky.night()),
          ambient(model, *rays, appearance, sky) {}
};

RadianceScene::RadianceScene(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
RadianceScene::~RadianceScene() = default;

Result<std::unique_ptr<RadianceScene>> RadianceScene::create(const CityModel& city,
                                                             std::vector<TextureImage> textures,
                                                             const Lighting& lighting,
                                                             std::span<const Occluder> occluders,
                                                             const JobContext& job) {
    auto rays = RayScene::build(city, occluders, job);
    if (!rays) {
        return tl::unexpected(rays.error());
    }
    auto impl = std::make_unique<Impl>(city, std::move(textures), lighting, std::move(*rays));
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
    const CityModel& city = m_impl->city;
    const glm::vec3& sun = m_impl->sky.sunDirection();
    const bool day = m_impl->sky.sunRadiance().g > 0.0F;
    std::array<glm::vec3, kBatch> point;
    std::array<glm::vec3, kBatch> normal;
    std::array<float, kBatch> sunlight;
    std::array<glm::vec3, kBatch> shadowOrigin;
    std::array<glm::vec3, kBatch> shadowDirection;
    std::array<float, kBatch> shadowDistance;
    std::array<unsigned char, kBatch> shadowed;
    std::array<std::size_t, kBatch> owner;
    for (std::size_t first = 0; first < hits.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, hits.size() - first);
        std::size_t shadowRays = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const SceneHit& hit = hits[first + i];
            sunlight[i] = 0.0F;
            if (hit.triangle == kNone) {
                continue;
            }
            // From the triangle, not along the ray: the same point from everywhere.
            const auto& v = city.triangles[hit.triangle].vertex;
            const glm::vec3& a = city.vertices[v[0]];
            point[i] = a + hit.barycentric.x * (city.vertices[v[1]] - a) +
                       hit.barycentric.y * (city.vertices[v[2]] - a);
            const glm::vec3 n = city.normal(hit.triangle);
            normal[i] = glm::dot(n, directions[first + i]) > 0.0F ? -n : n;
            const float facing = glm::dot(normal[i], sun);
            if (day && facing > 0.0F) {
                sunlight[i] = facing;
                shadowOrigin[shadowRays] = point[i] + liftAt(point[i]) * normal[i];
                shadowDirection[shadowRays] = sun;
                shadowDistance[shadowRays] = kInfinity;
                owner[shadowRays++] = i;
            }
        }
        m_impl->rays->occluded({shadowOrigin.data(), shadowRays},
                               {shadowDirection.data(), shadowRays},
                               {shadowDistance.data(), shadowRays}, {shadowed.data(), shadowRays});
        for (std::size_t k = 0; k < shadowRays; ++k) {
            if (shadowed[k] != 0) {
                sunlight[owner[k]] = 0.0F;
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            const SceneHit& hit = hits[first + i];
            const glm::vec3& direction = directions[first + i];
            if (hit.triangle != kNone) {
                const Footprint footprint{direction, hit.distance * spread};
                const Appearance look = m_impl->appearance.at(hit.triangle, point[i], normal[i],
                                                              hit.barycentric, footprint);
                const glm::vec3 light = sunlight[i] * m_impl->sky.sunRadiance() +
                                        m_impl->ambient.onCity(hit.triangle, point[i], normal[i]);
                radiance[first + i] = finiteOrBlack(look.albedo * light + look.emission);
            } else if (hit.occluder != kNone) {
                radiance[first + i] =
                    kOccluderAlbedo *
                    diffuseLight(origins[first + i] + (hit.distance - 0.01F) * direction,
                                 -direction);
            } else {
                radiance[first + i] = m_impl->sky.radiance(direction);
            }
        }
    }
}

glm::vec3 RadianceScene::diffuseLight(const glm::vec3& point, const glm::vec3& normal) const {
    glm::vec3 light = m_impl->ambient.at(point, normal);
    const glm::vec3& sun = m_impl->sky.sunDirection();
    const float facing = glm::dot(normal, sun);
    if (facing > 0.0F && m_impl->sky.sunRadiance().g > 0.0F &&
        !occluded(point + liftAt(point) * normal, sun, kInfinity)) {
        light += facing * m_impl->sky.sunRadiance();
    }
    return light;
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
