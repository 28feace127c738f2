// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/LightGatherer.h"

#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kFine = 64;
constexpr std::size_t kMedium = 32;
constexpr std::size_t kCoarse = 16;
constexpr std::size_t kSphere = 64;  ///< about a point in the air
constexpr float kReach = 25.0F;      ///< metres; what is further away occludes no light
constexpr float kFadeFrom = 12.0F;
constexpr float kLift = 0.02F;
constexpr float kBounceAmbient = 0.55F;  ///< share of the open sky that a bouncing surface sees
constexpr int kTableColumns = 96;
constexpr int kTableRows = 64;

/// Cosine-distributed directions about +z: a Fibonacci spiral on the disc, lifted to the hemisphere
/// (Malley's method), so that each carries the same irradiance under a uniform sky.
template <std::size_t Count>
std::span<const glm::vec3> spiral() {
    static const std::array<glm::vec3, Count> directions = [] {
        std::array<glm::vec3, Count> d{};
        for (std::size_t i = 0; i < Count; ++i) {
            const double r2 = (double(i) + 0.5) / double(Count);
            const double phi = double(i) * kPi * (3.0 - std::sqrt(5.0));
            const double r = std::sqrt(r2);
            d[i] = glm::vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r2));
        }
        return d;
    }();
    return directions;
}

/// Evenly spread directions of the whole sphere: a Fibonacci spiral.
std::span<const glm::vec3> sphereSpiral() {
    static const std::array<glm::vec3, kSphere> directions = [] {
        std::array<glm::vec3, kSphere> d{};
        for (std::size_t i = 0; i < kSphere; ++i) {
            const double z = 1.0 - (2.0 * double(i) + 1.0) / double(kSphere);
            const double r = std::sqrt(1.0 - z * z);
            const double phi = double(i) * kPi * (3.0 - std::sqrt(5.0));
            d[i] = glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
        }
        return d;
    }();
    return directions;
}

/// How much something at this distance hides of what is behind it.
float hiding(float distance) {
    const float t = std::clamp((distance - kFadeFrom) / (kReach - kFadeFrom), 0.0F, 1.0F);
    return 1.0F - t * t * (3.0F - 2.0F * t);
}

}  // namespace

/// The rays of one point and what they found.
struct LightGatherer::Rays {
    std::size_t count = 0;
    std::array<glm::vec3, kFine> origins;
    std::array<glm::vec3, kFine> directions;
    std::array<SceneHit, kFine> hits;
    std::array<glm::vec3, kFine> endLight;  ///< irradiance / pi where a ray ends on the city
};

NormalFrame frameAround(const glm::vec3& n) {
    const glm::vec3 axis =
        std::abs(n.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 tangent = glm::normalize(axis - n * glm::dot(n, axis));
    return {tangent, glm::cross(n, tangent)};
}

float LightGatherer::lift() {
    return kLift;
}

float LightGatherer::reach() {
    return kReach;
}

LightGatherer::LightGatherer(const CityModel& city, const RayScene& scene,
                             const CityAppearance& appearance, const Sky& sky)
    : m_city(city),
      m_scene(scene),
      m_appearance(appearance),
      m_sky(sky),
      m_skyTable(std::size_t(kTableColumns) * kTableRows) {
    for (int row = 0; row < kTableRows; ++row) {
        const float z = -1.0F + 2.0F * (float(row) + 0.5F) / float(kTableRows);
        const float r = std::sqrt(1.0F - z * z);
        for (int column = 0; column < kTableColumns; ++column) {
            const float phi = 2.0F * float(kPi) * (float(column) + 0.5F) / float(kTableColumns);
            m_skyTable[std::size_t(row) * kTableColumns + std::size_t(column)] =
                sky.radiance({r * std::cos(phi), r * std::sin(phi), z});
        }
    }
}

glm::vec3 LightGatherer::skyLight(const glm::vec3& direction) const {
    const float turn = std::atan2(direction.y, direction.x) / (2.0F * float(kPi));
    const int column = int((turn - std::floor(turn)) * float(kTableColumns)) % kTableColumns;
    const int row =
        std::clamp(int((direction.z * 0.5F + 0.5F) * float(kTableRows)), 0, kTableRows - 1);
    return m_skyTable[std::size_t(row) * kTableColumns + std::size_t(column)];
}

/// Sun (with a shadow ray) and open sky on the places where rays end.
void LightGatherer::lightEnds(Rays& rays) const {
    std::array<glm::vec3, kFine> ends;
    std::array<glm::vec3, kFine> sunward;
    std::array<float, kFine> far;
    std::array<float, kFine> facing;
    std::array<unsigned char, kFine> shadowed;
    std::array<std::size_t, kFine> owner;
    std::size_t lit = 0;
    const bool day = m_sky.sunRadiance().g > 0.0F;
    for (std::size_t i = 0; i < rays.count; ++i) {
        if (rays.hits[i].triangle == kNone) {
            continue;
        }
        const glm::vec3 own = m_city.normal(rays.hits[i].triangle);
        const glm::vec3 normal = glm::dot(own, rays.directions[i]) > 0.0F ? -own : own;
        rays.endLight[i] = kBounceAmbient * m_sky.ambient(normal);
        const float cosine = glm::dot(normal, m_sky.sunDirection());
        if (day && cosine > 0.0F) {
            ends[lit] =
                rays.origins[i] + rays.hits[i].distance * rays.directions[i] + kLift * normal;
            sunward[lit] = m_sky.sunDirection();
            far[lit] = kInfinity;
            facing[lit] = cosine;
            owner[lit++] = i;
        }
    }
    m_scene.occluded({ends.data(), lit}, {sunward.data(), lit}, {far.data(), lit},
                     {shadowed.data(), lit});
    for (std::size_t k = 0; k < lit; ++k) {
        if (shadowed[k] == 0) {
            rays.endLight[owner[k]] += facing[k] * m_sky.sunRadiance();
        }
    }
}

LightGatherer::Light LightGatherer::gather(const glm::vec3& point, const glm::vec3& normal,
                                           Effort effort) const {
    const auto directions = effort == Effort::Fine     ? spiral<kFine>()
                            : effort == Effort::Medium ? spiral<kMedium>()
                                                       : spiral<kCoarse>();
    const NormalFrame frame = frameAround(normal);
    Rays rays;
    rays.count = directions.size();
    for (std::size_t i = 0; i < rays.count; ++i) {
        const glm::vec3& d = directions[i];
        rays.origins[i] = point + kLift * normal;
        rays.directions[i] = d.x * frame.tangent + d.y * frame.bitangent + d.z * normal;
    }
    m_scene.intersect({rays.origins.data(), rays.count}, {rays.directions.data(), rays.count},
                      kReach, {rays.hits.data(), rays.count});
    lightEnds(rays);

    Light result;
    glm::vec3 open{0.0F};
    glm::vec3 seen{0.0F};
    glm::vec3 bounced{0.0F};
    for (std::size_t i = 0; i < rays.count; ++i) {
        const SceneHit& hit = rays.hits[i];
        const float hidden = hit.distance < kReach ? hiding(hit.distance) : 0.0F;
        const glm::vec3 sky = skyLight(rays.directions[i]);
        open += sky;
        seen += (1.0F - hidden) * sky;
        if (hit.triangle != kNone) {
            bounced += hidden * m_appearance.mean(hit.triangle) * rays.endLight[i];
        }
        result.nearest = std::min(result.nearest, hit.distance);
    }
    // The few directions only tell which share of the sky is seen; how bright the whole is comes
    // from the sky's own table.
    result.irradiance = m_sky.ambient(normal) * seen / glm::max(open, glm::vec3(1e-12F)) +
                        bounced / float(rays.count);
    return result;
}

std::array<glm::vec3, 6> LightGatherer::gatherCube(const glm::vec3& point) const {
    const auto directions = sphereSpiral();
    Rays rays;
    rays.count = directions.size();
    std::fill_n(rays.origins.begin(), rays.count, point);
    std::copy(directions.begin(), directions.end(), rays.directions.begin());
    m_scene.intersect({rays.origins.data(), rays.count}, {rays.directions.data(), rays.count},
                      kReach, {rays.hits.data(), rays.count});
    lightEnds(rays);

    std::array<glm::vec3, 6> open{};
    std::array<glm::vec3, 6> seen{};
    std::array<glm::vec3, 6> bounced{};
    std::array<float, 6> weight{};
    for (std::size_t i = 0; i < rays.count; ++i) {
        const SceneHit& hit = rays.hits[i];
        const float hidden = hit.distance < kReach ? hiding(hit.distance) : 0.0F;
        const glm::vec3 sky = skyLight(rays.directions[i]);
        glm::vec3 bounce{0.0F};
        if (hit.triangle != kNone) {
            bounce = hidden * m_appearance.mean(hit.triangle) * rays.endLight[i];
        }
        for (std::size_t side = 0; side < 6; ++side) {
            const float along = rays.directions[i][int(side / 2)];
            const float cosine = std::max(side % 2 == 0 ? along : -along, 0.0F);
            open[side] += cosine * sky;
            seen[side] += cosine * (1.0F - hidden) * sky;
            bounced[side] += cosine * bounce;
            weight[side] += cosine;
        }
    }
    std::array<glm::vec3, 6> light{};
    for (std::size_t side = 0; side < 6; ++side) {
        glm::vec3 normal{0.0F};
        normal[int(side / 2)] = side % 2 == 0 ? 1.0F : -1.0F;
        // As in gather(): the directions tell the share, the sky's table how bright the whole is.
        light[side] = m_sky.ambient(normal) * seen[side] / glm::max(open[side], glm::vec3(1e-12F)) +
                      bounced[side] / weight[side];
    }
    return light;
}

}  // namespace reflet
