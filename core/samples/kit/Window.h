// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// How near somebody comes to it: the square itself, the tram's streets, those beyond.
enum class Detail { Low, Middle, High };

/// What stands over a window.
enum class Crown { None, Hood, Pediment };

struct WindowStyle {
    double width = 1.15;
    double height = 2.1;
    Paint wall = Paint::PlasterCream;
    Paint trim = Paint::Trim;
    Paint shutter = Paint::ShutterGreen;
    Paint shutterDark = Paint::ShutterGreenDark;
    bool shutters = true;
    bool surround = true;  ///< a moulded frame of stone
    Crown crown = Crown::None;
    Detail detail = Detail::Middle;
    int paneRows = 2;
};

/// The opening that a window of this style takes in its wall.
[[nodiscard]] Field windowOpening(const WindowStyle& style, double center, double sill);
/// Reveals, frame, panes, sill, surround, crown and shutters of a window in such an opening.
void window(Mesh& mesh, const Facade& f, double center, double sill, const WindowStyle& style,
            Random& random);
/// Frame and panes only, filling the field at depth w.
void glazing(Mesh& mesh, const Facade& f, const Field& field, double w, int columns, int rows,
             Paint frame, Random& random);

}  // namespace reflet::kit
