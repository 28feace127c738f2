// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightRules.h"

namespace reflet {

namespace {

constexpr std::array<const char*, kHeightPolicyCount> kNames{
    "none", "ground", "cover", "column", "solid", "overhead", "crown", "tunnel"};

HeightPolicy defaultPolicy(CityObjectType type) {
    switch (type) {
        case CityObjectType::Bridge:
        case CityObjectType::BridgePart:
            return HeightPolicy::Overhead;
        case CityObjectType::Tunnel:
            return HeightPolicy::Tunnel;
        case CityObjectType::SolitaryVegetation:
            return HeightPolicy::Crown;
        case CityObjectType::PlantCover:
            return HeightPolicy::Cover;
        default:
            return isTerrain(type) ? HeightPolicy::Ground : HeightPolicy::Solid;
    }
}

}  // namespace

std::array<HeightPolicy, kCityObjectTypeCount> HeightRules::defaultPolicies() {
    std::array<HeightPolicy, kCityObjectTypeCount> policies{};
    for (std::size_t n = 0; n < policies.size(); ++n)
        policies[n] = defaultPolicy(CityObjectType(n));
    return policies;
}

const char* toString(HeightPolicy policy) {
    return kNames[std::size_t(policy)];
}

std::optional<HeightPolicy> heightPolicyFromText(std::string_view text) {
    for (std::size_t n = 0; n < kNames.size(); ++n) {
        if (text == kNames[n])
            return HeightPolicy(n);
    }
    return std::nullopt;
}

HeightPolicy policyOf(const CityModel& city, const HeightRules& rules, std::uint32_t surface) {
    const CitySurface& s = city.surfaces[surface];
    return s.type == SurfaceType::Closure ? HeightPolicy::None
                                          : rules.policy(city.objects[s.object].type);
}

}  // namespace reflet
