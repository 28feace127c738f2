// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The words in which the views of the city say what the user wants: widgets/common/EditIntents.h.

namespace reflet {

enum class ViewportTool { Navigate, PlaceProbe, DrawRoute };

/// Where a change that the user makes step by step stands. Begin comes once, with the first value
/// that differs; Move any number of times; then either End with the final value, which is one step
/// of undo, or Cancel, with the value from before. A change in one go is a lone End.
enum class DragPhase { Begin, Move, End, Cancel };

/// Metres above the ground where a new probe is put: the middle of a vehicle's body.
inline constexpr double kNewProbeHeight = 1.75;

}  // namespace reflet
