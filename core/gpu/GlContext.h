// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <memory>
#include <string>
#include <string_view>

namespace reflet {

/// A headless OpenGL 4.5 core context on raw EGL: the first real GPU device, else Mesa surfaceless,
/// else a software device, else the default display. It has no window: draw into framebuffer
/// objects. Current on the thread that made it; use and destroy it there. Several threads may each
/// have one. ResourceLimit when no display gives such a context, with the reason of each.
class GlContext {
public:
    [[nodiscard]] static Result<std::unique_ptr<GlContext>> createHeadless();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Makes it current again where another context was made current on its thread since.
    [[nodiscard]] Result<void> makeCurrent();

    /// The driver's own words, as for glGetString(GL_RENDERER) and GL_VERSION.
    [[nodiscard]] const std::string& renderer() const { return m_renderer; }
    [[nodiscard]] const std::string& version() const { return m_version; }
    /// "EGL device", "Mesa surfaceless", "EGL software device" or "EGL default display".
    [[nodiscard]] const std::string& path() const { return m_path; }

private:
    GlContext() = default;
    /// Makes the context on an EGLDisplay, current; the reason as text when it fails.
    [[nodiscard]] static tl::expected<std::unique_ptr<GlContext>, std::string> createOn(
        void* display);

    void* m_display = nullptr;
    void* m_context = nullptr;
    void* m_surface = nullptr;  ///< a pbuffer of one pixel where a context needs one, else none
    std::string m_renderer, m_version, m_path;
};

/// Whether what a driver calls itself (glGetString(GL_RENDERER)) is one of Mesa's in software.
[[nodiscard]] bool isSoftwareRenderer(std::string_view renderer);

/// Whether contexts without a window draw in software on this machine; false where there are none.
/// Found out at the first call, which may take a tenth of a second; those of other threads wait.
[[nodiscard]] bool drawsInSoftware();

}  // namespace reflet
