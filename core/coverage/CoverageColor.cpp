// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/CoverageColor.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

glm::vec3 coverageColor(double coverage) {
    static constexpr std::array<glm::vec3, 6> kScale{{{0.0F, 0.133F, 0.306F},
                                                      {0.208F, 0.271F, 0.424F},
                                                      {0.4F, 0.412F, 0.439F},
                                                      {0.58F, 0.557F, 0.467F},
                                                      {0.784F, 0.722F, 0.4F},
                                                      {0.996F, 0.91F, 0.22F}}};
    const double share = std::isnan(coverage) ? 0.0 : std::clamp(coverage, 0.0, 1.0);
    const double place = share * double(kScale.size() - 1);
    const auto below = std::min(std::size_t(place), kScale.size() - 2);
    return glm::mix(kScale[below], kScale[below + 1], float(place - double(below)));
}

}  // namespace reflet
