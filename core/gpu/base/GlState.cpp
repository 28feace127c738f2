// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/GlState.h"

#include <epoxy/gl.h>

#include <initializer_list>

namespace reflet {

void resetGlState() {
    for (const GLenum test : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE,
                              GL_BLEND, GL_POLYGON_OFFSET_FILL})
        glDisable(test);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glStencilMask(0xFFU);
    glFrontFace(GL_CCW);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void restoreGlDefaults() {
    resetGlState();
    glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBindVertexArray(0);
    glUseProgram(0);
}

}  // namespace reflet
