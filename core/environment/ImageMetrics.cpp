// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/ImageMetrics.h"

#include <glm/common.hpp>

#include <cassert>
#include <cmath>

namespace reflet {

namespace {

/// Calls visit with the difference of each pair of pixels that counts.
template <class Visit>
void forEachError(const DisplayImage& image, const DisplayImage& reference,
                  std::span<const unsigned char> mask, const Visit& visit) {
    assert(image.width == reference.width && image.height == reference.height);
    assert(image.pixels.size() == reference.pixels.size());
    assert(mask.empty() || mask.size() == image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (mask.empty() || mask[i] != 0)
            visit(glm::dvec3(image.pixels[i]) - glm::dvec3(reference.pixels[i]));
    }
}

}  // namespace

float srgbFromLinear(float linear) {
    if (linear <= 0.0031308f)
        return 12.92f * linear;
    return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linearFromSrgb(float encoded) {
    if (encoded <= 0.04045f)
        return encoded / 12.92f;
    return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 toDisplay(const glm::vec3& radiance, float exposure) {
    const auto channel = [exposure](float value) {
        const float scaled = value * exposure;
        if (!(scaled > 0.0f))
            return 0.0f;
        return scaled >= 1.0f ? 1.0f : srgbFromLinear(scaled);
    };
    return {channel(radiance.x), channel(radiance.y), channel(radiance.z)};
}

DisplayImage displayStrip(const CubeMap<glm::vec3>& radiance, float exposure) {
    DisplayImage image{radiance.resolution(), 6 * radiance.resolution(), {}};
    image.pixels.reserve(radiance.texels().size());
    for (const glm::vec3& texel : radiance.texels())
        image.pixels.push_back(toDisplay(texel, exposure));
    return image;
}

void PsnrAccumulator::add(const DisplayImage& image, const DisplayImage& reference,
                          std::span<const unsigned char> mask) {
    forEachError(image, reference, mask, [this](const glm::dvec3& error) {
        m_squaredError += error.x * error.x + error.y * error.y + error.z * error.z;
        m_samples += 3;
    });
}

std::optional<double> PsnrAccumulator::decibels() const {
    if (m_samples == 0 || m_squaredError == 0.0)
        return std::nullopt;
    return -10.0 * std::log10(m_squaredError / double(m_samples));
}

void MeanErrorAccumulator::add(const DisplayImage& image, const DisplayImage& reference,
                               std::span<const unsigned char> mask) {
    forEachError(image, reference, mask, [this](const glm::dvec3& signedError) {
        const glm::dvec3 error = glm::abs(signedError);
        m_error += error.x + error.y + error.z;
        m_samples += 3;
    });
}

std::optional<double> MeanErrorAccumulator::mean() const {
    if (m_samples == 0)
        return std::nullopt;
    return m_error / double(m_samples);
}

}  // namespace reflet
