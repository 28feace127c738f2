// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/FlipFilters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

constexpr double kPi = std::numbers::pi;

/// a √(π/b) exp(−π² z/b), z the squared distance in degrees (paper, table 1).
struct ContrastGaussian {
    double a, b;
};
constexpr std::array<std::array<ContrastGaussian, 2>, 3> kContrast{
    {{{{1.0, 0.0047}, {0.0, 1e-5}}},     // achromatic
     {{{1.0, 0.0053}, {0.0, 1e-5}}},     // red-green
     {{{34.1, 0.04}, {13.5, 0.025}}}}};  // blue-yellow
constexpr double kWidest = 0.04;
constexpr double kFeatureWidth = 0.082;  // degrees, of what an edge detector of the eye spans

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values)
        total += value;
    return total;
}

/// exp(−x²·falloff) for x = −radius..radius.
std::vector<double> bell(int radius, double falloff) {
    std::vector<double> kernel;
    for (int x = -radius; x <= radius; ++x)
        kernel.push_back(std::exp(-double(x) * double(x) * falloff));
    return kernel;
}

/// Scales so that positive entries add up to 1 and negative ones to −1.
std::vector<double> balanced(std::vector<double> kernel) {
    double positive = 0.0, negative = 0.0;
    for (const double value : kernel)
        (value > 0.0 ? positive : negative) += value;
    for (double& value : kernel)
        value /= value > 0.0 ? positive : -negative;
    return kernel;
}

/// The derivatives of a Gaussian. On coarse pictures sigma is far below a pixel, where the bell at
/// the neighbour is too small for a number: positive and negative entries are balanced apart from
/// each other, so that each may have its own scale, which is 1 at the neighbour for those there.
std::vector<double> derivative(int order, int radius, double sigma) {
    const double falloff = 0.5 / (sigma * sigma);
    std::vector<double> kernel;
    for (int x = -radius; x <= radius; ++x) {
        const double squared = double(x) * double(x);
        const double atNeighbour = std::exp(-(squared - 1.0) * falloff);
        if (order == 1)
            kernel.push_back(x == 0 ? 0.0 : -double(x) * atNeighbour);
        else if (sigma >= 1.0 || x != 0)
            kernel.push_back((squared / (sigma * sigma) - 1.0) * atNeighbour);
        else
            kernel.push_back(-1.0);
    }
    return balanced(std::move(kernel));
}

}  // namespace

FlipFilters::FlipFilters(double pixelsPerDegree) {
    const int radius =
        int(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixelsPerDegree));
    for (std::size_t channel = 0; channel < kContrast.size(); ++channel) {
        double total = 0.0;
        for (const ContrastGaussian& g : kContrast[channel]) {
            if (g.a == 0.0)
                continue;
            Kernel kernel = bell(radius, kPi * kPi / (g.b * pixelsPerDegree * pixelsPerDegree));
            const double mass = sum(kernel);
            for (double& value : kernel)
                value /= mass;
            const double weight = g.a * std::sqrt(kPi / g.b) * mass * mass;
            m_contrast[channel].push_back({weight, std::move(kernel)});
            total += weight;
        }
        for (Gaussian& gaussian : m_contrast[channel])
            gaussian.weight /= total;
    }
    const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
    const int featureRadius = int(std::ceil(3.0 * sigma));
    m_smooth = bell(featureRadius, 0.5 / (sigma * sigma));
    const double mass = sum(m_smooth);
    for (double& value : m_smooth)
        value /= mass;
    m_edge = derivative(1, featureRadius, sigma);
    m_point = derivative(2, featureRadius, sigma);
}

template <class T>
std::vector<T> FlipFilters::convolve(std::span<const T> in, int width, const Kernel& alongRows,
                                     const Kernel& alongColumns) {
    const int height = int(in.size()) / width;
    const auto at = [width](int x, int y) {
        return std::size_t(y) * std::size_t(width) + std::size_t(x);
    };
    std::vector<T> rows(in.size()), out(in.size());
    const int rowRadius = int(alongRows.size() / 2);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            T value{};
            for (int k = -rowRadius; k <= rowRadius; ++k)
                value += alongRows[std::size_t(k + rowRadius)] *
                         in[at(std::clamp(x + k, 0, width - 1), y)];
            rows[at(x, y)] = value;
        }
    }
    const int columnRadius = int(alongColumns.size() / 2);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            T value{};
            for (int k = -columnRadius; k <= columnRadius; ++k)
                value += alongColumns[std::size_t(k + columnRadius)] *
                         rows[at(x, std::clamp(y + k, 0, height - 1))];
            out[at(x, y)] = value;
        }
    }
    return out;
}

std::vector<glm::dvec3> FlipFilters::contrast(std::span<const glm::dvec3> opponent,
                                              int width) const {
    std::vector<glm::dvec3> out(opponent.size(), glm::dvec3(0.0));
    std::vector<double> channelIn(opponent.size());
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < opponent.size(); ++i)
            channelIn[i] = opponent[i][channel];
        for (const Gaussian& gaussian : m_contrast[std::size_t(channel)]) {
            const std::vector<double> blurred =
                convolve<double>(channelIn, width, gaussian.kernel, gaussian.kernel);
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i][channel] += gaussian.weight * blurred[i];
        }
    }
    return out;
}

std::vector<double> FlipFilters::strength(std::span<const double> lightness, int width,
                                          const Kernel& derivative) const {
    std::vector<double> across = convolve<double>(lightness, width, derivative, m_smooth);
    const std::vector<double> down = convolve<double>(lightness, width, m_smooth, derivative);
    for (std::size_t i = 0; i < across.size(); ++i)
        across[i] = std::hypot(across[i], down[i]);
    return across;
}

std::vector<double> FlipFilters::edges(std::span<const double> lightness, int width) const {
    return strength(lightness, width, m_edge);
}

std::vector<double> FlipFilters::points(std::span<const double> lightness, int width) const {
    return strength(lightness, width, m_point);
}

}  // namespace reflet
