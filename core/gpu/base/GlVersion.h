// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

namespace reflet {

/// Whether the current context is OpenGL 4.5 core or above. ResourceLimit when it is not, telling
/// what it is and how to draw in software; Usage when no context is current.
[[nodiscard]] Result<void> requireOpenGl45();

/// Whether the current context draws without graphics hardware.
[[nodiscard]] bool contextDrawsInSoftware();

}  // namespace reflet
