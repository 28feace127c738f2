// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/LevelOfDetail.h"

#include "core/math/Geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace reflet {

namespace {

/// Bodies below so many pixels show the blend of two REMs.
constexpr double kBlendPixels = 24.0;
/// Other vehicles are left out of coarser and smaller maps.
constexpr double kMostCoarseWithOthers = 5.0;
constexpr int kSmallestMapWithOthers = 64;
constexpr double kUnitsOfBody = 8000.0;
/// Flat sides squeeze nothing, but a map is not made finer for them without end.
constexpr double kLeastSqueeze = 0.5;
/// How much each step of coarseness takes from the size that counts, in halvings: first the mesh
/// gets coarser, then the map smaller, and a body that looks large is never shown a blend.
constexpr double kMeshStep = 0.8, kMapStep = 0.3, kBlendStep = 0.2;
/// Share of a step (a factor of two) by which a level may be wrong before it changes.
constexpr double kHold = 0.25;
constexpr int kLargestQuadStep = 4;
/// A blend at infinity shows no parallax: its weights alone change.
constexpr double kBlendReuse = 2.0;                      // metres
constexpr double kLeastReuse = 0.002, kMostReuse = 5.0;  // metres
constexpr double kLeastPixels = 1e-3, kLeastNearest = 0.05;
/// Of a map beside its texels: choice of REMs, upload, mip levels.
constexpr double kUnitsOfMap = 16000.0;

/// Texels along a radian, on average over the sphere: 6 N² of them cover 4π.
double texelsPerRadian(int resolution) {
    return double(resolution) * std::sqrt(6.0 / (4.0 * kPi));
}

/// The whole number at or above x, or the held one while that is wrong by less than kHold.
int stepUp(double x, const std::optional<int>& held) {
    if (held && x <= *held + kHold && x > *held - 1 - kHold)
        return *held;
    return int(std::ceil(x));
}

double sizeOf(const BodyView& view, double halvings) {
    const double interest = std::max(view.interest, 0.0);
    return std::max(view.pixels * interest * std::exp2(-halvings), kLeastPixels);
}

int resolutionFor(double pixels, double squeeze, int tuned, const std::optional<Detail>& held) {
    std::optional<int> heldStep;
    if (held && !held->blend)
        heldStep = int(std::lround(std::log2(double(held->resolution) / kSmallestMap)));
    const double useful = pixels / std::max(squeeze, kLeastSqueeze);
    const int most = std::max(0, int(std::ceil(std::log2(double(tuned) / kSmallestMap))));
    const double x = std::min(std::log2(useful / kSmallestMap), double(most));
    return std::min(kSmallestMap << std::clamp(stepUp(x, heldStep), 0, most), tuned);
}

int quadStepFor(double texels, const std::optional<Detail>& held) {
    std::optional<int> heldStep;
    if (held && !held->blend)
        heldStep = -held->quadStep;
    // The largest step whose quads are no larger than `texels`.
    const double x = -std::log2(std::max(texels, 1.0));
    return std::clamp(-stepUp(x, heldStep), 0, kLargestQuadStep);
}

}  // namespace

double texelsPerPixel(int resolution, const BodyView& view) {
    return double(resolution) / std::max(view.pixels, kLeastPixels) * view.squeeze;
}

bool Detail::atLeast(const Detail& other) const {
    if (other.blend)
        return true;
    // Sizes of quads compare as shares of a face.
    return !blend && resolution >= other.resolution &&
           std::ldexp(1.0, quadStep) / resolution <=
               std::ldexp(1.0, other.quadStep) / other.resolution;
}

Detail chooseDetail(const BodyView& view, const MemSettings& tuned, int coarse,
                    const std::optional<Detail>& held) {
    const double steps = std::clamp(coarse, 0, kMostCoarse);
    const double size = sizeOf(view, kMapStep * steps);
    const double hold = std::exp2(kHold);
    Detail detail;
    const double blendBelow = !held         ? kBlendPixels
                              : held->blend ? kBlendPixels * hold
                                            : kBlendPixels / hold;
    detail.blend = sizeOf(view, kBlendStep * steps) < blendBelow;
    if (detail.blend) {
        detail.resolution = std::min(kSmallestMap, tuned.resolution);
    } else {
        detail.resolution = resolutionFor(size, view.squeeze, tuned.resolution, held);
        const double squeeze = steps > 0.0 ? std::max(view.squeeze, kLeastSqueeze) : view.squeeze;
        const double texels = detail.resolution / sizeOf(view, kMeshStep * steps) * squeeze;
        detail.quadStep = quadStepFor(texels, held);
    }
    detail.others = !detail.blend && steps <= kMostCoarseWithOthers &&
                    detail.resolution >= std::min(kSmallestMapWithOthers, tuned.resolution);
    const double texel = 1.0 / texelsPerRadian(detail.resolution);
    const double pixel = view.squeeze / (size * std::sqrt(6.0 / (4.0 * kPi)));
    detail.angle = std::max(texel, pixel);
    const double way = detail.angle * std::max(view.nearest, kLeastNearest);
    detail.reuse =
        std::clamp(detail.blend ? std::max(way, kBlendReuse) : way, kLeastReuse, kMostReuse);
    return detail;
}

MemSettings settingsOf(const Detail& detail, const MemSettings& tuned) {
    MemSettings settings = tuned;
    settings.lod = {};
    settings.resolution = detail.resolution;
    settings.meshSize = std::min(settings.meshSize, detail.resolution);
    settings.smallestQuad = std::max(settings.smallestQuad, std::exp2(detail.quadStep));
    settings.depthRatio *= std::exp2(0.5 * detail.quadStep);
    return settings;
}

double unitsOf(const Detail& detail) {
    const double texels = 6.0 * double(detail.resolution) * double(detail.resolution);
    if (detail.blend)
        return kUnitsOfMap + 0.2 * texels;
    return kUnitsOfMap + texels * (0.4 + 0.6 * std::exp2(-detail.quadStep));
}

double unitsOfOthers(const Detail& detail, std::size_t bodies) {
    if (!detail.others || bodies == 0)
        return 0.0;
    return 3.0 * double(detail.resolution) * double(detail.resolution) +
           kUnitsOfBody * double(bodies);
}

std::vector<std::size_t> chooseUpdates(std::span<const MapUpdate> updates, double units) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < updates.size(); ++i) {
        if (updates[i].missing || updates[i].error >= 1.0)
            order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const MapUpdate& first = updates[a];
        const MapUpdate& second = updates[b];
        if (first.missing != second.missing)
            return first.missing;
        const auto urgency = [](const MapUpdate& u) {
            return u.missing ? u.weight : u.error * u.weight;
        };
        return urgency(first) > urgency(second);
    });
    std::vector<std::size_t> chosen;
    double spent = 0.0;
    for (const std::size_t i : order) {
        if (!chosen.empty() && spent + updates[i].units > units)
            continue;
        spent += updates[i].units;
        chosen.push_back(i);
    }
    return chosen;
}

}  // namespace reflet
