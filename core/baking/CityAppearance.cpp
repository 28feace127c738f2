// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/CityAppearance.h"

#include "core/baking/SurfacePattern.h"

#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kMaxTrianglesOfAGable = 64;

/// What windowOnWall needs to know of a wall.
struct Wall {
    const CityModel& city;
    const SurfaceLooks& looks;
    std::uint32_t surface;
};

bool inTriangle(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const auto side = [&](const glm::vec2& from, const glm::vec2& to) {
        return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    };
    const float ab = side(a, b);
    const float bc = side(b, c);
    const float ca = side(c, a);
    return (ab >= 0.0F && bc >= 0.0F && ca >= 0.0F) || (ab <= 0.0F && bc <= 0.0F && ca <= 0.0F);
}

/// All four corners of the rectangle lie on triangles of the wall.
bool windowOnWall(const void* data, float u0, float u1, float z0, float z1) {
    const Wall& wall = *static_cast<const Wall*>(data);
    const auto [begin, end] = wall.looks.wallTriangles(wall.surface);
    if (std::size_t(end - begin) > kMaxTrianglesOfAGable) {
        return true;
    }
    const glm::vec2 tangent = wall.looks.surface(wall.surface).tangent;
    const auto onWall = [&, first = begin, last = end](const glm::vec2& p) {
        for (const auto* t = first; t != last; ++t) {
            glm::vec2 corner[3];
            for (int i = 0; i < 3; ++i) {
                const glm::vec3& v =
                    wall.city.vertices[wall.city.triangles[*t].vertex[std::size_t(i)]];
                corner[i] = {v.x * tangent.x + v.y * tangent.y, v.z};
            }
            if (inTriangle(p, corner[0], corner[1], corner[2])) {
                return true;
            }
        }
        return false;
    };
    return onWall({u0, z0}) && onWall({u1, z0}) && onWall({u0, z1}) && onWall({u1, z1});
}

}  // namespace

CityAppearance::CityAppearance(const CityModel& city, std::shared_ptr<const SurfaceLooks> looks,
                               std::shared_ptr<const std::vector<MipTexture>> textures, float night)
    : m_city(city), m_looks(std::move(looks)), m_textures(std::move(textures)), m_night(night) {}

const MipTexture* CityAppearance::textureOf(std::uint32_t surface) const {
    const std::uint32_t texture = m_city.surfaces[surface].texture;
    const bool usable = texture < m_textures->size() && !(*m_textures)[texture].empty() &&
                        m_city.uv.size() == m_city.triangles.size();
    return usable ? &(*m_textures)[texture] : nullptr;
}

glm::vec4 CityAppearance::texel(const MipTexture& texture, std::uint32_t triangle,
                                const glm::vec3& normal, const glm::vec2& barycentric,
                                const Footprint& footprint) const {
    const auto& uv = m_city.uv[triangle];
    const auto& v = m_city.triangles[triangle].vertex;
    const glm::vec3 edge1 = m_city.vertices[v[1]] - m_city.vertices[v[0]];
    const glm::vec3 edge2 = m_city.vertices[v[2]] - m_city.vertices[v[0]];
    const glm::vec2 at = uv[0] + barycentric.x * (uv[1] - uv[0]) + barycentric.y * (uv[2] - uv[0]);

    // The ellipse of the cone on the plane: its longer axis lies along the ray's projection.
    const glm::vec3& d = footprint.direction;
    const float facing = std::max(std::abs(glm::dot(d, normal)), 0.02F);
    glm::vec3 along = d - normal * glm::dot(d, normal);
    const float length = glm::length(along);
    along = length > 1e-4F ? along / length : edge1 / std::max(glm::length(edge1), 1e-12F);
    const glm::vec3 across = glm::cross(normal, along);

    // A vector of the plane in units of the two edges (normal equations), then in uv.
    const float a = glm::dot(edge1, edge1);
    const float b = glm::dot(edge1, edge2);
    const float c = glm::dot(edge2, edge2);
    const float determinant = a * c - b * b;
    if (!(determinant > 0.0F)) {
        return texture.mean();
    }
    const auto uvOf = [&](const glm::vec3& w) {
        const float p = glm::dot(w, edge1);
        const float q = glm::dot(w, edge2);
        return ((c * p - b * q) * (uv[1] - uv[0]) + (a * q - b * p) * (uv[2] - uv[0])) /
               determinant;
    };
    return texture.sample(at, uvOf(along * (footprint.width / facing)),
                          uvOf(across * footprint.width));
}

Appearance CityAppearance::untextured(std::uint32_t surface, const glm::vec3& point,
                                      const glm::vec3& normal, const Footprint& footprint) const {
    const SurfaceLook& look = m_looks->surface(surface);
    const BuildingLook& building = m_looks->building(look.building);
    Appearance result;
    if (look.kind == LookKind::Facade) {
        const Wall wall{m_city, *m_looks, surface};
        result = facadeAppearance(look, building, point, footprint, m_night,
                                  look.rectangular ? nullptr : windowOnWall, &wall);
    } else {
        result.albedo = glm::clamp(patternColour(look, building, point, normal, footprint),
                                   glm::vec3(0.0F), glm::vec3(1.0F));
    }
    result.emission += look.emission;
    return result;
}

Appearance CityAppearance::at(std::uint32_t triangle, const glm::vec3& point,
                              const glm::vec3& normal, const glm::vec2& barycentric,
                              const Footprint& footprint) const {
    const std::uint32_t surface = m_city.triangles[triangle].surface;
    if (surface >= m_city.surfaces.size()) {
        return {};
    }
    const MipTexture* texture = textureOf(surface);
    if (texture == nullptr) {
        return untextured(surface, point, normal, footprint);
    }
    const glm::vec4 image = texel(*texture, triangle, normal, barycentric, footprint);
    const SurfaceLook& look = m_looks->surface(surface);
    Appearance result;
    result.emission = look.emission;
    result.albedo = look.tint * glm::vec3(image);
    if (image.a < 0.999F) {  // see-through parts show the surface's colour
        result.albedo = glm::mix(look.colour, result.albedo, image.a);
    }
    return result;
}

glm::vec3 CityAppearance::mean(std::uint32_t triangle) const {
    const std::uint32_t surface = m_city.triangles[triangle].surface;
    if (surface >= m_city.surfaces.size()) {
        return Appearance{}.albedo;
    }
    const SurfaceLook& look = m_looks->surface(surface);
    if (const MipTexture* texture = textureOf(surface)) {
        const glm::vec4 image = texture->mean();
        return glm::mix(look.colour, look.tint * glm::vec3(image), image.a);
    }
    return look.kind == LookKind::Facade ? facadeMean(look) : look.colour;
}

}  // namespace reflet
