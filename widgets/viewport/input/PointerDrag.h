// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/camera/ViewGeometry.h"

#include <glm/vec2.hpp>

namespace reflet {

/// Where the mouse is, in pixels of the widget, and what is held down with it.
struct Pointer {
    glm::dvec2 pixel{0.0};
    bool shift = false;
    bool alt = false;
};

/// What goes on between pressing a mouse button and letting it go.
class PointerDrag {
public:
    PointerDrag() = default;
    virtual ~PointerDrag() = default;
    PointerDrag(const PointerDrag&) = delete;
    PointerDrag& operator=(const PointerDrag&) = delete;

    virtual void move(const ViewGeometry& view, const Pointer& pointer) = 0;
    virtual void end() {}
    virtual void cancel() {}
};

}  // namespace reflet
