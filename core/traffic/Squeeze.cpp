// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Squeeze.h"

#include "core/math/Geometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr int kSides = 8;
constexpr double kRise = 0.2;  // tangent of the angle from which bodies are looked down upon
constexpr std::size_t kMostTriangles = std::size_t(1) << 15;

/// Areas by squeeze, in bins that grow by a factor, so that a median costs no sorting.
class Areas {
public:
    void add(double squeeze, double area) {
        const double step = std::log2(std::max(squeeze, kLeast) / kLeast) * kBinsPerOctave;
        const auto bin = std::min(std::size_t(step), m_bins.size() - 1);
        m_bins[bin].area += area;
        m_bins[bin].sum += area * squeeze;
        m_area += area;
    }
    /// The mean of the bin that holds the median.
    [[nodiscard]] double median() const {
        double below = 0.0;
        for (const Bin& bin : m_bins) {
            below += bin.area;
            if (bin.area > 0.0 && 2.0 * below >= m_area)
                return bin.sum / bin.area;
        }
        return 0.0;
    }

private:
    struct Bin {
        double area = 0.0, sum = 0.0;
    };
    static constexpr double kLeast = 1e-3;
    static constexpr double kBinsPerOctave = 32.0;
    std::array<Bin, 640> m_bins{};
    double m_area = 0.0;
};

/// Steradians of the triangle between three unit vectors (van Oosterom and Strackee 1983).
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    const double sum = 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
    return 2.0 * std::atan2(volume, sum);
}

bool reflects(const Vehicle& vehicle, const VehicleBody& body, std::size_t triangle) {
    const std::size_t material =
        triangle < body.triangleMaterial.size() ? body.triangleMaterial[triangle] : 0;
    if (material >= vehicle.materials.size())
        return false;
    const VehicleMaterial& m = vehicle.materials[material];
    return m.clearCoat > 0.0F || m.metallic > 0.0F || m.glass > 0.0F;
}

/// What a triangle adds, looked at along `view` (unit).
void addTriangle(const VehicleBody& body, const glm::uvec3& corners, const glm::dvec3& view,
                 double texelsPerRadian, Areas& areas) {
    std::array<glm::dvec3, 3> p, mirrored;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 normal(body.normals[corners[k]]);
        if (glm::dot(normal, view) >= 0.0)
            return;  // turns away
        p[std::size_t(k)] = glm::dvec3(body.vertices[corners[k]]);
        mirrored[std::size_t(k)] = glm::reflect(view, glm::normalize(normal));
    }
    const double seen = -0.5 * glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), view);
    if (seen <= 0.0)
        return;
    const double angle = solidAngle(mirrored[0], mirrored[1], mirrored[2]);
    areas.add(texelsPerRadian * std::sqrt(angle / seen), seen);
}

}  // namespace

double squeezeOf(const Vehicle& vehicle, const VehicleBody& body) {
    Box bounds;
    for (const glm::vec3& v : body.vertices)
        bounds.add(glm::dvec3(v));
    const glm::dvec3 size = bounds.size();
    // Texels of a map with one texel an edge, along a radian, times metres that are one pixel.
    const double scale = std::sqrt(6.0 / (4.0 * kPi)) * std::max({size.x, size.y, size.z});
    const std::size_t step = 1 + body.triangles.size() / kMostTriangles;
    Areas areas;
    for (int side = 0; side < kSides; ++side) {
        const double angle = 2.0 * kPi * side / kSides;
        const glm::dvec3 view =
            glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), -kRise));
        for (std::size_t t = 0; t < body.triangles.size(); t += step) {
            const glm::uvec3& corners = body.triangles[t];
            const bool sound = std::max({corners.x, corners.y, corners.z}) <
                               std::min(body.vertices.size(), body.normals.size());
            if (sound && reflects(vehicle, body, t))
                addTriangle(body, corners, view, scale, areas);
        }
    }
    return areas.median();
}

}  // namespace reflet
