// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/BodyReflections.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/rendering/Fresnel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

/// A piece of a body's surface in the vehicle's frame.
struct Facet {
    glm::dvec3 middle{0.0};
    glm::dvec3 normal{0.0};  ///< unit, smooth
    double area = 0.0;
    const VehicleMaterial* material = nullptr;
};

/// How much of the light a material mirrors at an angle: what BodyShading blends the map in with.
double mirrored(const VehicleMaterial& material, double cosine) {
    const auto c = float(cosine);
    const double coat = double(material.clearCoat * fresnelSchlick(kDielectricF0, c));
    const double glass = double(material.glass * fresnelSchlick(kGlazingF0, c));
    const glm::vec3 base = material.baseColor;
    const double metal =
        double(material.metallic) * double(fresnelSchlick((base.r + base.g + base.b) / 3.0F, c));
    return std::min(1.0, coat + glass + metal);
}

std::vector<Facet> facetsOf(const Vehicle& vehicle) {
    std::vector<Facet> facets;
    for (const VehicleBody& body : vehicle.bodies) {
        for (std::size_t t = 0; t < body.triangles.size(); ++t) {
            const glm::uvec3 v = body.triangles[t];
            const glm::dvec3 a(body.vertices[v.x]), b(body.vertices[v.y]), c(body.vertices[v.z]);
            const double twice = glm::length(glm::cross(b - a, c - a));
            const glm::dvec3 normal(body.normals[v.x] + body.normals[v.y] + body.normals[v.z]);
            const double length = glm::length(normal);
            if (!(twice > 0.0) || !(length > 0.0))
                continue;
            const glm::dvec3 middle = (a + b + c) / 3.0 + glm::dvec3(body.offset, 0.0, 0.0);
            facets.push_back({middle, normal / length, 0.5 * twice,
                              &vehicle.materials[body.triangleMaterial[t]]});
        }
    }
    return facets;
}

glm::dvec3 eyeAt(double azimuth, double elevation, double distance, double height) {
    return {distance * std::cos(elevation) * std::cos(azimuth),
            distance * std::cos(elevation) * std::sin(azimuth),
            height + distance * std::sin(elevation)};
}

/// Nearest by ratio for distances, by difference for angles.
template <std::size_t N, class Unlike>
std::size_t mostAlike(const std::array<double, N>& values, const Unlike& unlike) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < N; ++i) {
        if (unlike(values[i]) < unlike(values[best]))
            best = i;
    }
    return best;
}

std::vector<double> cumulativeWeights(const std::vector<Facet>& facets, const glm::dvec3& eye) {
    constexpr int n = BodyReflections::kResolution;
    std::vector<double> sums(std::size_t(6 * n * n), 0.0);
    for (const Facet& facet : facets) {
        const glm::dvec3 toEye = eye - facet.middle;
        const double squared = glm::dot(toEye, toEye);
        const double cosine = glm::dot(toEye, facet.normal) / std::sqrt(squared);
        if (!(cosine > 0.0))
            continue;
        const glm::dvec3 out = 2.0 * glm::dot(facet.normal, toEye) * facet.normal - toEye;
        const Texel texel = texelAt(n, out);
        sums[std::size_t((texel.face * n + texel.row) * n + texel.column)] +=
            facet.area * cosine / squared * mirrored(*facet.material, cosine);
    }
    double total = 0.0;
    for (double& sum : sums) {
        total += sum;
        sum = total;
    }
    // A body that mirrors nothing towards this viewer: all directions alike.
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = total > 0.0 ? sums[i] / total : double(i + 1) / double(sums.size());
    sums.back() = 1.0;
    return sums;
}

}  // namespace

BodyReflections::BodyReflections(const Vehicle& vehicle) : m_length(vehicle.length()) {
    for (const VehicleBody& body : vehicle.bodies)
        m_centerHeight += double(body.center.z) / double(vehicle.bodies.size());
    const std::vector<Facet> facets = facetsOf(vehicle);
    m_viewers.resize(std::size_t(kAzimuths) * kElevations.size() * kDistances.size());
    parallelFor(0, std::size_t(kAzimuths), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            const double azimuth = 2.0 * std::numbers::pi * double(a) / kAzimuths;
            for (std::size_t e = 0; e < kElevations.size(); ++e) {
                for (std::size_t d = 0; d < kDistances.size(); ++d) {
                    const double away = kDistances[d] + 0.5 * m_length;
                    m_viewers[slot(a, e, d)] = cumulativeWeights(
                        facets, eyeAt(azimuth, kElevations[e], away, m_centerHeight));
                }
            }
        }
    });
}

std::size_t BodyReflections::slot(std::size_t azimuth, std::size_t elevation,
                                  std::size_t distance) {
    return (azimuth * kElevations.size() + elevation) * kDistances.size() + distance;
}

const BodyReflections::Cumulative& BodyReflections::viewer(const glm::dvec3& eye) const {
    const double up = eye.z - m_centerHeight;
    const double flat = std::hypot(eye.x, eye.y);
    const double turns = std::atan2(eye.y, eye.x) / (2.0 * std::numbers::pi);
    const auto azimuth =
        std::size_t((int(std::lround(turns * double(kAzimuths))) + kAzimuths) % kAzimuths);
    const double elevation = std::atan2(up, flat);
    const double away = std::max(0.1, std::hypot(flat, up) - 0.5 * m_length);
    const std::size_t e = mostAlike(kElevations, [&](double x) { return std::abs(x - elevation); });
    const std::size_t d =
        mostAlike(kDistances, [&](double x) { return std::abs(std::log(x / away)); });
    return m_viewers[slot(azimuth, e, d)];
}

glm::dvec3 BodyReflections::direction(const glm::dvec3& eye, const glm::dvec2& u) const {
    const Cumulative& sums = viewer(eye);
    // The first number chooses the texel; what it leaves and the second, the place in it.
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u.x);
    const auto index = int(found - sums.begin());
    const double before = index > 0 ? sums[std::size_t(index - 1)] : 0.0;
    const double share = *found - before;
    const double rest = share > 0.0 ? std::clamp((u.x - before) / share, 0.0, 1.0) : 0.5;
    constexpr int n = kResolution;
    const int column = index % n, row = index / n % n, face = index / (n * n);
    const glm::dvec2 st{2.0 * (column + rest) / n - 1.0, 2.0 * (row + u.y) / n - 1.0};
    return glm::normalize(faceDirection(face, st));
}

std::vector<double> BodyReflections::weights(const glm::dvec3& eye) const {
    std::vector<double> weights = viewer(eye);
    for (std::size_t i = weights.size() - 1; i > 0; --i)
        weights[i] -= weights[i - 1];
    return weights;
}

}  // namespace reflet
