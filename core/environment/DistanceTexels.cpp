// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistanceTexels.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

using namespace distance_forms;

namespace {

constexpr std::size_t kTexels = 16;
constexpr float kSky = 1e30f;  // metres, stands for infinity where differences are taken
constexpr float kRightMetres = 0.02f;
constexpr float kRightPart = 2e-4f;
constexpr float kRightAtMost = 0.5f * DistanceTexels::kMostError;

float xOf(std::size_t texel) {
    return float(texel % 4) - 1.5f;
}
float yOf(std::size_t texel) {
    return float(texel / 4) - 1.5f;
}

}  // namespace

DistanceTexels::DistanceTexels(const TexelFloats& lengths, const TexelFloats& distances)
    : m_lengths(lengths) {
    for (std::size_t i = 0; i < kTexels; ++i) {
        const bool sky = !(distances[i] > 0.0f) || !(distances[i] < kSky);
        m_distances[i] = sky ? kSky : distances[i];
        m_inverse[i] = sky ? 0.0f : lengths[i] / distances[i];
    }
}

bool DistanceTexels::isSky() const {
    return std::all_of(m_inverse.begin(), m_inverse.end(), [](float u) { return u == 0.0f; });
}

float DistanceTexels::errorOf(std::size_t texel, float inverse) const {
    const float distance = inverse > 0.0f ? m_lengths[texel] / inverse : kSky;
    return std::min(std::abs(distance - m_distances[texel]), kMostError);
}

float DistanceTexels::tolerance(std::size_t texel) const {
    if (m_inverse[texel] == 0.0f)
        return 0.0f;
    return std::min(kRightMetres + kRightPart * m_distances[texel], kRightAtMost);
}

TexelFloats DistanceTexels::errors(const Plane& plane, int columns, int rows) const {
    TexelFloats out;
    const auto dx = float(4 * columns);
    const auto dy = float(4 * rows);
    for (std::size_t i = 0; i < kTexels; ++i)
        out[i] = errorOf(i, plane.at(xOf(i) - dx, yOf(i) - dy));
    return out;
}

TexelFloats DistanceTexels::errorsOfSky() const {
    TexelFloats out;
    for (std::size_t i = 0; i < kTexels; ++i)
        out[i] = errorOf(i, 0.0f);
    return out;
}

bool DistanceTexels::areRight(const TexelFloats& errors) const {
    for (std::size_t i = 0; i < kTexels; ++i) {
        if (!(errors[i] <= tolerance(i)))
            return false;
    }
    return true;
}

bool DistanceTexels::areRight(const Plane& plane, int columns, int rows) const {
    const float error = errorOf(0, plane.at(xOf(0) - float(4 * columns), yOf(0) - float(4 * rows)));
    return error <= tolerance(0) && areRight(errors(plane, columns, rows));
}

/// Of the error in metres: a change of 1/z by e moves the distance by length · z² · e.
Plane DistanceTexels::fit() const {
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (std::size_t i = 0; i < kTexels; ++i) {
        if (m_inverse[i] == 0.0f)
            continue;
        const double z = 1.0 / double(m_inverse[i]);
        const double slope = double(m_lengths[i]) * z * z;
        const glm::dvec3 row(1.0, double(xOf(i)), double(yOf(i)));
        normal += slope * slope * glm::outerProduct(row, row);
        right += slope * slope * double(m_inverse[i]) * row;
    }
    const double determinant = glm::determinant(normal);
    if (!(std::abs(determinant) > 1e-9 * normal[0][0] * normal[1][1] * normal[2][2]))
        return {};
    const glm::dvec3 c = glm::inverse(normal) * right;
    if (!(c.x > 0.0) || !std::isfinite(c.y) || !std::isfinite(c.z))
        return {};
    return {float(c.x), float(c.y / c.x), float(c.z / c.x)};
}

std::uint64_t DistanceTexels::listedRow(std::size_t row) const {
    std::uint64_t entry = 0;
    for (std::size_t x = 0; x < 4; ++x)
        entry |= smallFloat(m_inverse[4 * row + x], kListedMantissa) << (16U * unsigned(x));
    return entry;
}

}  // namespace reflet
