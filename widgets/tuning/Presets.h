// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <optional>

namespace reflet {

/// Qualities that a planner chooses from, from fast to exact. They set R, the smallest quad, the
/// map's resolution and whether edges are traced texel by texel, and leave the rest alone. The
/// middle one is the default.
inline constexpr int kPresets = 5;
[[nodiscard]] MemSettings withPreset(MemSettings settings, int preset);
/// nullopt when the settings are none of the presets.
[[nodiscard]] std::optional<int> presetOf(const MemSettings& settings);

/// The slider of *detail at edges*: position 0 is R = infinity (no refinement), the last one R = 0
/// (everywhere), between them R falls from 10 to 0.005 in equal ratios.
inline constexpr int kDetailSteps = 200;
[[nodiscard]] double depthRatioAt(int position);
/// The position nearest to R; the ends only for infinity and 0 themselves.
[[nodiscard]] int positionOf(double depthRatio);

}  // namespace reflet
