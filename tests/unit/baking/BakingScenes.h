// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace reflet::testing {

/// Builds small cities by hand.
class SceneBuilder {
public:
    CityModel city;

    std::uint32_t object(const std::string& id, CityObjectType type) {
        CityObject o;
        o.id = id;
        o.type = type;
        city.objects.push_back(o);
        return std::uint32_t(city.objects.size() - 1);
    }
    std::uint32_t material(const std::string& name, const glm::vec3& diffuse) {
        CityMaterial m;
        m.name = name;
        m.diffuse = diffuse;
        city.materials.push_back(m);
        return std::uint32_t(city.materials.size() - 1);
    }
    std::uint32_t surface(std::uint32_t owner, std::uint32_t materialIndex = kNone,
                          SurfaceType type = SurfaceType::Unknown) {
        CitySurface s;
        s.object = owner;
        s.type = type;
        s.material = materialIndex;
        city.surfaces.push_back(s);
        return std::uint32_t(city.surfaces.size() - 1);
    }
    void triangle(std::uint32_t s, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto n = std::uint32_t(city.vertices.size());
        for (const glm::vec3& p : {a, b, c}) {
            city.vertices.push_back(p);
        }
        city.triangles.push_back({{n, n + 1, n + 2}, s});
    }
    void quad(std::uint32_t s, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
              const glm::vec3& d) {
        triangle(s, a, b, c);
        triangle(s, a, c, d);
    }
    void level(std::uint32_t s, float x0, float y0, float x1, float y1, float z) {
        quad(s, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    }
    /// Six faces, each a surface of its own; outward unless inverted.
    void box(std::uint32_t owner, const glm::vec3& a, const glm::vec3& b,
             std::uint32_t materialIndex = kNone, bool inverted = false, bool bottom = true) {
        const auto face = [&](glm::vec3 p, glm::vec3 q, glm::vec3 r, glm::vec3 s) {
            const std::uint32_t f = surface(owner, materialIndex);
            inverted ? quad(f, s, r, q, p) : quad(f, p, q, r, s);
        };
        face({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
        face({b.x, b.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z});
        face({b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z});
        face({a.x, b.y, a.z}, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z});
        face({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
        if (bottom) {
            face({a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z});
        }
    }
};

inline Lighting sunAt(double elevationDegrees, double azimuthDegrees = 180.0) {
    const double e = elevationDegrees * kPi / 180.0;
    const double a = azimuthDegrees * kPi / 180.0;
    Lighting lighting;
    lighting.sunDirection = {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
    return lighting;
}

inline std::unique_ptr<RadianceScene> sceneOf(const CityModel& city, const Lighting& lighting,
                                              std::vector<TextureImage> textures = {},
                                              std::span<const Occluder> occluders = {}) {
    auto scene = RadianceScene::create(city, std::move(textures), lighting, occluders, {});
    EXPECT_TRUE(scene.has_value());
    return scene ? std::move(*scene) : nullptr;
}

/// Radiance of the surface that a ray from `from` to `to` meets.
inline glm::vec3 look(const RadianceScene& scene, const glm::vec3& from, const glm::vec3& to,
                      float spread = kViewSpread) {
    const glm::vec3 direction = glm::normalize(to - from);
    return scene.shade(scene.intersect(from, direction), from, direction, spread);
}

/// Irradiance / pi of the sky on a surface, by brute force: midpoints in cos(theta) and azimuth
/// over the whole sphere, only directions that `visible` lets through.
template <class Visible>
glm::dvec3 skyOn(const Sky& sky, const glm::dvec3& normal, const Visible& visible) {
    constexpr int kRings = 400;
    constexpr int kSectors = 400;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kRings; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / kRings;
        const double r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < kSectors; ++j) {
            const double phi = 2.0 * kPi * (j + 0.5) / kSectors;
            const glm::dvec3 d(r * std::cos(phi), r * std::sin(phi), z);
            const double cosine = glm::dot(d, normal);
            if (cosine > 0.0 && visible(d)) {
                sum += glm::dvec3(sky.radiance(glm::vec3(d))) * cosine;
            }
        }
    }
    return sum * (4.0 / (kRings * kSectors));  // times 4 pi / count, divided by pi
}
inline glm::dvec3 skyOn(const Sky& sky, const glm::dvec3& normal) {
    return skyOn(sky, normal, [](const glm::dvec3&) { return true; });
}

inline float luminance(const glm::vec3& c) {
    return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
}

}  // namespace reflet::testing
