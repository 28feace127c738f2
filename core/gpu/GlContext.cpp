// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/GlContext.h"

#include "core/gpu/EglDisplays.h"

#include <epoxy/egl.h>  // not EGL's own headers: they clash with epoxy/gl.h
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <thread>

namespace reflet {

namespace {

std::string eglFailure(const char* call) {
    return fmt::format("{} failed (0x{:04x})", call, static_cast<unsigned>(eglGetError()));
}

/// A configuration that a pbuffer of one pixel can have; null when there is none.
EGLConfig pbufferConfig(EGLDisplay display) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) == EGL_FALSE || count < 1)
        return nullptr;
    return config;
}

EGLContext createCoreContext(EGLDisplay display, EGLConfig config) {
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, wanted);
}

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

/// What the current context lacks of OpenGL 4.5 core; empty when it is one. A driver may give less
/// than was asked for.
std::string shortcoming() {
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    if (epoxy_gl_version() < 45 || (profile & GL_CONTEXT_CORE_PROFILE_BIT) == 0)
        return "it gives OpenGL " + glText(GL_VERSION);
    return {};
}

}  // namespace

GlContext::~GlContext() {
    // The display is shared with every other context of the process: it is never terminated.
    if (m_context != nullptr) {
        if (eglGetCurrentContext() == m_context)
            eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(m_display, m_context);
    }
    if (m_surface != nullptr)
        eglDestroySurface(m_display, m_surface);
}

tl::expected<std::unique_ptr<GlContext>, std::string> GlContext::createOn(void* display) {
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE)
        return tl::unexpected(eglFailure("eglInitialize"));
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        return tl::unexpected(eglFailure("eglBindAPI"));

    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    const bool surfaceless = hasExtension(extensions, "EGL_KHR_surfaceless_context");
    const bool anyConfig = surfaceless && hasExtension(extensions, "EGL_KHR_no_config_context");
    const EGLConfig config = anyConfig ? EGL_NO_CONFIG_KHR : pbufferConfig(display);
    if (!anyConfig && config == nullptr)
        return tl::unexpected(std::string("no configuration for OpenGL without a window"));

    std::unique_ptr<GlContext> made(new GlContext);
    made->m_display = display;
    made->m_context = createCoreContext(display, config);
    if (made->m_context == EGL_NO_CONTEXT)
        return tl::unexpected(eglFailure("eglCreateContext"));
    if (!surfaceless) {
        const EGLint onePixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        made->m_surface = eglCreatePbufferSurface(display, config, onePixel);
        if (made->m_surface == EGL_NO_SURFACE)
            return tl::unexpected(eglFailure("eglCreatePbufferSurface"));
    }
    if (eglMakeCurrent(display, made->m_surface, made->m_surface, made->m_context) == EGL_FALSE)
        return tl::unexpected(eglFailure("eglMakeCurrent"));
    if (std::string lacking = shortcoming(); !lacking.empty())
        return tl::unexpected(std::move(lacking));
    made->m_renderer = glText(GL_RENDERER);
    made->m_version = glText(GL_VERSION);
    return made;
}

Result<void> GlContext::makeCurrent() {
    if (eglGetCurrentContext() == m_context ||
        (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
         eglMakeCurrent(m_display, m_surface, m_surface, m_context) == EGL_TRUE))
        return {};
    return fail(ErrorCode::ResourceLimit,
                "the OpenGL context was lost: " + eglFailure("eglMakeCurrent"), "OpenGL 4.5 core",
                "Try again; if it stays, start with LIBGL_ALWAYS_SOFTWARE=1.");
}

Result<std::unique_ptr<GlContext>> GlContext::createHeadless() {
    std::string reasons;
    for (const EglDisplayCandidate& candidate : eglDisplayCandidates()) {
        auto made = createOn(candidate.display);
        if (made) {
            (*made)->m_path = candidate.path;
            return std::move(*made);
        }
        reasons += (reasons.empty() ? "" : "; ") + candidate.path + ": " + made.error();
    }
    if (reasons.empty())
        reasons = "EGL offers no display";
    return fail(ErrorCode::ResourceLimit, "no context without a window (" + reasons + ")",
                "OpenGL 4.5 core",
                "Install libegl1 and libgl1-mesa-dri, or the driver of the graphics card.");
}

bool isSoftwareRenderer(std::string_view renderer) {
    return renderer.find("llvmpipe") != std::string_view::npos ||
           renderer.find("softpipe") != std::string_view::npos;
}

bool drawsInSoftware() {
    static const bool software = [] {
        bool found = false;
        // On a thread of its own: the caller's may have another context current.
        std::thread([&found] {
            const auto context = GlContext::createHeadless();
            found = context && isSoftwareRenderer((*context)->renderer());
        }).join();
        return found;
    }();
    return software;
}

}  // namespace reflet
