// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/AmbientLight.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr double kCell = 0.5;            ///< metres between lattice points, at the finest
constexpr int kLevels = 4;               ///< lattices, each twice as coarse as the one before
constexpr float kFinestSample = 0.125F;  ///< footprint up to which the finest is used
constexpr std::size_t kSlotCount = std::size_t(1) << 20;  // 16 MiB

std::uint64_t mix64(std::uint64_t h) {  // the finaliser of MurmurHash3
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

std::uint64_t pack(const LightGatherer::Light& light) {
    const auto half = [](float value, int shift) {
        return std::uint64_t(glm::packHalf1x16(value)) << shift;
    };
    return half(std::min(light.nearest, 1000.0F), 0) | half(light.irradiance.r, 16) |
           half(light.irradiance.g, 32) | half(light.irradiance.b, 48);
}

LightGatherer::Light unpack(std::uint64_t value) {
    const auto half = [&](int shift) { return glm::unpackHalf1x16(std::uint16_t(value >> shift)); };
    return {{half(16), half(32), half(48)}, half(0)};
}

}  // namespace

/// The lattices in a plane: point = anchor + i·cell·tangent + j·cell·bitangent.
struct AmbientLight::Lattice {
    std::uint64_t plane = 0;  ///< key of the plane and the side of it
    glm::dvec3 anchor{0.0};
    glm::dvec3 tangent{0.0};
    glm::dvec3 bitangent{0.0};
    glm::vec3 normal{0.0F};
};

AmbientLight::AmbientLight(const CityModel& city, const RayScene& scene, const SurfaceLooks& looks,
                           const LightGatherer& gatherer)
    : m_city(city),
      m_scene(scene),
      m_looks(looks),
      m_gatherer(gatherer),
      m_slots(std::make_unique<Slot[]>(kSlotCount)) {}

AmbientLight::~AmbientLight() = default;

double AmbientLight::reach() {
    // From the point to the farthest corner of its cell in the coarsest lattice, which lies in the
    // surface's plane or within 5 cm of it; and from there as far as light is gathered.
    constexpr double kOffPlane = 0.1;
    const double cell = kCell * double(1 << (kLevels - 1));
    return std::sqrt(2.0) * cell + double(LightGatherer::reach()) + kOffPlane;
}

LightGatherer::Light AmbientLight::cached(std::uint64_t key, const glm::vec3& point,
                                          const glm::vec3& normal,
                                          LightGatherer::Effort effort) const {
    Slot& slot = m_slots[key & (kSlotCount - 1)];
    const std::uint64_t check = slot.check.load(std::memory_order_relaxed);
    std::uint64_t value = slot.value.load(std::memory_order_relaxed);
    if ((check ^ value) != key || key == 0) {
        value = pack(m_gatherer.gather(point, normal, effort));
        slot.check.store(key ^ value, std::memory_order_relaxed);
        slot.value.store(value, std::memory_order_relaxed);
    }
    return unpack(value);
}

AmbientLight::Lattice AmbientLight::latticeOf(std::uint32_t triangle,
                                              const glm::vec3& normal) const {
    const auto anchorOf = [&](std::uint32_t t) {
        return glm::dvec3(m_city.vertices[m_city.triangles[t].vertex[0]]);
    };
    Lattice lattice;
    const std::uint32_t surface = m_city.triangles[triangle].surface;
    if (surface < m_city.surfaces.size() && m_looks.surface(surface).planar) {
        // The triangles of a planar surface share one lattice.
        const glm::vec3& whole = m_looks.surface(surface).normal;
        const bool flipped = glm::dot(whole, normal) < 0.0F;
        lattice.normal = flipped ? -whole : whole;
        lattice.anchor = anchorOf(*m_looks.triangles(surface).first);
        lattice.plane = mix64(std::uint64_t(surface) << 3 | 4U | (flipped ? 2U : 0U));
    } else {
        const bool flipped = glm::dot(m_city.normal(triangle), normal) < 0.0F;
        lattice.normal = normal;
        lattice.anchor = anchorOf(triangle);
        lattice.plane = mix64(std::uint64_t(triangle) << 3 | (flipped ? 2U : 0U));
    }
    const NormalFrame frame = frameAround(lattice.normal);
    lattice.tangent = glm::dvec3(frame.tangent);
    lattice.bitangent = glm::dvec3(frame.bitangent);
    // Off the vertex by an odd share of a cell: walls often stand on the edges of what they meet,
    // and a lattice point in a wall's plane would be neither before nor behind it.
    lattice.anchor += kCell * (0.2371 * lattice.tangent + 0.1873 * lattice.bitangent);
    return lattice;
}

bool AmbientLight::separated(const glm::vec3& a, const glm::vec3& b,
                             const glm::vec3& normal) const {
    const glm::vec3 way = b - a;
    const float length = glm::length(way);
    return length > 1e-4F &&
           m_scene.occluded(a + LightGatherer::lift() * normal, way / length, length);
}

glm::vec3 AmbientLight::interpolate(const Lattice& lattice, const glm::vec3& point,
                                    int level) const {
    const double cell = kCell * double(1 << level);
    const glm::dvec3 offset = glm::dvec3(point) - lattice.anchor;
    const double x = glm::dot(offset, lattice.tangent) / cell;
    const double y = glm::dot(offset, lattice.bitangent) / cell;
    const double column = std::floor(x);
    const double row = std::floor(y);
    const auto u = float(x - column);
    const auto v = float(y - row);
    const std::array<float, 4> weight{(1.0F - u) * (1.0F - v), u * (1.0F - v), (1.0F - u) * v,
                                      u * v};
    glm::vec3 sum{0.0F};
    float total = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto i = std::int64_t(column) + std::int64_t(k & 1U);
        const auto j = std::int64_t(row) + std::int64_t(k >> 1U);
        const glm::vec3 corner(lattice.anchor + double(i) * cell * lattice.tangent +
                               double(j) * cell * lattice.bitangent);
        const std::uint64_t place = std::uint64_t(i) << 32 ^ (std::uint64_t(j) & 0xffffffffU);
        const LightGatherer::Light light =
            cached(mix64(lattice.plane + std::uint64_t(level) + mix64(place)), corner,
                   lattice.normal, LightGatherer::Effort::Fine);
        // Behind a wall, or under the next surface, it says nothing about this side; a wall
        // between here and there is within a cell's diagonal of the corner.
        const bool confined = light.nearest < 2.0F * float(cell);
        if (!confined || !separated(point, corner, lattice.normal)) {
            sum += weight[k] * light.irradiance;
            total += weight[k];
        }
    }
    return total > 0.02F
               ? sum / total
               : m_gatherer.gather(point, lattice.normal, LightGatherer::Effort::Medium).irradiance;
}

glm::vec3 AmbientLight::at(std::uint32_t triangle, const glm::vec3& point, const glm::vec3& normal,
                           float footprint) const {
    const auto& v = m_city.triangles[triangle].vertex;
    const glm::vec3& a = m_city.vertices[v[0]];
    const glm::vec3& b = m_city.vertices[v[1]];
    const glm::vec3& c = m_city.vertices[v[2]];
    const float extent = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    if (extent < 2.0F * float(kCell)) {
        const bool flipped = glm::dot(m_city.normal(triangle), normal) < 0.0F;
        const std::uint64_t key = mix64(std::uint64_t(triangle) << 3 | (flipped ? 3U : 1U));
        const auto effort =
            extent < float(kCell) ? LightGatherer::Effort::Coarse : LightGatherer::Effort::Medium;
        return cached(key, (a + b + c) / 3.0F, normal, effort).irradiance;
    }
    const Lattice lattice = latticeOf(triangle, normal);
    const float lod =
        std::clamp(std::log2(std::max(footprint, 1e-6F) / kFinestSample), 0.0F, float(kLevels - 1));
    const int level = int(lod);
    const glm::vec3 fine = interpolate(lattice, point, level);
    // The change to the next lattice is drawn out, so that no line is seen where it happens.
    const float change = 2.0F * (lod - float(level)) - 1.0F;
    return change <= 0.0F ? fine : glm::mix(fine, interpolate(lattice, point, level + 1), change);
}

}  // namespace reflet
