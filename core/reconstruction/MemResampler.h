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
    /// sources: written beside the radiance; may be null. Of the map's resolution.
    MemResampler(const ReconstructionInput& input, const RemCandidates& candidates,
                 const glm::dvec3& position, Interpolation interpolation, LocalEnvironmentMap& map,
                 TexelSources* sources = nullptr);

    void writeLeaf(int faceIndex, const MemFace& face, const MemQuad& quad) const;
    /// A texel that has a ray of its own.
    void writeTexel(int faceIndex, const MemVertex& vertex, int column, int row) const;

private:
    /// A REM with what does not change from texel to texel.
    struct Source {
        const ReferenceEnvironmentMap* rem;
        std::size_t index;  ///< in the set
        CubeSampler sampler;
        glm::dvec3 offset;  ///< P − C
    };
    struct Leaf;

    [[nodiscard]] Leaf prepare(const MemFace& face, const MemQuad& quad) const;
    [[nodiscard]] std::array<glm::vec3, 4> lookups(const Source& source, const MemFace& face,
                                                   const MemQuad& quad) const;
    void writeRun(int faceIndex, int row, int column, const Leaf& leaf, const TexelRun& run) const;
    void writeSources(int faceIndex, int row, int column, const Leaf& leaf,
                      const TexelRun& run) const;

    std::vector<Source> m_sources;  ///< in the order of the candidates
    Interpolation m_interpolation;
    double m_sceneDiameter;
    LocalEnvironmentMap& m_map;
    TexelSources* m_texelSources;
};

}  // namespace reflet
