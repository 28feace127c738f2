// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/ImageMetrics.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace reflet {

namespace {

constexpr int kWindow = 11;
constexpr int kRadius = kWindow / 2;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 · L)² with L = 1
constexpr double kC2 = 0.03 * 0.03;

/// The window is a product of two of these, whose entries add up to 1.
std::array<double, kWindow> gaussian() {
    std::array<double, kWindow> weights{};
    double sum = 0.0;
    for (int k = 0; k < kWindow; ++k) {
        const double x = (k - kRadius) / kSigma;
        sum += weights[std::size_t(k)] = std::exp(-0.5 * x * x);
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

double luma(const glm::vec3& c) {
    return 0.299 * double(c.x) + 0.587 * double(c.y) + 0.114 * double(c.z);
}

/// First and second moments of the two images under the window: x, y, xx, yy, xy.
using Moments = std::array<double, 5>;

double similarity(const Moments& m) {
    const double varianceX = m[2] - m[0] * m[0];
    const double varianceY = m[3] - m[1] * m[1];
    const double covariance = m[4] - m[0] * m[1];
    return (2.0 * m[0] * m[1] + kC1) * (2.0 * covariance + kC2) /
           ((m[0] * m[0] + m[1] * m[1] + kC1) * (varianceX + varianceY + kC2));
}

struct Sum {
    double value = 0.0;
    std::size_t windows = 0;
};

/// Adds up the similarity of the windows inside the rows [top, top + size of a tile).
class TileSimilarity {
public:
    TileSimilarity(const DisplayImage& image, const DisplayImage& reference, int tileHeight)
        : m_image(image), m_reference(reference), m_tileHeight(tileHeight) {}

    void addTile(int top, std::span<const unsigned char> mask, Sum& sum) const {
        const int columns = m_image.width - kWindow + 1;
        const std::vector<Moments> rows = horizontalMoments(top, columns);
        for (int y = 0; y + kWindow <= m_tileHeight; ++y) {
            for (int x = 0; x < columns; ++x) {
                const std::size_t center =
                    std::size_t(top + y + kRadius) * std::size_t(m_image.width) +
                    std::size_t(x + kRadius);
                if (!mask.empty() && mask[center] == 0)
                    continue;
                Moments m{};
                for (int k = 0; k < kWindow; ++k) {
                    const Moments& row =
                        rows[std::size_t(y + k) * std::size_t(columns) + std::size_t(x)];
                    for (std::size_t i = 0; i < m.size(); ++i)
                        m[i] += m_weights[std::size_t(k)] * row[i];
                }
                sum.value += similarity(m);
                ++sum.windows;
            }
        }
    }

private:
    [[nodiscard]] std::vector<Moments> horizontalMoments(int top, int columns) const {
        std::vector<Moments> result(std::size_t(m_tileHeight) * std::size_t(columns));
        std::vector<Moments> line(std::size_t(m_image.width));
        for (int y = 0; y < m_tileHeight; ++y) {
            const std::size_t start = std::size_t(top + y) * line.size();
            for (std::size_t x = 0; x < line.size(); ++x) {
                const double a = luma(m_image.pixels[start + x]);
                const double b = luma(m_reference.pixels[start + x]);
                line[x] = {a, b, a * a, b * b, a * b};
            }
            for (int x = 0; x < columns; ++x) {
                Moments& m = result[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
                for (int k = 0; k < kWindow; ++k) {
                    const Moments& pixel = line[std::size_t(x + k)];
                    for (std::size_t i = 0; i < m.size(); ++i)
                        m[i] += m_weights[std::size_t(k)] * pixel[i];
                }
            }
        }
        return result;
    }

    const DisplayImage& m_image;
    const DisplayImage& m_reference;
    int m_tileHeight;
    std::array<double, kWindow> m_weights = gaussian();
};

}  // namespace

std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference) {
    return ssim(image, reference, {});
}

std::optional<double> ssim(const DisplayImage& image, const DisplayImage& reference,
                           std::span<const unsigned char> mask) {
    assert(image.width == reference.width && image.height == reference.height);
    assert(image.pixels.size() == reference.pixels.size());
    assert(mask.empty() || mask.size() == image.pixels.size());
    const bool strip = image.height == 6 * image.width;
    const int tileHeight = strip ? image.width : image.height;
    if (image.width < kWindow || tileHeight < kWindow)
        return std::nullopt;
    if (image.pixels == reference.pixels)
        return std::nullopt;
    const TileSimilarity tiles(image, reference, tileHeight);
    Sum sum;
    for (int top = 0; top < image.height; top += tileHeight)
        tiles.addTile(top, mask, sum);
    if (sum.windows == 0)
        return std::nullopt;
    return sum.value / double(sum.windows);
}

}  // namespace reflet
