// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/VehicleShell.h"

#include "core/math/Geometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr float kShellCrease = 0.7F;

/// A row of the shell: the constant section, or a step around an end.
struct Row {
    float width = 1.0F;  // factor of y
    float sine = 0.0F;   // factor of the reach
    const ShellEnd* end = nullptr;
    float sign = 0.0F;   // of x, towards the end
    float x = 0.0F;      // of the constant section
    float along = 0.0F;  // surface.x
};

/// Rows from the base (excluded) to the tip (included): y = cos^(2/p) φ, x = sin^(2/p) φ.
std::vector<Row> endRows(const ShellSpec& spec, const ShellEnd& end, float sign, float halfWidth) {
    std::vector<Row> rows;
    const float power = 2.0F / end.roundness;
    glm::vec2 last(0.0F, halfWidth);
    float along = end.base;
    const int fine = 64;
    int taken = 0;
    for (int i = 1; i <= end.rows * fine; ++i) {
        const float phi = 0.5F * float(kPi) * float(i) / float(end.rows * fine);
        Row row;
        row.end = &end;
        row.sign = sign;
        row.width = i == end.rows * fine ? 0.0F : std::pow(std::cos(phi), power);
        row.sine = std::pow(std::sin(phi), power);
        const glm::vec2 p(row.sine * end.reach(spec.referenceHeight), row.width * halfWidth);
        along += sign * glm::distance(last, p);
        last = p;
        row.along = along;
        if (i % fine == 0) {
            rows.push_back(row);
            ++taken;
        }
    }
    return rows;
}

std::vector<Row> allRows(const ShellSpec& spec, float halfWidth) {
    std::vector<Row> rows = endRows(spec, spec.rear, -1.0F, halfWidth);
    std::reverse(rows.begin(), rows.end());
    const float length = spec.front.base - spec.rear.base;
    const int count = std::max(1, int(std::ceil(length / spec.step)));
    for (int i = 0; i <= count; ++i) {
        Row row;
        row.x = spec.rear.base + length * float(i) / float(count);
        row.along = row.x;
        rows.push_back(row);
    }
    const std::vector<Row> front = endRows(spec, spec.front, 1.0F, halfWidth);
    rows.insert(rows.end(), front.begin(), front.end());
    return rows;
}

}  // namespace

Shell vehicleShell(const ShellSpec& spec, std::uint16_t material) {
    std::vector<glm::vec2> ring = spec.halfSection;
    for (std::size_t i = spec.halfSection.size() - 1; i-- > 1;) {
        ring.emplace_back(-spec.halfSection[i].x, spec.halfSection[i].y);
    }
    float halfWidth = 0.0F;
    for (const glm::vec2& p : spec.halfSection) {
        halfWidth = std::max(halfWidth, p.x);
    }
    const std::vector<Row> rows = allRows(spec, halfWidth);
    Shell shell;
    shell.rearTip = rows.front().along;
    shell.frontTip = rows.back().along;
    shell.mesh = gridSurface(
        int(rows.size()), int(ring.size()), true, material, kShellCrease, [&](int i, int j) {
            const Row& row = rows[std::size_t(i)];
            const glm::vec2& p = ring[std::size_t(j)];
            const float x = row.end == nullptr
                                ? row.x
                                : row.end->base + row.sign * row.sine * row.end->reach(p.y);
            return GridPoint{glm::vec3(x, row.width * p.x, p.y), glm::vec2(row.along, p.y)};
        });
    return shell;
}

std::vector<glm::vec2> curvedSection(const SectionSpec& spec) {
    const auto sideAt = [&](float z) {
        const float d = z - spec.waist;
        return spec.halfWidth - 0.5F * d * d / spec.sideRadius;
    };
    std::vector<PathCorner> corners{{{0.0F, spec.bottom}, 0.0F},
                                    {{sideAt(spec.bottom) - 0.07F, spec.bottom}, 0.03F}};
    const float low = spec.bottom + 0.12F;
    const int count = std::max(4, int(std::ceil((spec.cant - low) / spec.sideStep)));
    for (int i = 0; i <= count; ++i) {
        const float z = low + (spec.cant - low) * float(i) / float(count);
        corners.push_back({{sideAt(z), z}, 0.0F});
    }
    const float shoulder = sideAt(spec.cant) - 0.22F * (spec.roof - spec.cant);
    corners.push_back({{shoulder, spec.roof - 0.07F}, spec.cantRadius});
    corners.push_back({{0.4F * shoulder, spec.roof - 0.005F}, 3.0F});
    corners.push_back({{0.0F, spec.roof}, 0.0F});
    return roundedPath(corners, spec.roofStep, 8);
}

}  // namespace reflet
