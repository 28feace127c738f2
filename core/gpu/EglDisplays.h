// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace reflet {

/// A place where EGL may give a context without a window.
struct EglDisplayCandidate {
    void* display = nullptr;  ///< an EGLDisplay, not yet initialised; never EGL_NO_DISPLAY
    std::string path;         ///< how it was found, for people
};

/// All such places of this machine, best first: devices with a GPU, Mesa surfaceless, devices in
/// software, the default display. Empty when EGL knows none.
[[nodiscard]] std::vector<EglDisplayCandidate> eglDisplayCandidates();

/// Whether a list of extensions, separated by spaces, names this one. The list may be null.
[[nodiscard]] bool hasExtension(const char* extensions, const char* name);

}  // namespace reflet
