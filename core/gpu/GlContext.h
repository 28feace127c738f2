// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/base/Error.h"

namespace reflet {

/// A headless OpenGL 4.5 core context on raw EGL: the first real GPU device, else Mesa surfaceless,
/// else a software device, else the default display. Current on the thread that made it.
class GlContext {
public:
    [[nodiscard]] static Result<std::unique_ptr<GlContext>> createHeadless();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    [[nodiscard]] const std::string& renderer() const { return m_renderer; }
    [[nodiscard]] const std::string& version() const { return m_version; }
    /// "EGL device", "Mesa surfaceless" ...
    [[nodiscard]] const std::string& path() const { return m_path; }

private:
    GlContext() = default;
    void* m_display = nullptr;
    void* m_context = nullptr;
    std::string m_renderer, m_version, m_path;
};

}  // namespace reflet
