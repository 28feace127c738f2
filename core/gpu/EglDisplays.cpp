// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/EglDisplays.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>

namespace reflet {

namespace {

/// The entry points of EGL's extensions for displays; null where the library has none. They are
/// asked for even when the extension string keeps silent about them: set-ups with NVIDIA's library
/// alone are known to do so.
struct DisplayFunctions {
    PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;

    DisplayFunctions() {
        load(queryDevices, "eglQueryDevicesEXT");
        load(queryDeviceString, "eglQueryDeviceStringEXT");
        load(getPlatformDisplay, "eglGetPlatformDisplayEXT");
    }

private:
    template <class Function>
    static void load(Function& function, const char* name) {
        function = reinterpret_cast<Function>(eglGetProcAddress(name));
    }
};

std::vector<EGLDeviceEXT> devices(const DisplayFunctions& egl) {
    std::array<EGLDeviceEXT, 32> found{};
    EGLint count = 0;
    if (egl.queryDevices == nullptr ||
        egl.queryDevices(static_cast<EGLint>(found.size()), found.data(), &count) == EGL_FALSE)
        return {};
    return {found.begin(), found.begin() + count};
}

bool isSoftware(const DisplayFunctions& egl, EGLDeviceEXT device) {
    return egl.queryDeviceString != nullptr &&
           hasExtension(egl.queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

}  // namespace

bool hasExtension(const char* extensions, const char* name) {
    const std::size_t length = std::strlen(name);
    for (const char* at = extensions; at != nullptr && *at != '\0';) {
        const std::size_t word = std::strcspn(at, " ");
        if (word == length && std::strncmp(at, name, length) == 0)
            return true;
        at += word + std::strspn(at + word, " ");
    }
    return false;
}

std::vector<EglDisplayCandidate> eglDisplayCandidates() {
    std::vector<EglDisplayCandidate> candidates;
    const auto add = [&candidates](EGLDisplay display, const char* path) {
        if (display != EGL_NO_DISPLAY)
            candidates.push_back({display, path});
    };
    const DisplayFunctions egl;
    const auto addDevices = [&](bool software, const char* path) {
        for (EGLDeviceEXT device : devices(egl)) {
            if (isSoftware(egl, device) == software)
                add(egl.getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr), path);
        }
    };
    if (egl.getPlatformDisplay != nullptr) {
        addDevices(false, "EGL device");
        add(egl.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
            "Mesa surfaceless");
        addDevices(true, "EGL software device");
    }
    add(eglGetDisplay(EGL_DEFAULT_DISPLAY), "EGL default display");
    return candidates;
}

}  // namespace reflet
