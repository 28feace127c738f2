// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/Flip.h"

#include "core/environment/FlipFilters.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace reflet {

namespace {

// The constants of the paper's table 1 and section 4.
constexpr double kColorExponent = 0.7;    // q_c
constexpr double kFeatureExponent = 0.5;  // q_f
constexpr double kColorKnee = 0.4;        // p_c, of the largest distance
constexpr double kErrorKnee = 0.95;       // p_t

/// XYZ from linear Rec. 709 under D65, to the digits that the authors publish results with.
const glm::dmat3& xyzFromRgb() {
    static const glm::dmat3 matrix(
        10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0,  // red
        8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0,   // green
        4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0);  // blue
    return matrix;
}

const glm::dvec3& whitePoint() {
    static const glm::dvec3 white = xyzFromRgb() * glm::dvec3(1.0);
    return white;
}

/// The linear opponent space that is filtered: 116 Y − 16, 500 (X − Y), 200 (Y − Z), relative to
/// white.
glm::dvec3 opponentFromRgb(const glm::dvec3& linear) {
    const glm::dvec3 c = xyzFromRgb() * linear / whitePoint();
    return {116.0 * c.y - 16.0, 500.0 * (c.x - c.y), 200.0 * (c.y - c.z)};
}

glm::dvec3 rgbFromOpponent(const glm::dvec3& opponent) {
    static const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb());
    const double y = (opponent.x + 16.0) / 116.0;
    return rgbFromXyz *
           (glm::dvec3(y + opponent.y / 500.0, y, y - opponent.z / 200.0) * whitePoint());
}

/// CIELAB with a and b scaled by 0.01 L: chroma counts less in the dark (Hunt).
glm::dvec3 huntLab(const glm::dvec3& linear) {
    const auto curve = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const glm::dvec3 c = xyzFromRgb() * linear / whitePoint();
    const double fy = curve(c.y);
    const double lightness = 116.0 * fy - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (curve(c.x) - fy),
            0.01 * lightness * 200.0 * (fy - curve(c.z))};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

double colorError(const glm::dvec3& opponentA, const glm::dvec3& opponentB) {
    static const double largest =
        std::pow(hyab(huntLab({0.0, 1.0, 0.0}), huntLab({0.0, 0.0, 1.0})), kColorExponent);
    constexpr glm::dvec3 black(0.0);
    constexpr glm::dvec3 white(1.0);
    const auto lab = [&](const glm::dvec3& opponent) {
        return huntLab(glm::clamp(rgbFromOpponent(opponent), black, white));
    };
    const double distance = std::pow(hyab(lab(opponentA), lab(opponentB)), kColorExponent);
    const double knee = kColorKnee * largest;
    if (distance < knee)
        return kErrorKnee / knee * distance;
    return kErrorKnee + (distance - knee) / (largest - knee) * (1.0 - kErrorKnee);
}

/// One picture (or one face of a strip) with all that is filtered from it.
struct FilteredPicture {
    std::vector<glm::dvec3> color;  ///< opponent, as the eye resolves it
    std::vector<double> edges, points;
};

FilteredPicture filtered(std::span<const glm::vec3> pixels, int width, const FlipFilters& filters) {
    std::vector<glm::dvec3> opponent;
    std::vector<double> lightness;
    opponent.reserve(pixels.size());
    lightness.reserve(pixels.size());
    for (const glm::vec3& pixel : pixels) {
        opponent.push_back(opponentFromRgb(
            {linearFromSrgb(pixel.x), linearFromSrgb(pixel.y), linearFromSrgb(pixel.z)}));
        lightness.push_back((opponent.back().x + 16.0) / 116.0);
    }
    return {filters.contrast(opponent, width), filters.edges(lightness, width),
            filters.points(lightness, width)};
}

void compare(const FilteredPicture& a, const FilteredPicture& b, std::vector<float>& out) {
    for (std::size_t i = 0; i < a.color.size(); ++i) {
        const double feature =
            std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        const double featureError = std::pow(feature / std::sqrt(2.0), kFeatureExponent);
        const double error = std::pow(colorError(a.color[i], b.color[i]), 1.0 - featureError);
        out.push_back(float(std::clamp(error, 0.0, 1.0)));
    }
}

}  // namespace

std::vector<float> flipMap(const DisplayImage& image, const DisplayImage& reference,
                           double pixelsPerDegree) {
    assert(image.width == reference.width && image.height == reference.height);
    assert(image.pixels.size() == reference.pixels.size());
    const FlipFilters filters(pixelsPerDegree);
    const int tileHeight = image.height == 6 * image.width ? image.width : image.height;
    const std::size_t tile = std::size_t(image.width) * std::size_t(tileHeight);
    std::vector<float> errors;
    errors.reserve(image.pixels.size());
    for (std::size_t first = 0; first < image.pixels.size(); first += tile) {
        const auto pixels = [&](const DisplayImage& whole) {
            return filtered(std::span(whole.pixels).subspan(first, tile), whole.width, filters);
        };
        compare(pixels(image), pixels(reference), errors);
    }
    return errors;
}

void FlipAccumulator::add(std::span<const float> errors, std::span<const unsigned char> mask) {
    assert(mask.empty() || mask.size() == errors.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (!mask.empty() && mask[i] == 0)
            continue;
        m_sum += double(errors[i]);
        ++m_pixels;
    }
}

std::optional<double> FlipAccumulator::mean() const {
    if (m_pixels == 0)
        return std::nullopt;
    return m_sum / double(m_pixels);
}

glm::vec3 heatColor(float error) {
    constexpr std::array<glm::vec3, 5> kStops{glm::vec3{0.0f, 0.0f, 0.02f},
                                              {0.38f, 0.06f, 0.48f},
                                              {0.86f, 0.30f, 0.25f},
                                              {0.99f, 0.72f, 0.20f},
                                              {1.0f, 1.0f, 0.92f}};
    const float at = std::clamp(error, 0.0f, 1.0f) * float(kStops.size() - 1);
    const auto below = std::min(std::size_t(at), kStops.size() - 2);
    return glm::mix(kStops[below], kStops[below + 1], at - float(below));
}

DisplayImage heatImage(std::span<const float> errors, int width) {
    assert(width > 0 && errors.size() % std::size_t(width) == 0);
    DisplayImage image{width, int(errors.size() / std::size_t(width)), {}};
    image.pixels.reserve(errors.size());
    for (const float error : errors)
        image.pixels.push_back(heatColor(error));
    return image;
}

}  // namespace reflet
