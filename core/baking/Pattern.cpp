// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/Pattern.h"

namespace reflet {

const std::array<float, 256>& linearFromSrgbTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double c = double(i) / 255.0;
            t[i] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        return t;
    }();
    return table;
}

glm::vec3 colourOf(std::uint32_t srgb) {
    const auto& linear = linearFromSrgbTable();
    return {linear[(srgb >> 16) & 255U], linear[(srgb >> 8) & 255U], linear[srgb & 255U]};
}

}  // namespace reflet
