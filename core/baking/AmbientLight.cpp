// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/AmbientLight.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kDirections = 32;
constexpr float kReach = 25.0F;  ///< metres; what is further away occludes no light
constexpr float kFadeFrom = 12.0F;
constexpr double kCell = 0.5;            ///< metres between lattice points
constexpr float kNear = 1.6F;            ///< more than two diagonals of a cell
constexpr float kLift = 0.02F;           ///< metres that rays start above their surface
constexpr float kBounceAmbient = 0.55F;  ///< share of the open sky that a bouncing surface sees
constexpr std::size_t kSlotCount = std::size_t(1) << 20;
constexpr int kTableColumns = 96;
constexpr int kTableRows = 64;
constexpr std::uint64_t kConfined = 1;

/// Cosine-distributed directions about +z: a Fibonacci spiral on the disc, lifted to the hemisphere
/// (Malley's method), so that each carries the same irradiance under a uniform sky.
const std::array<glm::vec3, kDirections>& fixedDirections() {
    static const std::array<glm::vec3, kDirections> directions = [] {
        std::array<glm::vec3, kDirections> d{};
        for (std::size_t i = 0; i < kDirections; ++i) {
            const double r2 = (double(i) + 0.5) / double(kDirections);
            const double phi = double(i) * kPi * (3.0 - std::sqrt(5.0));
            const double r = std::sqrt(r2);
            d[i] = glm::vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r2));
        }
        return d;
    }();
    return directions;
}

/// Two unit vectors that make a right-handed frame with n; continuous for all normals near up.
struct Frame {
    glm::vec3 tangent;
    glm::vec3 bitangent;
};
Frame frameOf(const glm::vec3& n) {
    const glm::vec3 axis =
        std::abs(n.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 tangent = glm::normalize(axis - n * glm::dot(n, axis));
    return {tangent, glm::cross(n, tangent)};
}

std::uint64_t mix64(std::uint64_t h) {  // the finaliser of MurmurHash3
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

std::uint64_t pack(const glm::vec3& light, bool confined) {
    return std::uint64_t(glm::packHalf1x16(light.r)) << 16 |
           std::uint64_t(glm::packHalf1x16(light.g)) << 32 |
           std::uint64_t(glm::packHalf1x16(light.b)) << 48 | (confined ? kConfined : 0);
}

glm::vec3 unpack(std::uint64_t value) {
    return {glm::unpackHalf1x16(std::uint16_t(value >> 16)),
            glm::unpackHalf1x16(std::uint16_t(value >> 32)),
            glm::unpackHalf1x16(std::uint16_t(value >> 48))};
}

}  // namespace

/// The half-metre lattice in a plane: point = anchor + i·cell·tangent + j·cell·bitangent.
struct AmbientLight::Lattice {
    std::uint64_t plane = 0;
    glm::dvec3 anchor{0.0};
    glm::dvec3 tangent{0.0};
    glm::dvec3 bitangent{0.0};
};

AmbientLight::AmbientLight(const CityModel& city, const RayScene& scene,
                           const CityAppearance& appearance, const Sky& sky)
    : m_city(city),
      m_scene(scene),
      m_appearance(appearance),
      m_sky(sky),
      m_skyTable(std::size_t(kTableColumns) * kTableRows),
      m_slots(std::make_unique<Slot[]>(kSlotCount)) {
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

AmbientLight::~AmbientLight() = default;

glm::vec3 AmbientLight::skyLight(const glm::vec3& direction) const {
    const float turn = std::atan2(direction.y, direction.x) / (2.0F * float(kPi));
    const int column = int((turn - std::floor(turn)) * float(kTableColumns)) % kTableColumns;
    const int row =
        std::clamp(int((direction.z * 0.5F + 0.5F) * float(kTableRows)), 0, kTableRows - 1);
    return m_skyTable[std::size_t(row) * kTableColumns + std::size_t(column)];
}

AmbientLight::Sample AmbientLight::gather(const glm::vec3& point, const glm::vec3& normal) const {
    const Frame frame = frameOf(normal);
    std::array<glm::vec3, kDirections> origins;
    std::array<glm::vec3, kDirections> directions;
    std::array<SceneHit, kDirections> hits;
    origins.fill(point + kLift * normal);
    for (std::size_t i = 0; i < kDirections; ++i) {
        const glm::vec3& d = fixedDirections()[i];
        directions[i] = d.x * frame.tangent + d.y * frame.bitangent + d.z * normal;
    }
    m_scene.intersect(origins, directions, kReach, hits);

    // Where a ray ends, does the sun reach? One packet of shadow rays for all ends.
    std::array<glm::vec3, kDirections> ends;
    std::array<glm::vec3, kDirections> sunward;
    std::array<float, kDirections> far;
    std::array<unsigned char, kDirections> shadowed{};
    std::array<float, kDirections> facing{};
    std::array<std::size_t, kDirections> slot{};
    std::size_t lit = 0;
    const bool day = m_sky.sunRadiance().g > 0.0F;
    std::array<glm::vec3, kDirections> endNormal;
    for (std::size_t i = 0; i < kDirections; ++i) {
        if (hits[i].triangle == kNone) {
            continue;
        }
        const glm::vec3 n = m_city.normal(hits[i].triangle);
        endNormal[i] = glm::dot(n, directions[i]) > 0.0F ? -n : n;
        facing[i] = glm::dot(endNormal[i], m_sky.sunDirection());
        if (day && facing[i] > 0.0F) {
            ends[lit] = origins[i] + hits[i].distance * directions[i] + kLift * endNormal[i];
            sunward[lit] = m_sky.sunDirection();
            far[lit] = kInfinity;
            slot[lit++] = i;
        }
    }
    m_scene.occluded({ends.data(), lit}, {sunward.data(), lit}, {far.data(), lit},
                     {shadowed.data(), lit});
    std::array<float, kDirections> sun{};
    for (std::size_t k = 0; k < lit; ++k) {
        sun[slot[k]] = shadowed[k] != 0 ? 0.0F : facing[slot[k]];
    }

    Sample sample;
    glm::vec3 open{0.0F};
    glm::vec3 seen{0.0F};
    glm::vec3 bounced{0.0F};
    for (std::size_t i = 0; i < kDirections; ++i) {
        const glm::vec3 sky = skyLight(directions[i]);
        open += sky;
        float hidden = 0.0F;
        if (hits[i].distance < kReach) {
            const float t =
                std::clamp((hits[i].distance - kFadeFrom) / (kReach - kFadeFrom), 0.0F, 1.0F);
            hidden = 1.0F - t * t * (3.0F - 2.0F * t);
            sample.confined |= hits[i].distance < kNear;
        }
        if (hits[i].triangle != kNone) {
            const glm::vec3 light =
                sun[i] * m_sky.sunRadiance() + kBounceAmbient * m_sky.ambient(endNormal[i]);
            bounced += hidden * m_appearance.mean(hits[i].triangle) * light;
        }
        seen += (1.0F - hidden) * sky;
    }
    // The few directions only tell which share of the sky is seen; how bright the whole is comes
    // from the sky's own table.
    const glm::vec3 share = seen / glm::max(open, glm::vec3(1e-12F));
    sample.light = m_sky.ambient(normal) * share + bounced / float(kDirections);
    return sample;
}

AmbientLight::Sample AmbientLight::cached(std::uint64_t key, const glm::vec3& point,
                                          const glm::vec3& normal) const {
    Slot& slot = m_slots[key & (kSlotCount - 1)];
    const std::uint64_t check = slot.check.load(std::memory_order_relaxed);
    std::uint64_t value = slot.value.load(std::memory_order_relaxed);
    if ((check ^ value) != key || check == 0) {
        const Sample sample = gather(point, normal);
        value = pack(sample.light, sample.confined);
        slot.check.store(key ^ value, std::memory_order_relaxed);
        slot.value.store(value, std::memory_order_relaxed);
    }
    return {unpack(value), (value & kConfined) != 0};
}

glm::vec3 AmbientLight::interpolate(const Lattice& lattice, const glm::vec3& point,
                                    const glm::vec3& normal) const {
    const glm::dvec3 offset = glm::dvec3(point) - lattice.anchor;
    const double x = glm::dot(offset, lattice.tangent) / kCell;
    const double y = glm::dot(offset, lattice.bitangent) / kCell;
    const double column = std::floor(x);
    const double row = std::floor(y);
    const auto fx = float(x - column);
    const auto fy = float(y - row);
    const std::array<float, 4> weight{(1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy,
                                      fx * fy};
    glm::vec3 sum{0.0F};
    float total = 0.0F;
    for (int k = 0; k < 4; ++k) {
        const auto i = std::int64_t(column) + (k & 1);
        const auto j = std::int64_t(row) + (k >> 1);
        const glm::vec3 corner(lattice.anchor + (double(i) * kCell) * lattice.tangent +
                               (double(j) * kCell) * lattice.bitangent);
        const std::uint64_t key =
            mix64(lattice.plane ^ mix64(std::uint64_t(i) << 32 ^ (std::uint64_t(j) & 0xffffffffU)));
        const Sample sample = cached(key, corner, normal);
        if (sample.confined) {
            // Behind a wall, or under the next surface: it says nothing about this side.
            const glm::vec3 from = point + kLift * normal;
            const glm::vec3 way = corner + kLift * normal - from;
            const float length = glm::length(way);
            if (length > 1e-4F && m_scene.occluded(from, way / length, length)) {
                continue;
            }
        }
        sum += weight[std::size_t(k)] * sample.light;
        total += weight[std::size_t(k)];
    }
    return total > 0.02F ? sum / total : gather(point, normal).light;
}

glm::vec3 AmbientLight::onCity(std::uint32_t triangle, const glm::vec3& point,
                               const glm::vec3& normal) const {
    const auto& v = m_city.triangles[triangle].vertex;
    const glm::vec3& a = m_city.vertices[v[0]];
    const glm::vec3& b = m_city.vertices[v[1]];
    const glm::vec3& c = m_city.vertices[v[2]];
    bool flipped = glm::dot(m_city.normal(triangle), normal) < 0.0F;
    const float extent = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    if (extent < 2.0F * float(kCell)) {
        const std::uint64_t key = mix64(std::uint64_t(triangle) << 2 | (flipped ? 3U : 1U));
        return cached(key, (a + b + c) / 3.0F, normal).light;
    }
    // Triangles of one plane share its lattice.
    const std::uint32_t surface = m_city.triangles[triangle].surface;
    Lattice lattice;
    lattice.anchor = glm::dvec3(a);
    glm::vec3 facing = normal;
    std::uint64_t id = std::uint64_t(triangle) << 3;
    if (surface < m_city.surfaces.size() && m_appearance.looks().surface(surface).planar) {
        const auto first = *m_appearance.looks().triangles(surface).first;
        lattice.anchor = glm::dvec3(m_city.vertices[m_city.triangles[first].vertex[0]]);
        const glm::vec3& whole = m_appearance.looks().surface(surface).normal;
        flipped = glm::dot(whole, normal) < 0.0F;
        facing = flipped ? -whole : whole;
        id = std::uint64_t(surface) << 3 | 4U;
    }
    lattice.plane = mix64(id | (flipped ? 2U : 0U));
    const Frame frame = frameOf(facing);
    lattice.tangent = glm::dvec3(frame.tangent);
    lattice.bitangent = glm::dvec3(frame.bitangent);
    // Off the vertex by an odd share of a cell: walls often stand on the edges of what they meet,
    // and a lattice point in a wall's plane would be neither before nor behind it.
    lattice.anchor += kCell * (0.2371 * lattice.tangent + 0.1873 * lattice.bitangent);
    return interpolate(lattice, point, facing);
}

glm::vec3 AmbientLight::at(const glm::vec3& point, const glm::vec3& normal) const {
    return gather(point, normal).light;
}

}  // namespace reflet
