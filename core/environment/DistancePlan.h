// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"
#include "core/environment/DistanceTexels.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace reflet {

/// How the blocks of a face of distances are to be told, before entries are given out.
class DistanceFacePlan {
public:
    /// The plane of a face that several blocks share.
    struct SharedPlane {
        distance_forms::Plane plane;  ///< as it is decoded
        int column = 0, row = 0;      ///< the block from whose middle it is told
        float harm = 0.0f;            ///< metres of error that the blocks have without it
    };
    /// A block as planes of the face and the sky, texel by texel.
    struct Mixture {
        std::vector<std::size_t> planes;  ///< at most three
        std::uint32_t indices = 0;        ///< 2 bits a texel, 3 = sky
        float error = 0.0f;               ///< metres, over all texels
        bool isRight = false;
    };
    struct Block {
        std::uint64_t rough = 0;           ///< the block in form `rough`
        float roughError = 0.0f;           ///< metres, over all texels; 0 for all sky
        std::optional<std::size_t> plane;  ///< that is right for all texels
        std::optional<Mixture> mixture;    ///< of blocks without a plane
    };

    DistanceFacePlan(const CubeMap<float>& distances, int face);

    [[nodiscard]] const std::vector<SharedPlane>& planes() const { return m_planes; }
    [[nodiscard]] const std::vector<Block>& blocks() const { return m_blocks; }
    [[nodiscard]] int edge() const { return m_edge; }
    [[nodiscard]] DistanceTexels texels(int column, int row) const;

private:
    void planPlane(int column, int row);
    void planMixture(int column, int row);
    [[nodiscard]] Block& block(int column, int row) {
        return m_blocks[std::size_t(row * m_edge + column)];
    }
    /// The planes that a reference from the row can reach are [first, last).
    [[nodiscard]] std::size_t firstFrom(int row) const;
    [[nodiscard]] bool reaches(const SharedPlane& plane, int column, int row) const;

    const CubeMap<float>& m_distances;
    int m_face;
    int m_edge;
    std::vector<SharedPlane> m_planes;  ///< by row, then column
    std::vector<Block> m_blocks;
};

}  // namespace reflet
