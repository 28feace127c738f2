// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/UpAxis.h"

#include "core/base/Files.h"

#include <algorithm>

namespace reflet::importers {

MeshAxes meshAxes(const Box& box, bool hasCrs, const ImportOptions& options,
                  std::vector<Diagnostic>& diagnostics) {
    MeshAxes axes;
    axes.unit = options.unit.value_or(1.0);
    if (!options.upAxis.empty() || hasCrs || box.empty()) {
        axes.yUp = options.upAxis == "y";
        return axes;
    }
    constexpr double kClearly = 0.6;  // of the next extent
    const glm::dvec3 size = box.size();
    axes.yUp = size.y < kClearly * std::min(size.x, size.z);
    const bool zUp = size.z < kClearly * std::min(size.x, size.y);
    if (axes.yUp && !zUp)
        diagnostics.push_back(
            {Severity::Info, "up-axis", "", "the model is lowest along y, which was taken as up",
             "If it stands on its side, import it with --up z, or say so where the "
             "window shows the model."});
    else if (!zUp)
        diagnostics.push_back(
            {Severity::Info, "up-axis", "", "the model does not show which axis is up; z was taken",
             "If it stands on its side, import it with --up y, or say so where the "
             "window shows the model."});
    return axes;
}

std::optional<std::string> crsBeside(const std::filesystem::path& path) {
    constexpr std::size_t kLongest = std::size_t(64) << 10;
    std::filesystem::path beside = path;
    beside.replace_extension(".prj");
    auto text = readFile(beside, kLongest);
    if (!text || text->find('[') == std::string::npos)
        return std::nullopt;
    return *std::move(text);
}

}  // namespace reflet::importers
