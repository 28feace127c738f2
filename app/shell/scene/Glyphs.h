// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/Selection.h"
#include "core/gpu/Frame.h"
#include "core/project/Project.h"

#include <functional>
#include <string>
#include <vector>

namespace reflet {

/// How the probes and routes of a project are shown in the picture and on the plan: positions in
/// the project frame.
[[nodiscard]] std::vector<ProbeGlyph> probeGlyphs(
    const Project& project, const Selection& selection,
    const std::function<ProbeState(const std::string&)>& stateOf, bool previewSelected);
[[nodiscard]] std::vector<RouteGlyph> routeGlyphs(const Project& project,
                                                  const Selection& selection);

/// The box around the items, in the frame; empty when none of them has a place.
[[nodiscard]] Box boxOf(const Project& project, const std::vector<ProjectItem>& items);

}  // namespace reflet
