// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/gpu/base/Program.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <glm/vec3.hpp>

namespace reflet {

/// A heightfield on the GPU, as resources/shaders/heightfield_ray.glsl traces it: the pyramid of
/// its maxima as levels of a texture, and the stretches of its hollow columns. Answers are those of
/// HeightfieldTracer but for rounding: positions are floats relative to a point near to the rays.
/// tests/gpu holds the hits of a map to a centimetre for all but one ray in a thousand.
class HeightfieldTable {
public:
    HeightfieldTable() = default;
    /// Whether the driver's textures are large enough for a grid.
    [[nodiscard]] static bool fits(const GridSpec& grid);
    /// Uploads all of it. The grid must fit.
    explicit HeightfieldTable(const HeightfieldTracer& tracer);

    /// Sets what the shader reads for rays from about a position, in texture units 6 to 8.
    void bind(const Program& program, const glm::dvec3& position) const;

    [[nodiscard]] const GridSpec& grid() const { return m_grid; }
    [[nodiscard]] explicit operator bool() const { return bool(m_heights); }

private:
    GridSpec m_grid;
    double m_top = 0.0;  ///< of the highest column, metres
    Texture m_heights;
    Texture m_hollows;
    Buffer m_stretches;
    Texture m_stretchView;
    bool m_hasHollows = false;
};

}  // namespace reflet
