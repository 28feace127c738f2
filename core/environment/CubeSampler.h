// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeDirection.h"

#include <cmath>
#include <cstring>

namespace reflet {

/// Four floats in a register; colours use the first three.
typedef float Float4 __attribute__((vector_size(16)));

[[nodiscard]] inline glm::vec3 toVec3(const Float4& c) {
    return {c[0], c[1], c[2]};
}

/// sampleBilinear for inner loops: the same answers but for float rounding of the position (some
/// 1e-5 texels at 128²), three times as fast. The map must outlive it and not be empty.
///
/// Positions are in texels with 0 at the first centre: x = s · scale() + shift() for s in [-1, 1].
/// Between 0 and last() the four texels lie inside the face, and interior() may be used.
class CubeSampler {
public:
    explicit CubeSampler(const CubeMap<glm::vec3>& map)
        : m_map(&map),
          m_texels(map.texels().data()),
          m_resolution(map.resolution()),
          m_scale(0.5f * float(m_resolution)),
          m_last(std::nextafter(float(m_resolution - 1), 0.0f)) {}

    [[nodiscard]] float scale() const { return m_scale; }
    [[nodiscard]] float shift() const { return m_scale - 0.5f; }
    /// The largest position that interior() takes; 0 when a face has but one texel.
    [[nodiscard]] float last() const { return m_last; }

    /// 0 <= x, y <= last(), at least 2 × 2 texels.
    [[nodiscard]] Float4 interior(int face, float x, float y) const {
        const int column = int(x);
        const int row = int(y);
        const glm::vec3* upper =
            m_texels + (std::size_t(face * m_resolution + row) * std::size_t(m_resolution) +
                        std::size_t(column));
        const float u = x - float(column);
        const Float4 above = between(upper, u);
        const Float4 below = between(upper + m_resolution, u);
        return above + (y - float(row)) * (below - above);
    }

    /// Any direction; that of length zero is taken as +X.
    [[nodiscard]] Float4 sample(const glm::vec3& direction) const {
        const float ax = std::abs(direction.x);
        const float ay = std::abs(direction.y);
        const float az = std::abs(direction.z);
        int face = 0;
        float s = 0.0f, t = 0.0f, major = 0.0f;
        if (ax >= ay && ax >= az) {
            face = direction.x > 0.0f ? 0 : 1;
            s = direction.x > 0.0f ? -direction.z : direction.z;
            t = -direction.y;
            major = ax;
        } else if (ay >= az) {
            face = direction.y > 0.0f ? 2 : 3;
            s = direction.x;
            t = direction.y > 0.0f ? direction.z : -direction.z;
            major = ay;
        } else {
            face = direction.z > 0.0f ? 4 : 5;
            s = direction.z > 0.0f ? direction.x : -direction.x;
            t = -direction.y;
            major = az;
        }
        const float factor = m_scale / major;
        const float x = s * factor + shift();
        const float y = t * factor + shift();
        if (x >= 0.0f && y >= 0.0f && x <= m_last && y <= m_last && m_resolution > 1)
            return interior(face, x, y);
        return acrossEdges(direction);
    }

private:
    /// A texel and its right neighbour are six floats in a row; two loads of four stay within them.
    [[nodiscard]] static Float4 between(const glm::vec3* texel, float u) {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        const auto* bytes = reinterpret_cast<const char*>(texel);
        Float4 left, right;
        std::memcpy(&left, bytes, sizeof left);
        std::memcpy(&right, bytes + 2 * sizeof(float), sizeof right);
        right = __builtin_shufflevector(right, right, 1, 2, 3, 3);
        return left + u * (right - left);
    }

    [[nodiscard]] Float4 acrossEdges(const glm::vec3& direction) const;

    const CubeMap<glm::vec3>* m_map;
    const glm::vec3* m_texels;
    int m_resolution;
    float m_scale;
    float m_last;
};

}  // namespace reflet
