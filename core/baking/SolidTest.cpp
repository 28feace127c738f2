// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SolidTest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace reflet {

namespace {

constexpr int kMaxAncestors = 64;
constexpr std::size_t kDirections = 13;
constexpr float kSamePlace = 1e-3F;  ///< metres along a ray: neighbours that share an edge

bool isSolid(CityObjectType type) {
    switch (type) {
        case CityObjectType::Building:
        case CityObjectType::BuildingPart:
        case CityObjectType::Bridge:
        case CityObjectType::BridgePart:
        case CityObjectType::OtherConstruction:
            return true;
        default:
            return false;
    }
}

std::uint32_t rootOf(const CityModel& city, std::uint32_t object) {
    for (int step = 0; step < kMaxAncestors; ++step) {
        const auto& parent = city.objects[object].parent;
        if (!parent || *parent >= city.objects.size() || !isSolid(city.objects[*parent].type)) {
            break;
        }
        object = *parent;
    }
    return object;
}

/// Straight up first, then four that rise steeply and eight near the horizon. The azimuths are odd
/// on purpose: no ray runs along a wall that is laid out by compass.
const std::array<glm::vec3, kDirections>& directions() {
    static const std::array<glm::vec3, kDirections> all = [] {
        std::array<glm::vec3, kDirections> d{};
        d[0] = glm::normalize(glm::vec3(0.0037F, 0.0021F, 1.0F));
        for (std::size_t i = 1; i < kDirections; ++i) {
            const bool steep = i < 5;
            const double azimuth =
                steep ? 0.31 + double(i) * 0.5 * kPi : 0.17 + double(i) * 0.25 * kPi;
            const double elevation = steep ? 0.86 : 0.045;
            d[i] = glm::vec3(std::cos(azimuth) * std::cos(elevation),
                             std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
        }
        return d;
    }();
    return all;
}

struct Crossing {
    std::uint32_t object;
    float distance;
};

}  // namespace

bool insideSolid(const CityModel& city, const RayScene& scene, const glm::vec3& point) {
    std::map<std::uint32_t, std::size_t> oddByObject;
    std::map<std::uint32_t, std::size_t> oddByRoot;
    for (std::size_t k = 0; k < kDirections; ++k) {
        std::vector<Crossing> crossings;
        scene.crossings(point, directions()[k], [&](std::uint32_t triangle, float distance) {
            const std::uint32_t surface = city.triangles[triangle].surface;
            if (surface < city.surfaces.size() &&
                city.surfaces[surface].object < city.objects.size() &&
                isSolid(city.objects[city.surfaces[surface].object].type)) {
                crossings.push_back({city.surfaces[surface].object, distance});
            }
        });
        if (k == 0 && crossings.empty()) {
            return false;
        }
        std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
            return a.object != b.object ? a.object < b.object : a.distance < b.distance;
        });
        // Through an edge that two triangles share, a ray crosses once.
        const auto end = std::unique(
            crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
                return a.object == b.object && b.distance - a.distance < kSamePlace;
            });
        std::map<std::uint32_t, bool> object;
        std::map<std::uint32_t, bool> root;
        for (auto it = crossings.begin(); it != end; ++it) {
            object[it->object] = !object[it->object];
            const std::uint32_t r = rootOf(city, it->object);
            root[r] = !root[r];
        }
        for (const auto& [id, odd] : object) {
            oddByObject[id] += odd ? 1U : 0U;
        }
        for (const auto& [id, odd] : root) {
            oddByRoot[id] += odd ? 1U : 0U;
        }
    }
    const auto most = [](const auto& entry) { return entry.second * 3 > kDirections * 2; };
    return std::any_of(oddByObject.begin(), oddByObject.end(), most) ||
           std::any_of(oddByRoot.begin(), oddByRoot.end(), most);
}

}  // namespace reflet
