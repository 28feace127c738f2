// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeSampler.h"

#include <array>

namespace reflet {

/// A value at the corners (s0,t0) (s1,t0) (s0,t1) (s1,t1) of a leaf, interpolated bilinearly.
struct LeafScalar {
    std::array<float, 4> corner{};

    /// Along one row, at v: first + u · slope.
    struct Line {
        float first, slope;
        [[nodiscard]] float at(float u) const { return first + u * slope; }
    };
    [[nodiscard]] Line along(float v) const {
        const float first = corner[0] + v * (corner[2] - corner[0]);
        const float last = corner[1] + v * (corner[3] - corner[1]);
        return {first, last - first};
    }
};

/// Some neighbouring texels of one row of a leaf, by their place in it: (u, v) in [0, 1]².
struct TexelRun {
    static constexpr int kMost = 32;
    int count = 0;
    float v = 0.0f;
    std::array<float, kMost> u{};
};

/// Texture coordinates (vectors from a REM's centre, of any length) that run bilinearly over a
/// leaf.
///
/// When all four corners fall on one face of the REM, every vector between them does, since the
/// cone of a face is convex. Then s/m and t/m, with s, t and the major component m interpolated
/// each, replace the choice of a face for each texel.
class LeafLookup {
public:
    /// manyTexels: it pays to look for the face that all corners share.
    LeafLookup(const CubeSampler& sampler, const std::array<glm::vec3, 4>& corners,
               bool manyTexels);

    /// The radiance for each texel of the run.
    void read(const TexelRun& run, std::array<Float4, TexelRun::kMost>& radiance) const;

private:
    [[nodiscard]] bool shareFace(const std::array<glm::vec3, 4>& corners);
    void readOneFace(const TexelRun& run, std::array<Float4, TexelRun::kMost>& radiance) const;
    void readAnyFace(const TexelRun& run, std::array<Float4, TexelRun::kMost>& radiance) const;

    const CubeSampler& m_sampler;
    int m_face = 0;
    LeafScalar m_x, m_y, m_z;  ///< the vector itself, or s, t and m on the face that is shared
    bool m_oneFace;            ///< decided last, for shareFace() fills in the rest
};

}  // namespace reflet
