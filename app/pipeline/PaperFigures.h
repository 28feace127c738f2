// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/environment/ImageMetrics.h"

#include <filesystem>
#include <vector>

namespace reflet {

/// Which pictures were drawn, and what stands in for another with the reason.
struct PaperFigures {
    std::vector<std::filesystem::path> pictures;
    std::vector<Diagnostic> remarks;
};

/// Draws figures 4, 7, 8 and 9 of Meyer & Loscos 2003 for a project, into a folder that exists:
///
/// - figure-4-heightfield.png: the heights of the city from above, higher is lighter.
/// - figure-7-mesh.png: what the first vehicle sees ahead, with the quads of the adaptive mesh.
/// - figure-8-placement.png: heights with the routes (blue) and the probes (red).
/// - figure-9a-blend.png, -9b-rerender.png, -9c-mem.png: the vehicle by two maps blended, by six
///   faces drawn anew and by the method of the paper. Without OpenGL, ray traced in place of 9b.
///
/// Usage when the project has no vehicle or no probe.
[[nodiscard]] Result<PaperFigures> drawPaperFigures(const PreparedCity& city,
                                                    const std::filesystem::path& folder,
                                                    const JobContext& job);

/// Heights from above, north up, one pixel for each cell or for each block of cells where there
/// are more than `most` along an edge (the highest of a block counts). Grey from black (lowest) to
/// white; missing cells black.
[[nodiscard]] DisplayImage heightPicture(const Heightfield& field, int most);

}  // namespace reflet
