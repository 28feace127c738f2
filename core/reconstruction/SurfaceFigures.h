// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/environment/RemSet.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/reconstruction/TexelSources.h"

#include <optional>
#include <vector>

namespace reflet {

/// Angles between the direction of a texel's centre and the direction in which the point that the
/// texel shows really lies, seen from P; in texels of 90 degrees / resolution. Over the texels
/// where both are surface or both are sky.
struct TexelError {
    double mean = 0.0, median = 0.0, p95 = 0.0;
};

/// Whether local maps show what is there (DESIGN 5.8), counted over texels. The point that a texel
/// shows is what its heaviest source met: a ray from the REM's centre along the look-up. The truth
/// is what a ray from P through the texel's centre meets.
///
/// A texel is right when both are sky, or both lie on the same surface of the city model, or on one
/// object in one plane (5 degrees, 0.1 m; facades come in pieces), or at most half a metre or two
/// texels apart as seen from P, whichever is larger. Vehicles are left out of all of this.
struct SurfaceFigures {
    double wrong = 0.0;  ///< share of all texels
    /// Share of those whose true point some REM in use sees; nullopt without any.
    std::optional<double> wrongSeen;
    std::optional<TexelError> texelError;
    /// The method's own error: the same with the city replaced by the heightfield for both rays, so
    /// that the shape that the method knows is the truth. Right: the same flat top (cells' diagonal
    /// in height), or a cell's diagonal, half a metre or two texels apart.
    double algorithmWrong = 0.0;
    std::optional<TexelError> algorithmTexelError;
    /// The model's error: share of directions from P in which the heightfield itself meets another
    /// surface than the city: its hit is off the plane that is really met by more than a cell's
    /// diagonal, and half a metre or two texels from the point.
    double modelWrong = 0.0;
};

/// Gathers figures over the local maps of one method.
class SurfaceTally {
public:
    /// scene and field must outlive it.
    SurfaceTally(const RadianceScene& scene, const HeightfieldTracer& field)
        : m_scene(&scene), m_field(&field) {}

    /// The map around `position` that the sources are of; texels without a source are wrong.
    void add(const RemSet& rems, const TexelSources& sources, const glm::dvec3& position);
    [[nodiscard]] SurfaceFigures figures() const;

    /// What one map adds: public for its parallel parts alone.
    struct Counts {
        std::size_t texels = 0, wrong = 0, seen = 0, wrongSeen = 0, algorithmWrong = 0,
                    modelWrong = 0;
        std::vector<float> errors, algorithmErrors;  ///< texels

        void add(const Counts& other);
    };

private:
    const RadianceScene* m_scene;
    const HeightfieldTracer* m_field;
    Counts m_counts;
};

}  // namespace reflet
