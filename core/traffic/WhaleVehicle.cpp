// SPDX-License-Identifier: GPL-3.0-or-later
// The flying whale of Meyer and Loscos 2003, figure 10: a mirror that keeps off the ground.
#include "core/math/Geometry.h"
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace reflet {
namespace {

enum Material : std::uint16_t { kChrome, kEye };

constexpr float kHalfLength = 7.0F;
constexpr float kMiddle = 2.6F;  // height of the middle line
constexpr float kCut = 2.4F;     // x of the planes between the three bodies: +- this
constexpr int kAround = 72;

/// The whale across: half axes and the height of its middle line at x.
struct Section {
    float x, height, width, lift;
};
constexpr std::array<Section, 10> kSections{{{-7.0F, 0.10F, 0.16F, 0.95F},
                                             {-6.0F, 0.26F, 0.22F, 0.78F},
                                             {-4.6F, 0.55F, 0.42F, 0.52F},
                                             {-2.4F, 1.14F, 1.02F, 0.22F},
                                             {0.0F, 1.62F, 1.55F, 0.05F},
                                             {2.4F, 1.84F, 1.80F, 0.0F},
                                             {4.4F, 1.66F, 1.62F, 0.0F},
                                             {5.8F, 1.22F, 1.18F, -0.04F},
                                             {6.6F, 0.74F, 0.72F, -0.08F},
                                             {7.0F, 0.0F, 0.0F, -0.1F}}};

/// Catmull-Rom between the sections; the nose is round.
Section sectionAt(float x) {
    std::size_t i = 0;
    while (i + 2 < kSections.size() && kSections[i + 1].x <= x)
        ++i;
    const Section& a = kSections[i];
    const Section& b = kSections[i + 1];
    const Section& before = kSections[i == 0 ? 0 : i - 1];
    const Section& after = kSections[std::min(i + 2, kSections.size() - 1)];
    const float t = std::clamp((x - a.x) / (b.x - a.x), 0.0F, 1.0F);
    const auto spline = [&](float Section::*value) {
        const float h = b.x - a.x;
        const float m0 = h * (b.*value - before.*value) / std::max(b.x - before.x, 1e-3F);
        const float m1 = h * (after.*value - a.*value) / std::max(after.x - a.x, 1e-3F);
        const float t2 = t * t;
        const float t3 = t2 * t;
        return (2 * t3 - 3 * t2 + 1) * (a.*value) + (t3 - 2 * t2 + t) * m0 +
               (3 * t2 - 2 * t3) * (b.*value) + (t3 - t2) * m1;
    };
    Section out{x, spline(&Section::height), spline(&Section::width), spline(&Section::lift)};
    if (i + 2 == kSections.size()) {  // a quarter of an ellipse
        const float round = std::sqrt(std::max(0.0F, 1.0F - t * t));
        out.height = a.height * round;
        out.width = a.width * round;
    }
    return out;
}

PartMesh hull() {
    // Denser towards the nose, where it turns away fast.
    std::vector<float> stations;
    for (int k = 0; k <= 96; ++k)
        stations.push_back(-kHalfLength + (6.6F + kHalfLength) * float(k) / 96.0F);
    for (int k = 1; k <= 24; ++k)
        stations.push_back(6.6F + 0.4F * std::sin(0.5F * float(kPi) * float(k) / 24.0F));
    for (const float cut : {-kCut, kCut})
        *std::min_element(stations.begin(), stations.end(), [&](float a, float b) {
            return std::abs(a - cut) < std::abs(b - cut);
        }) = cut;
    const int rows = int(stations.size()) + 1;
    PartMesh mesh = gridSurface(rows, kAround, true, kChrome, 2.0F, [&](int row, int column) {
        const Section s = sectionAt(stations[std::size_t(std::max(row - 1, 0))]);
        const float size = row == 0 ? 0.0F : 1.0F;
        const float a = 2.0F * float(kPi) * float(column) / float(kAround);
        // A flatter belly than back.
        const float up = std::sin(a) * (std::sin(a) < 0.0F ? 0.88F : 1.0F);
        return GridPoint{
            {s.x, size * s.width * std::cos(a), kMiddle + s.lift + size * s.height * up}, {}};
    });
    faceOutwards(mesh);
    return mesh;
}

/// A fin: an aerofoil that tapers along `span` and is swept back.
PartMesh fin(const glm::vec3& root, const glm::vec3& span, float chord, float sweep,
             float thickness, const glm::vec3& flat) {
    constexpr int kRows = 24, kRound = 28;
    PartMesh mesh = gridSurface(kRows + 1, kRound, true, kChrome, 1.6F, [&](int row, int column) {
        const float u = float(row) / float(kRows);
        const float size =
            chord * std::pow(std::max(0.0F, 1.0F - u * u), 0.6F) * (1.0F - 0.35F * u);
        const float a = 2.0F * float(kPi) * float(column) / float(kRound);
        const glm::vec3 middle = root + span * u - glm::vec3(sweep * u * u, 0.0F, 0.0F);
        return GridPoint{middle + glm::vec3(0.5F * size * std::cos(a), 0.0F, 0.0F) +
                             flat * (0.5F * thickness * size * std::sin(a)),
                         {}};
    });
    faceOutwards(mesh);
    return mesh;
}

PartMesh whole() {
    PartMesh mesh = hull();
    const auto both = [&](PartMesh part) {
        append(mesh, mirroredLeftRight(part));
        append(mesh, part);
    };
    both(fin({-6.5F, 0.0F, kMiddle + 0.92F}, {0.0F, 2.5F, 0.25F}, 1.5F, 1.1F, 0.16F,
             {0.0F, 0.0F, 1.0F}));  // flukes
    both(fin({3.3F, 1.25F, kMiddle - 0.95F}, {-0.5F, 2.5F, -1.1F}, 1.3F, 1.1F, 0.18F,
             glm::normalize(glm::vec3(0.0F, 0.4F, 1.0F))));  // flippers
    append(mesh, fin({-2.0F, 0.0F, kMiddle + 1.25F}, {-0.2F, 0.0F, 0.95F}, 1.3F, 0.6F, 0.14F,
                     {0.0F, 1.0F, 0.0F}));
    both(ellipsoid({5.3F, 1.27F, kMiddle - 0.25F}, {0.13F, 0.10F, 0.12F}, 16, kEye));
    return mesh;
}

/// The triangles whose middle lies between two planes, as a body about x = middle.
VehicleBody part(const PartMesh& mesh, float from, float to) {
    const float middle = 0.5F * (std::max(from, -kHalfLength) + std::min(to, kHalfLength));
    PartMesh piece;
    std::map<std::uint32_t, std::uint32_t> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3& triangle = mesh.triangles[t];
        const float x = (mesh.positions[triangle.x].x + mesh.positions[triangle.y].x +
                         mesh.positions[triangle.z].x) /
                        3.0F;
        if (x < from || x >= to)
            continue;
        glm::uvec3 corner{0U};
        for (int k = 0; k < 3; ++k) {
            const auto [entry, added] =
                known.try_emplace(triangle[k], std::uint32_t(piece.positions.size()));
            if (added) {
                piece.positions.push_back(mesh.positions[triangle[k]] -
                                          glm::vec3(middle, 0.0F, 0.0F));
                piece.normals.push_back(mesh.normals[triangle[k]]);
            }
            corner[k] = entry->second;
        }
        piece.triangles.push_back(corner);
        piece.material.push_back(mesh.material[t]);
    }
    VehicleBody body = toBody(std::move(piece), 0.0F, 2.0F * kMiddle);
    body.offset = double(middle);
    body.pivotSpan = 6.0;
    body.pivotMiddle = -body.offset;  // all bend with the same two points: one rigid whale
    return body;
}

}  // namespace

Vehicle makeWhale() {
    Vehicle vehicle;
    vehicle.name = "whale";
    VehicleMaterial chrome;
    chrome.name = "chrome";
    chrome.baseColor = glm::vec3(0.9F, 0.92F, 0.94F);
    chrome.metallic = 1.0F;
    VehicleMaterial eye;
    eye.name = "eye";
    eye.baseColor = glm::vec3(0.01F);
    eye.clearCoat = 1.0F;
    vehicle.materials = {chrome, eye};
    const PartMesh mesh = whole();
    vehicle.bodies = {part(mesh, kCut, 100.0F), part(mesh, -kCut, kCut),
                      part(mesh, -100.0F, -kCut)};
    return vehicle;
}

}  // namespace reflet
