// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/gpu/base/Program.h"
#include "core/gpu/reflection/HeightfieldTable.h"
#include "core/gpu/reflection/RemStore.h"
#include "core/reconstruction/RemSelection.h"

namespace reflet {

/// What resources/shaders/rem_sight.glsl reads: the reference maps that may serve rays from about a
/// position, in texture units 14 to 19 and uniform buffer 3, beside the heightfield.
class SightTable {
public:
    /// The most different resolutions that the maps of a set may have.
    static constexpr std::size_t kArrays = 3;

    /// Uploads and binds all of it for a program. A map that the store's budget has no room for is
    /// left out.
    void bind(const Program& program, const HeightfieldTable& field, RemStore& store,
              const RemSet& rems, const RemCandidates& candidates, const glm::dvec3& position,
              bool refineHits);

private:
    Buffer m_candidates;
};

}  // namespace reflet
