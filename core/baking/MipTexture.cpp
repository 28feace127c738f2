// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/MipTexture.h"

#include "core/baking/Pattern.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr int kMaxTaps = 8;

/// The sRGB code of a linear value, from a table over its square root, in which codes lie almost
/// evenly.
std::uint8_t encode(float linear) {
    static const std::array<std::uint8_t, 4097> table = [] {
        std::array<std::uint8_t, 4097> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double root = double(i) / 4096.0;
            const double c = root * root;
            const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
            t[i] = std::uint8_t(std::lround(255.0 * s));
        }
        return t;
    }();
    const float root = std::sqrt(std::clamp(linear, 0.0F, 1.0F));
    return table[std::size_t(std::lround(4096.0F * root))];
}

glm::vec4 decode(const std::uint8_t* rgba) {
    const auto& linear = linearFromSrgbTable();
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]], float(rgba[3]) / 255.0F};
}

/// One row of the next level: each texel is the area average of what it covers, weighted by alpha
/// so that cut-away parts leave no fringe.
void halveRow(const TextureImage& from, TextureImage& to, int row) {
    const double scaleX = double(from.width) / to.width;
    const double scaleY = double(from.height) / to.height;
    for (int column = 0; column < to.width; ++column) {
        const double x0 = column * scaleX;
        const double y0 = row * scaleY;
        glm::vec3 colour{0.0F};
        float alpha = 0.0F;
        float weight = 0.0F;
        for (int y = int(y0); y < std::min(from.height, int(std::ceil(y0 + scaleY))); ++y) {
            for (int x = int(x0); x < std::min(from.width, int(std::ceil(x0 + scaleX))); ++x) {
                const double w = (std::min(x + 1.0, x0 + scaleX) - std::max(double(x), x0)) *
                                 (std::min(y + 1.0, y0 + scaleY) - std::max(double(y), y0));
                const glm::vec4 t = decode(
                    &from.rgba[4 * (std::size_t(y) * std::size_t(from.width) + std::size_t(x))]);
                colour += float(w) * t.a * glm::vec3(t);
                alpha += float(w) * t.a;
                weight += float(w);
            }
        }
        std::uint8_t* out =
            &to.rgba[4 * (std::size_t(row) * std::size_t(to.width) + std::size_t(column))];
        const glm::vec3 mean = alpha > 0.0F ? colour / alpha : glm::vec3(0.0F);
        out[0] = encode(mean.r);
        out[1] = encode(mean.g);
        out[2] = encode(mean.b);
        out[3] = weight > 0.0F ? std::uint8_t(std::lround(255.0F * alpha / weight)) : 0;
    }
}

/// The same where both edges halve exactly.
void halveEvenRow(const TextureImage& from, TextureImage& to, int row) {
    const std::size_t stride = 4 * std::size_t(from.width);
    const std::uint8_t* upper = &from.rgba[2 * std::size_t(row) * stride];
    std::uint8_t* out = &to.rgba[4 * std::size_t(row) * std::size_t(to.width)];
    for (int column = 0; column < to.width; ++column, upper += 8, out += 4) {
        glm::vec3 colour{0.0F};
        float alpha = 0.0F;
        for (const std::uint8_t* t : {upper, upper + 4, upper + stride, upper + stride + 4}) {
            const glm::vec4 c = decode(t);
            colour += c.a * glm::vec3(c);
            alpha += c.a;
        }
        colour /= std::max(alpha, 1e-6F);
        out[0] = encode(colour.r);
        out[1] = encode(colour.g);
        out[2] = encode(colour.b);
        out[3] = std::uint8_t(std::lround(255.0F * 0.25F * alpha));
    }
}

TextureImage halve(const TextureImage& from) {
    TextureImage to;
    to.width = std::max(1, from.width / 2);
    to.height = std::max(1, from.height / 2);
    to.rgba.resize(4 * std::size_t(to.width) * std::size_t(to.height));
    const bool even = from.width % 2 == 0 && from.height % 2 == 0;
    for (int row = 0; row < to.height; ++row) {
        even ? halveEvenRow(from, to, row) : halveRow(from, to, row);
    }
    return to;
}

int wrap(int i, int n, bool repeat) {
    if (!repeat) {
        return std::clamp(i, 0, n - 1);
    }
    const int m = i % n;
    return m < 0 ? m + n : m;
}

}  // namespace

MipTexture::MipTexture(TextureImage image, bool repeat)
    : MipTexture(std::make_shared<const TextureImage>(std::move(image)), repeat) {}

MipTexture::MipTexture(std::shared_ptr<const TextureImage> image, bool repeat) : m_repeat(repeat) {
    if (image == nullptr || image->width <= 0 || image->height <= 0 ||
        image->rgba.size() != 4 * std::size_t(image->width) * std::size_t(image->height)) {
        return;
    }
    m_levels.push_back(std::move(image));
    while (m_levels.back()->width > 1 || m_levels.back()->height > 1) {
        m_levels.push_back(std::make_shared<const TextureImage>(halve(*m_levels.back())));
    }
}

glm::vec4 MipTexture::texel(const TextureImage& level, int x, int y) const {
    const auto column = std::size_t(wrap(x, level.width, m_repeat));
    const auto row = std::size_t(wrap(y, level.height, m_repeat));
    return decode(&level.rgba[4 * (row * std::size_t(level.width) + column)]);
}

glm::vec4 MipTexture::bilinear(std::size_t index, const glm::vec2& uv) const {
    const TextureImage& level = *m_levels[index];
    // Rows run from the top, v runs up. Whole turns are taken off before anything becomes an int.
    const auto fold = [&](float c) {
        return m_repeat ? c - std::floor(c) : std::clamp(c, 0.0F, 1.0F);
    };
    const float x = fold(uv.x) * float(level.width) - 0.5F;
    const float y = (1.0F - fold(uv.y)) * float(level.height) - 0.5F;
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const int i = int(fx);
    const int j = int(fy);
    return glm::mix(glm::mix(texel(level, i, j), texel(level, i + 1, j), x - fx),
                    glm::mix(texel(level, i, j + 1), texel(level, i + 1, j + 1), x - fx), y - fy);
}

glm::vec4 MipTexture::sample(const glm::vec2& uv, const glm::vec2& axisA,
                             const glm::vec2& axisB) const {
    if (empty() || !std::isfinite(uv.x) || !std::isfinite(uv.y)) {
        return glm::vec4(0.0F);
    }
    const glm::vec2 size(m_levels.front()->width, m_levels.front()->height);
    const float lengthA = glm::length(axisA * size);
    const float lengthB = glm::length(axisB * size);
    const float longer = std::max(lengthA, lengthB);
    const glm::vec2& along = lengthA >= lengthB ? axisA : axisB;
    const float top = float(m_levels.size() - 1);
    if (!std::isfinite(longer)) {
        return mean();
    }
    const float shorter = std::max({std::min(lengthA, lengthB), longer / float(kMaxTaps), 1.0F});
    const float lod = std::clamp(std::log2(shorter), 0.0F, top);
    const int taps = std::clamp(int(std::ceil(longer / shorter)), 1, kMaxTaps);
    const auto level = std::size_t(lod);
    const std::size_t next = std::min(level + 1, m_levels.size() - 1);
    const float fraction = lod - float(level);
    glm::vec4 sum{0.0F};
    for (int i = 0; i < taps; ++i) {
        const glm::vec2 at = uv + along * ((float(i) + 0.5F) / float(taps) - 0.5F);
        const glm::vec4 fine = bilinear(level, at);
        sum += fraction > 0.0F ? glm::mix(fine, bilinear(next, at), fraction) : fine;
    }
    return sum / float(taps);
}

glm::vec4 MipTexture::mean() const {
    return empty() ? glm::vec4(0.0F) : decode(m_levels.back()->rgba.data());
}

}  // namespace reflet
