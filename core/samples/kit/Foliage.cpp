// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Foliage.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

glm::dvec3 onSphere(Random& random) {
    const double z = random.between(-1.0, 1.0);
    const double a = random.between(0.0, 2.0 * kPi);
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {r * std::cos(a), r * std::sin(a), z};
}

void leaf(Mesh& mesh, const glm::dvec3& at, const glm::dvec3& facing, const LeafStyle& style,
          double light, Random& random) {
    glm::dvec3 normal = facing + 0.7 * onSphere(random);
    normal = glm::length(normal) < 1e-3 ? glm::dvec3(0, 0, 1) : glm::normalize(normal);
    glm::dvec3 along = glm::cross(normal, onSphere(random)) - glm::dvec3(0, 0, style.droop);
    along -= glm::dot(along, normal) * normal;
    if (glm::length(along) < 1e-3) {
        along = glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8));
    }
    along = glm::normalize(along);
    const glm::dvec3 across = glm::cross(normal, along);
    const double size = style.size * random.between(0.7, 1.25);
    const int tones = int(style.paints.size());
    const int tone = std::clamp(int(light * tones + random.between(-0.6, 0.6)), 0, tones - 1);
    mesh.polygon({at - 0.5 * size * along, at + 0.36 * size * across, at + 0.5 * size * along,
                  at - 0.36 * size * across},
                 {style.paints[std::size_t(tone)], SurfaceType::Unknown});
}

void clump(Mesh& mesh, const glm::dvec3& center, const glm::dvec3& radii, int count,
           const LeafStyle& style, Random& random) {
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 d = onSphere(random);
        const double r = std::cbrt(random.between(0.25, 1.0));
        const double light = 0.45 + 0.4 * d.z + 0.25 * (r - 0.7);
        leaf(mesh, center + r * d * radii, d + glm::dvec3(0, 0, 0.5), style, light, random);
    }
}

void crown(Mesh& mesh, const glm::dvec3& center, const glm::dvec3& radii, int clumps,
           int leavesEach, double clumpRadius, const LeafStyle& style, Random& random) {
    for (int i = 0; i < clumps; ++i) {
        const glm::dvec3 d = onSphere(random);
        const double r = std::cbrt(random.between(0.3, 1.0));
        const glm::dvec3 at = center + r * d * (radii - 0.6 * clumpRadius);
        const double size = clumpRadius * random.between(0.75, 1.25);
        clump(mesh, at, glm::dvec3(size, size, 0.75 * size), leavesEach, style, random);
    }
}

}  // namespace reflet::kit
