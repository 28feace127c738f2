// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/gpu/base/Program.h"

#include <memory>

namespace reflet {

/// The pictures that a frame passes through: linear radiance with depth at the resolution of the
/// samples, then display values at that of the request.
class FrameTargets {
public:
    [[nodiscard]] static Result<std::unique_ptr<FrameTargets>> create();

    /// samplesPerEdge is lowered where the driver has no textures that large.
    [[nodiscard]] Result<void> resize(int width, int height, int samplesPerEdge);

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] int samplesPerEdge() const { return m_samples; }
    [[nodiscard]] const Texture& radiance() const { return m_radiance; }  ///< RGBA16F
    [[nodiscard]] const Texture& depth() const { return m_depth; }  ///< DEPTH32F_STENCIL8, reversed
    /// Display values, RGBA8.
    [[nodiscard]] const Framebuffer& display() const { return m_display; }

    /// Radiance to display values: the samples of a pixel are weighted by 1 / (1 + luminance) as in
    /// renderView(), then exposed and encoded as toDisplay() does.
    void resolve(float exposure);
    /// The display values into a framebuffer of the caller; smooths edges when there is one sample
    /// a pixel.
    void present(unsigned framebuffer);

private:
    FrameTargets() = default;
    int m_width = 0, m_height = 0, m_samples = 1;
    Texture m_radiance, m_depth, m_displayColor;
    Framebuffer m_display;
    Program m_resolve, m_smooth;
    VertexArray m_noAttributes;
};

}  // namespace reflet
