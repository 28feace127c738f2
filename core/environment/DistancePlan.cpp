// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistancePlan.h"

#include "core/environment/CubeDirection.h"
#include "core/environment/DistanceBlocks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace reflet {

using namespace distance_forms;

namespace {

float sum(const TexelFloats& values) {
    return std::accumulate(values.begin(), values.end(), 0.0f);
}

float sumOfLeast(const TexelFloats& a, const TexelFloats& b) {
    float out = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i)
        out += std::min(a[i], b[i]);
    return out;
}

}  // namespace

DistanceFacePlan::DistanceFacePlan(const CubeMap<float>& distances, int face)
    : m_distances(distances),
      m_face(face),
      m_edge(DistanceBlocks::blocksAlong(distances.resolution())),
      m_blocks(std::size_t(m_edge) * std::size_t(m_edge)) {
    for (const auto plan : {&DistanceFacePlan::planPlane, &DistanceFacePlan::planMixture}) {
        for (int row = 0; row < m_edge; ++row) {
            for (int column = 0; column < m_edge; ++column)
                (this->*plan)(column, row);
        }
    }
}

/// Texels beyond the edge repeat the last ones.
DistanceTexels DistanceFacePlan::texels(int column, int row) const {
    const int n = m_distances.resolution();
    TexelFloats lengths, distances;
    for (int i = 0; i < 16; ++i) {
        const int x = std::min(4 * column + i % 4, n - 1);
        const int y = std::min(4 * row + i / 4, n - 1);
        lengths[std::size_t(i)] = float(glm::length(texelDirection(n, m_face, x, y)));
        distances[std::size_t(i)] = m_distances.at(m_face, x, y);
    }
    return {lengths, distances};
}

std::size_t DistanceFacePlan::firstFrom(int row) const {
    const auto first = std::lower_bound(m_planes.begin(), m_planes.end(), row,
                                        [](const SharedPlane& p, int r) { return p.row < r; });
    return std::size_t(first - m_planes.begin());
}

bool DistanceFacePlan::reaches(const SharedPlane& plane, int column, int row) const {
    const auto within = [](int offset) { return offset >= -kReach && offset < kReach; };
    return within(plane.column - column) && within(plane.row - row);
}

/// The plane that was found last and fits, or a new one.
void DistanceFacePlan::planPlane(int column, int row) {
    const DistanceTexels texels = this->texels(column, row);
    Block& block = this->block(column, row);
    block.rough = roughBlock({});
    if (texels.isSky())
        return;
    const Plane fitted = texels.fit();
    const std::uint64_t rough = roughBlock(fitted);
    const float roughError = sum(texels.errors(roughPlaneOf(rough), 0, 0));
    block.roughError = sum(texels.errorsOfSky());
    if (roughError < block.roughError) {
        block.rough = rough;
        block.roughError = roughError;
    }
    const std::size_t first = firstFrom(row - kReach);
    for (std::size_t i = m_planes.size(); i > first && !block.plane; --i) {
        const SharedPlane& each = m_planes[i - 1];
        if (reaches(each, column, row) &&
            texels.areRight(each.plane, each.column - column, each.row - row))
            block.plane = i - 1;
    }
    const Plane own = planeOf(planeEntry(fitted));
    if (!block.plane && own.a > 0.0f && texels.areRight(own, 0, 0)) {
        block.plane = m_planes.size();
        m_planes.push_back({own, column, row, 0.0f});
    }
    if (block.plane)
        m_planes[*block.plane].harm += block.roughError;
}

/// One plane after the other, that which helps most beside those before it and the sky.
void DistanceFacePlan::planMixture(int column, int row) {
    Block& block = this->block(column, row);
    if (block.plane || block.roughError == 0.0f)
        return;
    const DistanceTexels texels = this->texels(column, row);
    struct Candidate {
        std::size_t plane;
        TexelFloats errors;
    };
    std::vector<Candidate> candidates;
    const std::size_t last = firstFrom(row + kReach);
    for (std::size_t i = firstFrom(row - kReach); i < last; ++i) {
        const SharedPlane& each = m_planes[i];
        if (!reaches(each, column, row))
            continue;
        const TexelFloats errors = texels.errors(each.plane, each.column - column, each.row - row);
        if (*std::min_element(errors.begin(), errors.end()) < DistanceTexels::kMostError)
            candidates.push_back({i, errors});
    }
    TexelFloats now = texels.errorsOfSky();
    std::array<unsigned, 16> indices;
    indices.fill(kSkyIndex);
    Mixture mixture;
    while (mixture.planes.size() < kSkyIndex && !candidates.empty() && !texels.areRight(now)) {
        const Candidate* best = nullptr;
        float least = sum(now);
        for (const Candidate& each : candidates) {
            if (const float error = sumOfLeast(now, each.errors); error < least) {
                least = error;
                best = &each;
            }
        }
        if (best == nullptr)
            break;
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (best->errors[i] < now[i]) {
                now[i] = best->errors[i];
                indices[i] = unsigned(mixture.planes.size());
            }
        }
        mixture.planes.push_back(best->plane);
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
        mixture.indices |= indices[i] << (2U * unsigned(i));
    mixture.error = sum(now);
    mixture.isRight = texels.areRight(now);
    block.mixture = std::move(mixture);
}

}  // namespace reflet
