// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rendering/BodyShading.h"

#include "core/environment/CubeDirection.h"
#include "core/environment/DistanceImpostor.h"
#include "core/rendering/Fresnel.h"
#include "core/traffic/BodyCoupling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace reflet {
namespace {

constexpr int kPanes = 8;                  // surfaces that a view ray is followed through
constexpr int kSkips = 256;                // surfaces of vehicles that a mirrored ray passes
constexpr float kGlintExponent = 1800.0F;  // the sun in polish: a lobe of about two degrees
constexpr float kLining = 0.36F;           // colour of the inside of a cabin

/// Steps off a surface: floats of a city some kilometres wide are worth half a millimetre.
float liftFor(const glm::vec3& point) {
    const glm::vec3 a = glm::abs(point);
    return 1e-3F + 4e-7F * std::max({a.x, a.y, a.z});
}

/// Mirror direction about the normal, kept above the triangle itself: an interpolated normal can
/// send it below, where the ray would start inside the body.
glm::vec3 mirrorDirection(const glm::vec3& direction, const glm::vec3& normal,
                          const glm::vec3& geometric) {
    constexpr float kLeast = 0.01F;
    const glm::vec3 r = direction - 2.0F * glm::dot(direction, normal) * normal;
    const float above = glm::dot(r, geometric);
    return glm::normalize(above < kLeast ? r + (kLeast - above) * geometric : r);
}

bool reflects(const VehicleMaterial& m) {
    return m.clearCoat > 0.0F || m.metallic > 0.0F || m.glass > 0.0F;
}

}  // namespace

BodyShading::BodyShading(const RadianceScene& scene, std::span<const PlacedBody> bodies)
    : m_scene(scene), m_bodies(bodies), m_couplings(bodies.size()) {
    for (const PlacedBody& body : bodies) {
        assert(body.vehicle != nullptr && body.body < body.vehicle->bodies.size());
        m_rotation.emplace_back(body.project_from_body.rotation);
    }
    m_interiorLight = scene.sky().ambient({0.0F, 0.0F, 1.0F}) * kCabinLight;
    findCouplings();
}

void BodyShading::findCouplings() {
    for (std::size_t i = 0; i + 1 < m_bodies.size(); ++i) {
        const PlacedBody& a = m_bodies[i];
        const PlacedBody& b = m_bodies[i + 1];
        if (a.vehicle != b.vehicle || a.body + 1 != b.body || a.map == nullptr ||
            b.map == nullptr ||
            !rigidlyCoupled(*a.vehicle, a.body, a.project_from_body, b.project_from_body)) {
            continue;
        }
        const glm::vec3 axis(b.map->center - a.map->center);
        const float length = glm::length(axis);
        if (length > 0.0F) {
            m_couplings[i].push_back({i + 1, axis / (length * length), kFadeHalf / length});
            m_couplings[i + 1].push_back({i, -axis / (length * length), kFadeHalf / length});
        }
    }
}

BodyShading::Surface BodyShading::surfaceAt(const SceneHit& hit, const glm::vec3& origin,
                                            const glm::vec3& direction) const {
    const PlacedBody& placed = m_bodies[hit.occluder];
    const VehicleBody& body = placed.vehicle->bodies[placed.body];
    const glm::uvec3 t = body.triangles[hit.occluderTriangle];
    const glm::vec3 cross = glm::cross(body.vertices[t.y] - body.vertices[t.x],
                                       body.vertices[t.z] - body.vertices[t.x]);
    const glm::vec2 uv = hit.barycentric;
    const glm::vec3 smooth = body.normals[t.x] * (1.0F - uv.x - uv.y) + body.normals[t.y] * uv.x +
                             body.normals[t.z] * uv.y;
    Surface s;
    s.material = &placed.vehicle->materials[body.triangleMaterial[hit.occluderTriangle]];
    s.geometric = m_rotation[hit.occluder] * glm::normalize(cross);
    s.normal = m_rotation[hit.occluder] * glm::normalize(smooth);
    s.front = glm::dot(s.geometric, direction) <= 0.0F;
    if (!s.front) {
        s.geometric = -s.geometric;
        s.normal = -s.normal;
    }
    s.point = origin + direction * hit.distance;
    return s;
}

BodyShading::Seen BodyShading::follow(const glm::vec3& origin, const glm::vec3& direction,
                                      const SceneHit& first, bool inMirror) const {
    Seen seen;
    glm::vec3 throughput(1.0F);
    glm::vec3 from = origin;
    SceneHit hit = first;
    bool behindGlass = false;
    for (int i = 0; i < kPanes; ++i) {
        if (hit.occluder == kNone) {
            seen.radiance += throughput * m_scene.shade(hit, from, direction);
            return seen;
        }
        const Surface s = surfaceAt(hit, from, direction);
        const VehicleMaterial& material = *s.material;
        if (i == 0) {
            seen.reflector = s.front && reflects(material);
        }
        if (s.front && !behindGlass) {
            seen.radiance += throughput * outside(s, hit.occluder, direction, inMirror);
        } else if (material.glass < 1.0F) {
            seen.radiance +=
                throughput * (1.0F - material.glass) * (behindGlass ? inside(s) : glm::vec3(0.0F));
        }
        if (material.glass <= 0.0F) {
            return seen;
        }
        const float passes =
            1.0F - fresnelSchlick(kGlazingF0, std::abs(glm::dot(s.normal, direction)));
        throughput *= material.baseColor * (passes * (1.0F - material.metallic) * material.glass);
        behindGlass = s.front;
        from = s.point + direction * liftFor(s.point);
        hit = m_scene.intersect(from, direction);
    }
    return seen;
}

glm::vec3 BodyShading::outside(const Surface& s, std::size_t body, const glm::vec3& direction,
                               bool inMirror) const {
    const VehicleMaterial& m = *s.material;
    const float cosine = std::max(-glm::dot(s.normal, direction), 0.0F);
    const glm::vec3 metal = m.metallic * fresnelSchlick(m.baseColor, cosine);
    const float coat = m.clearCoat * fresnelSchlick(kDielectricF0, cosine);
    const float pane = m.glass * fresnelSchlick(kGlazingF0, cosine);
    // The coat lies over metal and colour alike: what it reflects does not reach them.
    const glm::vec3 gloss = glm::vec3(coat + pane) + metal * ((1.0F - coat) * (1.0F - pane));
    glm::vec3 radiance = m.emission;
    if (gloss.x + gloss.y + gloss.z > 0.0F) {
        radiance += gloss * mirror(s, body, direction, inMirror);
    }
    const float matt = (1.0F - coat) * (1.0F - m.metallic) * (1.0F - m.glass);
    if (matt > 0.0F) {
        const glm::vec3 lifted = s.point + s.geometric * liftFor(s.point);
        radiance += m.baseColor * matt * m_scene.diffuseLight(lifted, s.normal);
    }
    return radiance;
}

glm::vec3 BodyShading::inside(const Surface& s) const {
    const glm::vec3 color = s.front ? s.material->baseColor : glm::vec3(kLining);
    // More light comes from above the sill than from the floor.
    return s.material->emission + color * m_interiorLight * (0.7F + 0.5F * s.normal.z);
}

glm::vec3 BodyShading::mirror(const Surface& s, std::size_t body, const glm::vec3& direction,
                              bool inMirror) const {
    const glm::vec3 r = mirrorDirection(direction, s.normal, s.geometric);
    const glm::vec3 lifted = s.point + s.geometric * liftFor(s.point);
    return mirrored(body, lifted, r, inMirror) + sunGlint(s, r);
}

glm::vec3 BodyShading::sunGlint(const Surface& s, const glm::vec3& reflected) const {
    // The sun is a light of its own and in no map. Its irradiance E = π · sunRadiance, spread by a
    // lobe (n + 1) / 2π · cosⁿ, has the radiance (n + 1) / 2 · sunRadiance · cosⁿ.
    const Sky& sky = m_scene.sky();
    const float cosine = glm::dot(reflected, sky.sunDirection());
    if (cosine < 0.99F) {
        return glm::vec3(0.0F);
    }
    const glm::vec3 light =
        sky.sunRadiance() * (0.5F * (kGlintExponent + 1.0F) * std::pow(cosine, kGlintExponent));
    if (light.x + light.y + light.z < 1e-3F) {
        return glm::vec3(0.0F);
    }
    const glm::vec3 lifted = s.point + s.geometric * (4.0F * liftFor(s.point));
    return m_scene.occluded(lifted, sky.sunDirection(), kInfinity) ? glm::vec3(0.0F) : light;
}

glm::vec3 BodyShading::mirrored(std::size_t body, const glm::vec3& point,
                                const glm::vec3& direction, bool inMirror) const {
    const LocalEnvironmentMap* map = m_bodies[body].map;
    if (map == nullptr || m_bodies[body].pixels != nullptr) {
        return traced(body, point, direction, inMirror);
    }
    const auto seenIn = [&](const LocalEnvironmentMap& of) {
        const glm::vec3 origin = point - glm::vec3(of.center);
        const bool atInfinity = of.atInfinity || of.distance.empty();
        const glm::vec3 towards =
            atInfinity ? direction : directionOfHit(of.distance, origin, direction);
        return sampleBilinear(of.radiance, glm::dvec3(towards));
    };
    glm::vec3 radiance = seenIn(*map);
    for (const Coupling& c : m_couplings[body]) {
        const float along = glm::dot(point - glm::vec3(map->center), c.axis);
        const float share = glm::smoothstep(0.5F - c.band, 0.5F + c.band, along);
        if (share > 0.0F) {
            radiance = glm::mix(radiance, seenIn(*m_bodies[c.other].map), share);
        }
    }
    return radiance;
}

glm::vec3 BodyShading::traced(std::size_t body, glm::vec3 origin, const glm::vec3& direction,
                              bool inMirror) const {
    const PixelReflections* pixels = m_bodies[body].pixels;
    const glm::vec3 start = origin;
    for (int i = 0; i < kSkips; ++i) {
        const SceneHit hit = m_scene.intersect(origin, direction);
        if (hit.occluder == kNone) {
            return pixels ? pixels->radiance(glm::dvec3(start), glm::dvec3(direction))
                          : m_scene.shade(hit, origin, direction);
        }
        if (!inMirror && m_bodies[hit.occluder].reflector != m_bodies[body].reflector) {
            return follow(origin, direction, hit, true).radiance;
        }
        const glm::vec3 point = origin + direction * hit.distance;
        origin = point + direction * liftFor(point);
    }
    return m_scene.sky().radiance(direction);
}

}  // namespace reflet
