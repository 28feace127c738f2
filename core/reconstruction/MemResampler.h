// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

namespace reflet {

/// Writes the texels of one leaf after another into a local map. Leaves of one mesh hold disjoint
/// texels, so that threads may share a resampler as long as no two write the same leaf.
class MemResampler {
public:
    MemResampler(const ReconstructionInput& input, const RemChoice& choice,
                 const glm::dvec3& position, Interpolation interpolation, LocalEnvironmentMap& map);

    void writeLeaf(int faceIndex, const MemFace& face, const MemQuad& quad) const;

private:
    /// A REM with what does not change from texel to texel.
    struct Source {
        const ReferenceEnvironmentMap* rem = nullptr;
        glm::dvec3 offset{0.0};  ///< P − C
    };
    struct Leaf;

    void writeTexelLeaf(int faceIndex, const MemVertex& vertex, int column, int row) const;
    [[nodiscard]] glm::vec3 radianceSeen(const Source& source, const MemVertex& vertex) const;
    [[nodiscard]] Leaf prepare(const MemFace& face, const MemQuad& quad) const;
    [[nodiscard]] glm::vec3 radianceAt(const Leaf& leaf, const glm::dvec3& direction,
                                       double inverseDepth, double u, double v) const;

    Source m_a;
    Source m_b;
    Interpolation m_interpolation;
    double m_sceneDiameter;
    double m_tolerance;
    LocalEnvironmentMap& m_map;
};

}  // namespace reflet
