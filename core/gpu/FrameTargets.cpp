// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/FrameTargets.h"

#include "core/gpu/base/GlState.h"
#include "core/gpu/base/ShaderLibrary.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace reflet {

Result<std::unique_ptr<FrameTargets>> FrameTargets::create() {
    std::unique_ptr<FrameTargets> targets(new FrameTargets);
    for (const auto& [program, name] :
         {std::pair{&targets->m_resolve, "frame_resolve"}, {&targets->m_smooth, "frame_smooth"}}) {
        auto made = makeProgram(name);
        if (!made)
            return tl::unexpected(made.error());
        *program = std::move(*made);
    }
    targets->m_noAttributes = VertexArray::make();
    return targets;
}

Result<void> FrameTargets::resize(int width, int height, int samplesPerEdge) {
    width = std::max(width, 1);
    height = std::max(height, 1);
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(width, height) > largest) {
        return fail(ErrorCode::ResourceLimit, "the graphics driver has no pictures that large",
                    std::to_string(width) + " x " + std::to_string(height),
                    "Choose a smaller size.");
    }
    samplesPerEdge = std::clamp(samplesPerEdge, 1, int(largest) / std::max(width, height));
    if (width == m_width && height == m_height && samplesPerEdge == m_samples && m_display)
        return {};
    m_width = width;
    m_height = height;
    m_samples = samplesPerEdge;
    m_radiance = Texture::make2D(GL_RGBA16F, width * samplesPerEdge, height * samplesPerEdge);
    m_depth =
        Texture::make2D(GL_DEPTH32F_STENCIL8, width * samplesPerEdge, height * samplesPerEdge);
    m_depth.filter(GL_NEAREST, GL_NEAREST);
    m_displayColor = Texture::make2D(GL_RGBA8, width, height);
    m_display = Framebuffer::make();
    m_display.attach(GL_COLOR_ATTACHMENT0, m_displayColor);
    return m_display.check("display values");
}

void FrameTargets::resolve(float exposure) {
    resetGlState();
    m_display.bind();
    glViewport(0, 0, m_width, m_height);
    m_radiance.bind(0);
    m_noAttributes.bind();
    m_resolve.use();
    m_resolve.set("samplesPerEdge", m_samples);
    m_resolve.set("exposure", exposure);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FrameTargets::present(unsigned framebuffer) {
    resetGlState();
    if (m_samples > 1) {
        glBlitNamedFramebuffer(m_display.id(), framebuffer, 0, 0, m_width, m_height, 0, 0, m_width,
                               m_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        return;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, m_width, m_height);
    m_displayColor.bind(0);
    m_noAttributes.bind();
    m_smooth.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace reflet
