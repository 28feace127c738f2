// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/Flip.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace reflet {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// FLIP once more, straight from the text of the paper: two-dimensional kernels, no separation, and
/// the matrices with four digits as IEC 61966-2-1 and CIE 15 print them.
namespace paper {

const glm::dmat3 kXyzFromRgb(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722,
                             0.9505);
const glm::dvec3 kWhite(0.9505, 1.0, 1.0890);

struct Kernel {
    int radius = 0;
    std::vector<double> weights;
    [[nodiscard]] double at(int x, int y) const {
        return weights[std::size_t((y + radius) * (2 * radius + 1) + x + radius)];
    }
    template <class F>
    Kernel(int radiusInPixels, const F& f) : radius(radiusInPixels) {
        for (int y = -radius; y <= radius; ++y) {
            for (int x = -radius; x <= radius; ++x)
                weights.push_back(f(double(x), double(y)));
        }
    }
    void normalize() {
        double sum = 0.0;
        for (const double w : weights)
            sum += w;
        for (double& w : weights)
            w /= sum;
    }
    void balance() {
        double positive = 0.0, negative = 0.0;
        for (const double w : weights)
            (w > 0.0 ? positive : negative) += w;
        for (double& w : weights)
            w /= w > 0.0 ? positive : -negative;
    }
};

struct Picture {
    int width, height;
    std::vector<glm::dvec3> pixels;
    [[nodiscard]] const glm::dvec3& at(int x, int y) const {
        return pixels[std::size_t(std::clamp(y, 0, height - 1) * width +
                                  std::clamp(x, 0, width - 1))];
    }
};

Picture opponent(const DisplayImage& image) {
    Picture out{image.width, image.height, {}};
    for (const glm::vec3& c : image.pixels) {
        const auto linear = [](double v) {
            return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        };
        const glm::dvec3 xyz =
            kXyzFromRgb * glm::dvec3(linear(c.x), linear(c.y), linear(c.z)) / kWhite;
        out.pixels.push_back(
            {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)});
    }
    return out;
}

Kernel contrast(int channel, double ppd) {
    constexpr double a1[] = {1.0, 1.0, 34.1}, b1[] = {0.0047, 0.0053, 0.04};
    constexpr double a2[] = {0.0, 0.0, 13.5}, b2[] = {1e-5, 1e-5, 0.025};
    const int radius = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * ppd));
    Kernel kernel(radius, [&](double x, double y) {
        const double z = (x * x + y * y) / (ppd * ppd);
        return a1[channel] * std::sqrt(kPi / b1[channel]) * std::exp(-kPi * kPi * z / b1[channel]) +
               a2[channel] * std::sqrt(kPi / b2[channel]) * std::exp(-kPi * kPi * z / b2[channel]);
    });
    kernel.normalize();
    return kernel;
}

glm::dvec3 hunt(const glm::dvec3& linear) {
    const glm::dvec3 c = kXyzFromRgb * linear / kWhite;
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double l = 116.0 * f(c.y) - 16.0;
    return {l, 0.01 * l * 500.0 * (f(c.x) - f(c.y)), 0.01 * l * 200.0 * (f(c.y) - f(c.z))};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

glm::dvec3 seen(const Picture& image, const Kernel* kernels, int x, int y) {
    glm::dvec3 sum(0.0);
    for (int channel = 0; channel < 3; ++channel) {
        const Kernel& k = kernels[channel];
        for (int j = -k.radius; j <= k.radius; ++j) {
            for (int i = -k.radius; i <= k.radius; ++i)
                sum[channel] += k.at(i, j) * image.at(x + i, y + j)[channel];
        }
    }
    const double luminance = (sum.x + 16.0) / 116.0;
    const glm::dvec3 xyz =
        glm::dvec3(sum.y / 500.0 + luminance, luminance, luminance - sum.z / 200.0) * kWhite;
    const glm::dvec3 rgb = glm::inverse(kXyzFromRgb) * xyz;
    return hunt(glm::clamp(rgb, glm::dvec3(0.0), glm::dvec3(1.0)));
}

/// The strength of an edge (order 1) or a point (order 2).
double feature(const Picture& image, const Kernel& along, int x, int y) {
    double dx = 0.0, dy = 0.0;
    for (int j = -along.radius; j <= along.radius; ++j) {
        for (int i = -along.radius; i <= along.radius; ++i) {
            const double value = (image.at(x + i, y + j).x + 16.0) / 116.0;
            dx += along.at(i, j) * value;
            dy += along.at(j, i) * value;
        }
    }
    return std::sqrt(dx * dx + dy * dy);
}

std::vector<double> flip(const DisplayImage& test, const DisplayImage& reference, double ppd) {
    const Picture a = opponent(test), b = opponent(reference);
    const Kernel csf[] = {contrast(0, ppd), contrast(1, ppd), contrast(2, ppd)};
    const double sigma = 0.5 * 0.082 * ppd;
    const auto gauss = [sigma](double x, double y) {
        return std::exp(-(x * x + y * y) / (2.0 * sigma * sigma));
    };
    const int radius = int(std::ceil(3.0 * sigma));
    Kernel edge(radius, [&](double x, double y) { return -x * gauss(x, y); });
    Kernel point(radius,
                 [&](double x, double y) { return (x * x / (sigma * sigma) - 1.0) * gauss(x, y); });
    edge.balance();
    point.balance();
    const double cmax = std::pow(hyab(hunt({0, 1, 0}), hunt({0, 0, 1})), 0.7);
    std::vector<double> out;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double d = std::pow(hyab(seen(a, csf, x, y), seen(b, csf, x, y)), 0.7);
            const double color = d < 0.4 * cmax
                                     ? 0.95 / (0.4 * cmax) * d
                                     : 0.95 + (d - 0.4 * cmax) / (cmax - 0.4 * cmax) * 0.05;
            const double features =
                std::max(std::abs(feature(a, edge, x, y) - feature(b, edge, x, y)),
                         std::abs(feature(a, point, x, y) - feature(b, point, x, y)));
            out.push_back(std::pow(color, 1.0 - std::sqrt(features / std::sqrt(2.0))));
        }
    }
    return out;
}

}  // namespace paper

DisplayImage patches(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    DisplayImage image{width, height, {}};
    std::vector<glm::vec3> colors;
    for (int i = 0; i < 12; ++i)
        colors.emplace_back(value(random), value(random), value(random));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3& patch = colors[std::size_t((x / 5 + 3 * (y / 7)) % 12)];
            image.pixels.push_back(glm::clamp(patch + 0.1f * (value(random) - 0.5f), 0.0f, 1.0f));
        }
    }
    return image;
}

DisplayImage constant(int width, int height, const glm::vec3& color) {
    return {width, height, std::vector<glm::vec3>(std::size_t(width) * std::size_t(height), color)};
}

double meanOf(const std::vector<float>& errors) {
    FlipAccumulator pool;
    pool.add(errors);
    return pool.mean().value_or(-1.0);
}

TEST(Flip, AgreesWithThePapersTwoDimensionalKernelsPixelByPixel) {
    const DisplayImage a = patches(37, 29, 1);
    const DisplayImage b = patches(37, 29, 2);
    for (const double ppd : {kFlipPixelsPerDegree, 20.0, 5.0}) {
        const auto ours = flipMap(a, b, ppd);
        const auto theirs = paper::flip(a, b, ppd);
        ASSERT_EQ(ours.size(), theirs.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < ours.size(); ++i) {
            EXPECT_NEAR(double(ours[i]), theirs[i], 2e-3) << "pixel " << i << " at " << ppd;
            sum += theirs[i];
        }
        EXPECT_GT(sum / double(theirs.size()), 0.1);
    }
}

TEST(Flip, IsNothingForIdenticalPicturesAndOneForGreenAgainstBlue) {
    const DisplayImage a = patches(20, 20, 3);
    EXPECT_EQ(meanOf(flipMap(a, a, kFlipPixelsPerDegree)), 0.0);
    // The paper scales by the largest distance of all display colours, that of green and blue.
    const auto greenBlue =
        flipMap(constant(9, 9, {0, 1, 0}), constant(9, 9, {0, 0, 1}), kFlipPixelsPerDegree);
    EXPECT_NEAR(meanOf(greenBlue), 1.0, 1e-6);
}

TEST(Flip, FollowsTheFormulaForUniformGreys) {
    // Without edges only lightness counts: HyAB = ΔL. The green primary has L 87.7347, a −86.1827,
    // b 83.1793, the blue one 32.2970, 79.1875, −107.8602 (tables of CIELAB for sRGB under D65).
    const double da = 0.877347 * -86.1827 - 0.322970 * 79.1875;
    const double db = 0.877347 * 83.1793 - 0.322970 * -107.8602;
    const double largest = std::pow(87.7347 - 32.2970 + std::hypot(da, db), 0.7);
    const double knee = 0.4 * largest;
    const double black = std::pow(100.0, 0.7);
    EXPECT_NEAR(meanOf(flipMap(constant(8, 8, glm::vec3(0.0f)), constant(8, 8, glm::vec3(1.0f)),
                               kFlipPixelsPerDegree)),
                0.95 + 0.05 * (black - knee) / (largest - knee), 1e-5);
    // sRGB code 119 of 255 is L = 50.034, code 128 is 53.585.
    EXPECT_NEAR(meanOf(flipMap(constant(8, 8, glm::vec3(119.0f / 255.0f)),
                               constant(8, 8, glm::vec3(128.0f / 255.0f)), kFlipPixelsPerDegree)),
                0.95 / knee * std::pow(53.585 - 50.034, 0.7), 2e-4);
}

TEST(Flip, ForgivesFineNoiseTheMoreTheFartherTheObserver) {
    DisplayImage checks = constant(40, 40, glm::vec3(0.4f));
    for (std::size_t i = 0; i < checks.pixels.size(); ++i) {
        if ((i % 40 + i / 40) % 2 == 0)
            checks.pixels[i] = glm::vec3(0.6f);
    }
    const DisplayImage grey = constant(40, 40, glm::vec3(0.51f));
    const double near = meanOf(flipMap(checks, grey, 10.0));
    const double far = meanOf(flipMap(checks, grey, 60.0));
    EXPECT_LT(far, 0.25 * near);
}

TEST(Flip, StaysANumberOnTheCoarsestFaces) {
    for (const int resolution : {1, 8, 32, 128}) {
        const auto errors =
            flipMap(patches(resolution, 6 * resolution, 4), patches(resolution, 6 * resolution, 5),
                    facePixelsPerDegree(resolution));
        ASSERT_EQ(errors.size(), std::size_t(6 * resolution * resolution));
        for (const float error : errors) {
            ASSERT_GE(error, 0.0f);
            ASSERT_LE(error, 1.0f);
        }
        EXPECT_GT(meanOf(errors), 0.05);
    }
}

TEST(Flip, OfACoarseFaceIsTheLimitOfThePapersKernels) {
    // Far below a pixel the contrast filter is the pixel alone and the detectors are differences of
    // neighbours. At 3.2 pixels a degree the paper's kernels, still numbers, are there already.
    const DisplayImage a = patches(9, 9, 6);
    const DisplayImage b = patches(9, 9, 7);
    const auto limit = paper::flip(a, b, 3.2);
    for (const double ppd : {1.4, 0.5, 0.1}) {
        const auto coarse = flipMap(a, b, ppd);
        for (std::size_t i = 0; i < coarse.size(); ++i)
            EXPECT_NEAR(double(coarse[i]), limit[i], 2e-3) << "pixel " << i << " at " << ppd;
    }
}

TEST(Flip, LetsNoWindowCrossFromOneFaceOfAStripIntoTheNext) {
    const int n = 16;
    DisplayImage strip = patches(n, 6 * n, 8);
    const DisplayImage reference = patches(n, 6 * n, 9);
    const auto before = flipMap(strip, reference, 20.0);
    for (int i = 0; i < n * n; ++i)
        strip.pixels[std::size_t(2 * n * n + i)] = glm::vec3(0.0f, 1.0f, 0.0f);
    const auto after = flipMap(strip, reference, 20.0);
    int changed = 0;
    for (int i = 0; i < 6 * n * n; ++i) {
        if (i / (n * n) == 2)
            changed += before[std::size_t(i)] != after[std::size_t(i)];
        else
            ASSERT_EQ(before[std::size_t(i)], after[std::size_t(i)]) << "face " << i / (n * n);
    }
    EXPECT_GT(changed, n * n / 2);
}

TEST(Flip, PoolsThePixelsUnderTheMask) {
    FlipAccumulator pool;
    EXPECT_FALSE(pool.mean());
    pool.add(std::vector<float>{0.2f, 0.9f, 0.4f}, std::vector<unsigned char>{1, 0, 1});
    ASSERT_TRUE(pool.mean());
    EXPECT_NEAR(*pool.mean(), 0.3, 1e-7);
    pool.add(std::vector<float>{0.6f});
    EXPECT_NEAR(*pool.mean(), 0.4, 1e-7);
}

TEST(Flip, DrawsGrowingErrorsInGrowingLuminance) {
    double last = -1.0;
    for (int i = 0; i <= 100; ++i) {
        const glm::vec3 c = heatColor(float(i) / 100.0f);
        const double luminance = 0.2126 * double(linearFromSrgb(c.x)) +
                                 0.7152 * double(linearFromSrgb(c.y)) +
                                 0.0722 * double(linearFromSrgb(c.z));
        EXPECT_GT(luminance, last);
        last = luminance;
    }
    const DisplayImage picture = heatImage(std::vector<float>{0.0f, 0.5f, 1.0f, 2.0f}, 2);
    EXPECT_EQ(picture.width, 2);
    EXPECT_EQ(picture.height, 2);
    EXPECT_EQ(picture.pixels[2], picture.pixels[3]);
}

}  // namespace
}  // namespace reflet
