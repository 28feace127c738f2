// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/GlVersion.h"

#include <epoxy/gl.h>

#include <string>
#include <string_view>

namespace reflet {

namespace {

constexpr int kNeeded = 45;

std::string word(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string("unknown") : reinterpret_cast<const char*>(text);
}

}  // namespace

Result<void> requireOpenGl45() {
    const int version = epoxy_gl_version();
    if (version == 0)
        return fail(ErrorCode::Usage, "no OpenGL context is current", "OpenGL 4.5 core");
    GLint profile = 0;
    if (version >= 32)
        glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    if (version >= kNeeded && (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0)
        return {};
    return fail(ErrorCode::ResourceLimit,
                "this machine's graphics driver gives OpenGL " + word(GL_VERSION) + " (" +
                    word(GL_RENDERER) + "), and Reflet draws with 4.5 core",
                "OpenGL 4.5 core",
                "Update the driver of the graphics card, or draw in software: start Reflet with "
                "LIBGL_ALWAYS_SOFTWARE=1 (needs libgl1-mesa-dri).");
}

bool contextDrawsInSoftware() {
    const GLubyte* name = glGetString(GL_RENDERER);
    const std::string_view text = name != nullptr ? reinterpret_cast<const char*>(name) : "";
    return text.find("llvmpipe") != text.npos || text.find("softpipe") != text.npos;
}

}  // namespace reflet
