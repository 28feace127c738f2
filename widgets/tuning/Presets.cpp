// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/Presets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr double kLargestRatio = 10.0;
constexpr double kSmallestRatio = 0.005;

struct Preset {
    double depthRatio;
    double smallestQuad;
    int resolution;
    bool traceEdgeTexels;
};
constexpr std::array<Preset, kPresets> kPresetValues{{{1.0, 4.0, 64, false},
                                                      {0.5, 2.0, 128, false},
                                                      {0.2, 1.0, 128, true},
                                                      {0.1, 1.0, 256, true},
                                                      {0.0, 1.0, 256, true}}};

}  // namespace

MemSettings withPreset(MemSettings settings, int preset) {
    const Preset& values = kPresetValues[std::size_t(std::clamp(preset, 0, kPresets - 1))];
    settings.depthRatio = values.depthRatio;
    settings.smallestQuad = values.smallestQuad;
    settings.resolution = values.resolution;
    settings.traceEdgeTexels = values.traceEdgeTexels;
    return settings;
}

std::optional<int> presetOf(const MemSettings& settings) {
    for (int preset = 0; preset < kPresets; ++preset)
        if (withPreset(settings, preset) == settings)
            return preset;
    return std::nullopt;
}

double depthRatioAt(int position) {
    if (position <= 0)
        return std::numeric_limits<double>::infinity();
    if (position >= kDetailSteps)
        return 0.0;
    const double t = double(position - 1) / double(kDetailSteps - 2);
    const double ratio = kLargestRatio * std::pow(kSmallestRatio / kLargestRatio, t);
    // Two digits: what is shown is what is used.
    const double digit = std::pow(10.0, std::floor(std::log10(ratio)) - 1.0);
    return std::round(ratio / digit) * digit;
}

int positionOf(double depthRatio) {
    if (!(depthRatio > 0.0))
        return kDetailSteps;
    if (std::isinf(depthRatio))
        return 0;
    const double t =
        std::log(depthRatio / kLargestRatio) / std::log(kSmallestRatio / kLargestRatio);
    return std::clamp(1 + int(std::lround(t * (kDetailSteps - 2))), 1, kDetailSteps - 1);
}

}  // namespace reflet
