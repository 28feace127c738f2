// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace reflet {

/// Reflectance of a dielectric of refractive index 1.5 at normal incidence: ((1.5-1)/(1.5+1))².
inline constexpr float kDielectricF0 = 0.04F;
/// Of automotive glazing, both faces of the pane together (2 F0 / (1 + F0)).
inline constexpr float kGlazingF0 = 0.077F;

/// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering, equation 15:
/// F = F0 + (1 - F0)(1 - cos θ)^5. cosine: between the normal and either direction, clamped to
/// 0..1.
template <class T>
[[nodiscard]] T fresnelSchlick(const T& f0, float cosine) {
    const float m = 1.0F - std::clamp(cosine, 0.0F, 1.0F);
    const float m2 = m * m;
    return f0 + (T(1.0F) - f0) * (m2 * m2 * m);
}

}  // namespace reflet
