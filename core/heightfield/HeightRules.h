// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace reflet {

/// How the objects of a class take part in a heightfield. Closure surfaces never do.
enum class HeightPolicy : std::uint8_t {
    None,      ///< left out
    Ground,    ///< bare ground: vehicles drive on it
    Cover,     ///< ground where it lies on what the other classes say of the ground (a meadow),
               ///< and stands on the ground where it is higher (a wood drawn as its canopy)
    Column,    ///< solid from its highest surface down, as if nothing were ever hollow
    Solid,     ///< stands on the ground; hollow only beneath an underside that is modelled
    Overhead,  ///< like Solid, but surfaces without an underside are thin: a deck fills no street
    Crown,     ///< dense between its lowest and its highest surface: foliage above a trunk
    Tunnel,    ///< not part of the top layers; its inside is cut out of the ground above it
};

inline constexpr std::size_t kHeightPolicyCount = 8;
inline constexpr std::size_t kCityObjectTypeCount = std::size_t(CityObjectType::Other) + 1;

/// Which class of city objects counts to which layer of a heightfield, and how low a hollow may be.
struct HeightRules {
    std::array<HeightPolicy, kCityObjectTypeCount> policies = defaultPolicies();
    /// Metres. Hollows that are lower than this count as solid: floors a little above the ground.
    double clearance = 1.0;

    [[nodiscard]] HeightPolicy policy(CityObjectType type) const {
        return policies[std::size_t(type)];
    }
    [[nodiscard]] static std::array<HeightPolicy, kCityObjectTypeCount> defaultPolicies();

    friend bool operator==(const HeightRules&, const HeightRules&) = default;
};

/// The policy's name in project files: "none", "ground", "cover", "column", "solid", "overhead",
/// "crown", "tunnel".
[[nodiscard]] const char* toString(HeightPolicy policy);
[[nodiscard]] std::optional<HeightPolicy> heightPolicyFromText(std::string_view text);

/// How a surface of the city takes part.
[[nodiscard]] HeightPolicy policyOf(const CityModel& city, const HeightRules& rules,
                                    std::uint32_t surface);

}  // namespace reflet
