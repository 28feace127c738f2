// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/SplineSurface.h"

#include "core/math/Geometry.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace reflet {
namespace {

/// Weights of the four control points around a span at t in [0, 1].
std::array<float, 4> basis(float t) {
    const float s = 1.0F - t;
    return {s * s * s / 6.0F, (3 * t * t * t - 6 * t * t + 4) / 6.0F,
            (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6.0F, t * t * t / 6.0F};
}

/// A row of the net around the whole body: bottom, left, top, right.
glm::vec3 around(const std::vector<glm::vec3>& half, int k) {
    const int n = int(half.size()) - 1;
    const int m = ((k % (2 * n)) + 2 * n) % (2 * n);
    if (m <= n) {
        return half[std::size_t(m)];
    }
    const glm::vec3 p = half[std::size_t(2 * n - m)];
    return {p.x, -p.y, p.z};
}

}  // namespace

PartMesh splineSurface(const SplineNet& net, std::uint16_t material) {
    const int controlRows = int(net.rows.size());
    assert(controlRows >= 2);
    const int spans = controlRows + 1;  // the ends count three times
    const int columns = 2 * (int(net.rows.front().size()) - 1) * net.columnSteps;
    const auto rowAt = [&](int i) -> const std::vector<glm::vec3>& {
        return net.rows[std::size_t(std::clamp(i, 0, controlRows - 1))];
    };
    return gridSurface(
        spans * net.rowSteps + 1, columns, true, material, float(kPi), [&](int i, int j) {
            const int span = std::min(i / net.rowSteps, spans - 1);
            const auto wu = basis(float(i - span * net.rowSteps) / float(net.rowSteps));
            const int column = j / net.columnSteps;
            const auto wv = basis(float(j - column * net.columnSteps) / float(net.columnSteps));
            glm::vec3 p(0.0F);
            for (int a = 0; a < 4; ++a) {
                for (int b = 0; b < 4; ++b) {
                    p += wu[std::size_t(a)] * wv[std::size_t(b)] *
                         around(rowAt(span + a - 2), column + b - 1);
                }
            }
            return GridPoint{p, {float(span), float(column)}};
        });
}

}  // namespace reflet
