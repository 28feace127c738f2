// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeSampler.h"
#include "core/reconstruction/LeafLookup.h"
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
        const ReferenceEnvironmentMap* rem;
        CubeSampler sampler;
        glm::dvec3 offset;  ///< P − C
    };
    struct Leaf;

    [[nodiscard]] Leaf prepare(const MemFace& face, const MemQuad& quad) const;
    [[nodiscard]] LeafLookup lookup(const Source& source, const MemFace& face, const MemQuad& quad,
                                    bool manyTexels) const;
    void writeRun(int faceIndex, int row, int column, const Leaf& leaf, const TexelRun& run) const;
    void writeTexelLeaf(int faceIndex, const MemVertex& vertex, int column, int row) const;

    std::optional<Source> m_a;
    std::optional<Source> m_b;
    Interpolation m_interpolation;
    double m_sceneDiameter;
    LocalEnvironmentMap& m_map;
};

}  // namespace reflet
