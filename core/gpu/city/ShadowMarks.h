// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/gpu/base/Program.h"
#include "core/gpu/city/SunShadow.h"

namespace reflet {

/// Marks the pixels of a view of the city on which the shadows of moving bodies may fall: at least
/// those from which the way to the sun meets a body's box.
class ShadowMarks {
public:
    static constexpr unsigned kMark = 0x80U;  ///< the bit of the stencil buffer

    [[nodiscard]] static Result<ShadowMarks> create();

    /// Into the stencil of the framebuffer that is bound; its colours and depths stay as they are.
    /// depth: the city's, as CityTargets have it, but not attached. The stencil test must be on.
    /// Leaves face culling off and the masks and stencil operations to be set anew.
    void draw(const CityView& view, const Texture& depth, const SunShadow& shadow) const;

private:
    Program m_program;
    VertexArray m_noAttributes;
};

}  // namespace reflet
