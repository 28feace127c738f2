// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the 3D viewport and the plan have in common: they show the same things, offer the same tools
// and say in the same words what the user wants. Both emit these signals; positions are in the
// project frame, ids are UTF-8.
//
//   clicked(std::optional<ProjectItem>, bool extend)      nothing under the cursor: nullopt
//   probePlaced(glm::dvec3)                               the tool stays chosen
//   probeDragged(QString id, glm::dvec3, DragPhase)
//   routeDrawn(std::vector<glm::dvec3>)                   at least two points
//   routePointDragged(QString id, int index, glm::dvec3, DragPhase)
//   routePointInserted(QString id, int index, glm::dvec3, DragPhase)
//       before the handle `index`, counted in the route as it was before Begin
//   routePointRemoved(QString id, int index)
//   contextMenuAt(QPoint global, std::optional<ProjectItem>, glm::dvec3 ground)
//   toolChanged(ViewportTool)                             Escape leaves a tool

namespace reflet {

enum class ViewportTool { Navigate, PlaceProbe, DrawRoute };

/// Where a change that the user makes step by step stands. Begin comes once, with the first value
/// that differs; Move any number of times; then either End with the final value, which is one step
/// of undo, or Cancel, with the value from before. A change in one go is a lone End.
enum class DragPhase { Begin, Move, End, Cancel };

/// Metres above the ground where a new probe is put: the middle of a vehicle's body.
inline constexpr double kNewProbeHeight = 1.75;

}  // namespace reflet
