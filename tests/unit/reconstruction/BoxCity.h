// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <string>
#include <vector>

namespace reflet::test {

/// A city of boxes whose every answer is known: a heightfield, and a colour for each point of its
/// surface as a function of position and normal.
class BoxCity {
public:
    /// Flat ground at height 0, cells of cellSize metres, south-west corner at (x0, y0).
    BoxCity(double x0, double y0, int columns, int rows, double cellSize);

    /// Raises the cells whose centres lie in [x0, x1) × [y0, y1) to at least `height`.
    void addBox(double x0, double y0, double x1, double y1, float height);

    [[nodiscard]] const Heightfield& heightfield() const { return m_field; }
    /// Radiance along a ray: the surface's colour, or the sky's.
    [[nodiscard]] glm::vec3 radiance(const Ray& ray) const;
    /// A map seen from `center`, traced with traceReference: radiance is the mean of
    /// samples × samples rays a texel, distance that of the ray through the texel's centre.
    [[nodiscard]] ReferenceEnvironmentMap see(std::string id, const glm::dvec3& center,
                                              int resolution, int samples) const;

private:
    Heightfield m_field;
};

/// A street between two rows of houses of differing heights, with side streets, a square and poles.
[[nodiscard]] BoxCity streetCity();

/// A REM that tells where it was looked up: radiance (s, t, 1) of the texel's centre, which
/// bilinear lookups inside a face reproduce exactly; distance the same everywhere.
[[nodiscard]] ReferenceEnvironmentMap coordinateMap(std::string id, const glm::dvec3& center,
                                                    int resolution, float distance);

/// A map of one colour and one distance.
[[nodiscard]] ReferenceEnvironmentMap plainMap(std::string id, const glm::dvec3& center,
                                               int resolution, const glm::vec3& radiance,
                                               float distance);

}  // namespace reflet::test
