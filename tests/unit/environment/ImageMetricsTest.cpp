// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/ImageMetrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reflet {
namespace {

DisplayImage noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    DisplayImage image{width, height,
                       std::vector<glm::vec3>(std::size_t(width) * std::size_t(height))};
    for (glm::vec3& pixel : image.pixels)
        pixel = {value(random), value(random), value(random)};
    return image;
}

DisplayImage constant(int width, int height, float value) {
    return {width, height,
            std::vector<glm::vec3>(std::size_t(width) * std::size_t(height), glm::vec3(value))};
}

/// The paper's formula as it stands: a full two-dimensional window at every place, the weighted
/// moments about the mean, in double. Rows [top, top + height) only.
double naiveSsim(const DisplayImage& x, const DisplayImage& y, int top, int height,
                 const std::vector<unsigned char>& mask = {}) {
    const auto gray = [](const DisplayImage& image, int column, int row) {
        const glm::vec3& c = image.pixels[std::size_t(row * image.width + column)];
        return 0.299 * double(c.r) + 0.587 * double(c.g) + 0.114 * double(c.b);
    };
    double weights[11][11];
    double total = 0.0;
    for (int j = -5; j <= 5; ++j) {
        for (int i = -5; i <= 5; ++i) {
            total += weights[j + 5][i + 5] = std::exp(-(i * i + j * j) / (2.0 * 1.5 * 1.5));
        }
    }
    double sum = 0.0;
    int count = 0;
    for (int row = top + 5; row < top + height - 5; ++row) {
        for (int column = 5; column < x.width - 5; ++column) {
            if (!mask.empty() && mask[std::size_t(row * x.width + column)] == 0)
                continue;
            double mx = 0, my = 0, vx = 0, vy = 0, cov = 0;
            for (int j = -5; j <= 5; ++j) {
                for (int i = -5; i <= 5; ++i) {
                    const double w = weights[j + 5][i + 5] / total;
                    mx += w * gray(x, column + i, row + j);
                    my += w * gray(y, column + i, row + j);
                }
            }
            for (int j = -5; j <= 5; ++j) {
                for (int i = -5; i <= 5; ++i) {
                    const double w = weights[j + 5][i + 5] / total;
                    const double dx = gray(x, column + i, row + j) - mx;
                    const double dy = gray(y, column + i, row + j) - my;
                    vx += w * dx * dx;
                    vy += w * dy * dy;
                    cov += w * dx * dy;
                }
            }
            sum += (2 * mx * my + 1e-4) * (2 * cov + 9e-4) /
                   ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4));
            ++count;
        }
    }
    return sum / count;
}

TEST(ImageMetrics, EncodesSrgbAtThePublishedValues) {
    // IEC 61966-2-1: the pieces meet at 0.0031308 ↔ 0.04045; mid-grey 18 % is code 118 of 255.
    EXPECT_FLOAT_EQ(srgbFromLinear(0.0f), 0.0f);
    EXPECT_NEAR(srgbFromLinear(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(srgbFromLinear(0.0031308f), 0.04045f, 1e-6f);
    EXPECT_NEAR(srgbFromLinear(0.18f) * 255.0f, 117.65f, 0.05f);
    EXPECT_NEAR(srgbFromLinear(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(linearFromSrgb(0.5f), 0.214041f, 1e-5f);
}

TEST(ImageMetrics, DecodesEveryEightBitCodeThatItEncoded) {
    for (int code = 0; code < 256; ++code) {
        const float encoded = float(code) / 255.0f;
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(encoded)), encoded, 2e-6f);
    }
}

TEST(ImageMetrics, ClipsDisplayValuesAndShowsNanAsBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(toDisplay({-1.0f, 5.0f, nan}, 1.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NEAR(toDisplay({0.25f, 0.1f, 0.0f}, 2.0f).x, srgbFromLinear(0.5f), 1e-7f);
}

TEST(ImageMetrics, StacksTheFacesOfAStripInOrder) {
    CubeMap<glm::vec3> map(2);
    for (int face = 0; face < 6; ++face)
        map.at(face, 1, 0) = glm::vec3(float(face + 1) / 6.0f);
    const DisplayImage strip = displayStrip(map, 1.0f);
    EXPECT_EQ(strip.width, 2);
    EXPECT_EQ(strip.height, 12);
    for (int face = 0; face < 6; ++face) {
        const glm::vec3 pixel = strip.pixels[std::size_t(face * 4 + 1)];
        EXPECT_NEAR(pixel.x, srgbFromLinear(float(face + 1) / 6.0f), 1e-6f);
    }
}

TEST(ImageMetrics, GivesTwentyDecibelsForAConstantErrorOfATenth) {
    PsnrAccumulator psnr;
    psnr.add(constant(4, 3, 0.5f), constant(4, 3, 0.6f));
    ASSERT_TRUE(psnr.decibels());
    EXPECT_NEAR(*psnr.decibels(), 20.0, 1e-5);
}

TEST(ImageMetrics, PoolsSquaredErrorsBeforeTakingTheLogarithm) {
    // Errors 0.1 on 12 pixels and 0.3 on 24: mean square (12·0.01 + 24·0.09) / 36.
    PsnrAccumulator psnr;
    psnr.add(constant(4, 3, 0.5f), constant(4, 3, 0.6f));
    psnr.add(constant(4, 6, 0.2f), constant(4, 6, 0.5f));
    EXPECT_NEAR(*psnr.decibels(), -10.0 * std::log10((0.12 + 2.16) / 36.0), 1e-5);
}

TEST(ImageMetrics, HasNoDecibelsForIdenticalImagesNorForNone) {
    PsnrAccumulator psnr;
    EXPECT_FALSE(psnr.decibels());
    psnr.add(noise(5, 5, 1), noise(5, 5, 1));
    EXPECT_FALSE(psnr.decibels());
    psnr.add(constant(1, 1, 0.0f), constant(1, 1, 1.0f));
    ASSERT_TRUE(psnr.decibels());
    EXPECT_NEAR(*psnr.decibels(), 10.0 * std::log10(26.0), 1e-9);
}

TEST(ImageMetrics, CountsOnlyThePixelsUnderTheMask) {
    DisplayImage image = constant(2, 1, 0.5f);
    image.pixels[1] = glm::vec3(0.0f);
    PsnrAccumulator psnr;
    psnr.add(image, constant(2, 1, 0.6f), std::vector<unsigned char>{1, 0});
    EXPECT_NEAR(*psnr.decibels(), 20.0, 1e-5);
}

TEST(ImageMetrics, PoolsAbsoluteDifferencesOverAllChannels) {
    MeanErrorAccumulator error;
    EXPECT_FALSE(error.mean());
    error.add(noise(4, 4, 3), noise(4, 4, 3));
    ASSERT_TRUE(error.mean());
    EXPECT_EQ(*error.mean(), 0.0);
    // 48 values of 0, then 3 of 0, 0.5, 0 and 0.25; the last pixel is masked away.
    DisplayImage image = constant(3, 1, 0.5f);
    image.pixels[1] = {1.0f, 0.5f, 0.25f};
    image.pixels[2] = {0.0f, 0.0f, 0.0f};
    error.add(image, constant(3, 1, 0.5f), std::vector<unsigned char>{1, 1, 0});
    EXPECT_NEAR(*error.mean(), 0.75 / 54.0, 1e-9);
}

TEST(ImageMetrics, MatchesTheNaiveStructuralSimilarityOnNoise) {
    const DisplayImage a = noise(37, 23, 1);
    DisplayImage b = noise(37, 23, 2);
    EXPECT_NEAR(*ssim(a, b), naiveSsim(a, b, 0, 23), 1e-9);
    for (std::size_t i = 0; i < b.pixels.size(); ++i)
        b.pixels[i] = 0.8f * a.pixels[i] + 0.2f * b.pixels[i];
    const double similar = *ssim(a, b);
    EXPECT_NEAR(similar, naiveSsim(a, b, 0, 23), 1e-9);
    EXPECT_GT(similar, 0.8);
    EXPECT_LT(similar, 1.0);
}

TEST(ImageMetrics, GivesTheLuminanceTermAloneForConstantImages) {
    // Variances and covariance vanish: (2·0.5·0.25 + C1) / (0.25 + 0.0625 + C1).
    EXPECT_NEAR(*ssim(constant(16, 16, 0.5f), constant(16, 16, 0.25f)), 0.2501 / 0.3126, 1e-12);
}

TEST(ImageMetrics, GivesTheStructureTermAloneForAnImageAndItsNegative) {
    // A checkerboard 0.5 ± a and its negative have about the same mean and covariance −variance.
    // The windowed mean of a checkerboard differs from 0.5 by a·(Σ w (−1)^k)², which is below 1e-4.
    DisplayImage x = constant(21, 21, 0.0f);
    DisplayImage y = x;
    for (int row = 0; row < 21; ++row) {
        for (int column = 0; column < 21; ++column) {
            const float a = (row + column) % 2 == 0 ? 0.2f : -0.2f;
            x.pixels[std::size_t(row * 21 + column)] = glm::vec3(0.5f + a);
            y.pixels[std::size_t(row * 21 + column)] = glm::vec3(0.5f - a);
        }
    }
    EXPECT_NEAR(*ssim(x, y), (-0.08 + 9e-4) / (0.08 + 9e-4), 1e-4);
}

TEST(ImageMetrics, IsSymmetricAndWeighsChannelsByRec601) {
    const DisplayImage a = noise(20, 20, 5);
    const DisplayImage b = noise(20, 20, 6);
    EXPECT_DOUBLE_EQ(*ssim(a, b), *ssim(b, a));
    DisplayImage red = constant(11, 11, 0.0f);
    for (glm::vec3& pixel : red.pixels)
        pixel = {1.0f, 0.0f, 0.0f};
    const double m = 0.299;
    EXPECT_NEAR(*ssim(red, constant(11, 11, 1.0f)), (2 * m + 1e-4) / (m * m + 1.0 + 1e-4), 1e-12);
}

TEST(ImageMetrics, LetsNoWindowCrossFromOneFaceOfAStripIntoTheNext) {
    const DisplayImage a = noise(15, 90, 8);
    const DisplayImage b = noise(15, 90, 9);
    double mean = 0.0;
    for (int face = 0; face < 6; ++face)
        mean += naiveSsim(a, b, 15 * face, 15) / 6.0;
    EXPECT_NEAR(*ssim(a, b), mean, 1e-9);
    EXPECT_GT(std::abs(mean - naiveSsim(a, b, 0, 90)), 1e-6);
}

TEST(ImageMetrics, AveragesTheWindowsCentredOnMaskedPixels) {
    const DisplayImage a = noise(30, 20, 3);
    const DisplayImage b = noise(30, 20, 4);
    std::mt19937 random(10);
    std::vector<unsigned char> mask(600);
    for (unsigned char& m : mask)
        m = random() % 3 == 0 ? 255 : 0;
    EXPECT_NEAR(*ssim(a, b, mask), naiveSsim(a, b, 0, 20, mask), 1e-9);
    EXPECT_GT(std::abs(*ssim(a, b, mask) - *ssim(a, b)), 1e-6);
}

TEST(ImageMetrics, HasNoSimilarityWhereThereIsNothingToCompare) {
    EXPECT_FALSE(ssim(noise(10, 30, 1), noise(10, 30, 2)));
    EXPECT_FALSE(ssim(noise(10, 60, 1), noise(10, 60, 2)));
    EXPECT_FALSE(ssim(noise(20, 20, 1), noise(20, 20, 1)));
    EXPECT_FALSE(ssim(noise(20, 20, 1), noise(20, 20, 2), std::vector<unsigned char>(400, 0)));
    EXPECT_TRUE(ssim(noise(11, 11, 1), noise(11, 11, 2)));
}

}  // namespace
}  // namespace reflet
