// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ImageFigures.h"

#include <numeric>

namespace reflet {

namespace {

DisplayImage faceOf(const DisplayImage& strip, int face) {
    const int n = strip.width;
    const auto size = std::ptrdiff_t(n) * n;
    return {n, n, {strip.pixels.begin() + face * size, strip.pixels.begin() + (face + 1) * size}};
}

}  // namespace

std::vector<float> ImageTally::add(const DisplayImage& image, const DisplayImage& reference,
                                   std::span<const unsigned char> mask) {
    m_squared.add(image, reference, mask);
    m_absolute.add(image, reference, mask);
    if (const auto value = ssim(image, reference, mask))
        m_ssim.push_back(*value);
    std::vector<float> errors = flipMap(image, reference, kFlipPixelsPerDegree);
    m_flip.add(errors, mask);
    return errors;
}

std::vector<float> ImageTally::add(const LocalEnvironmentMap& ours,
                                   const LocalEnvironmentMap& truth, float exposure) {
    const DisplayImage strip = displayStrip(ours.radiance, exposure);
    const DisplayImage reference = displayStrip(truth.radiance, exposure);
    m_squared.add(strip, reference);
    m_absolute.add(strip, reference);
    for (int face = 0; face < 6; ++face) {
        if (const auto value = ssim(faceOf(strip, face), faceOf(reference, face)))
            m_ssim.push_back(*value);
    }
    std::vector<float> errors =
        flipMap(strip, reference, facePixelsPerDegree(ours.radiance.resolution()));
    m_flip.add(errors);
    return errors;
}

ImageFigures ImageTally::figures() const {
    ImageFigures out;
    out.psnr = m_squared.decibels();
    if (!m_ssim.empty())
        out.ssim = std::accumulate(m_ssim.begin(), m_ssim.end(), 0.0) / double(m_ssim.size());
    out.flip = m_flip.mean();
    if (out.flip == 0.0)
        out.flip.reset();
    out.meanError = m_absolute.mean().value_or(0.0);
    return out;
}

}  // namespace reflet
