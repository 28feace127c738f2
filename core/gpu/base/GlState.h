// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace reflet {

/// The state that every pass may count on and must leave: no depth, stencil, scissor or face test,
/// no blending, all masks open, cube maps filtered across their edges.
void resetGlState();

/// The same, and what OpenGL has at first where a pass may have changed it (clip control,
/// bindings): for those who draw after Reflet in the same context.
void restoreGlDefaults();

}  // namespace reflet
