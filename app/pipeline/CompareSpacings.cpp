// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/CompareSpacings.h"

#include "app/pipeline/Edit.h"

namespace reflet {

Result<std::vector<SpacingRow>> compareSpacings(const PreparedCity& city,
                                                const std::filesystem::path& projectFile,
                                                const std::vector<double>& spacings,
                                                const CompareOptions& options,
                                                const JobContext& job) {
    if (spacings.empty()) {
        return fail(ErrorCode::Usage, "no spacing was given", "--spacings",
                    "E.g. 10,15,25,40,80,140.");
    }
    CompareOptions withoutPictures = options;
    withoutPictures.drawVehicle = false;
    withoutPictures.output.reset();
    std::vector<SpacingRow> rows;
    for (std::size_t i = 0; i < spacings.size(); ++i) {
        const JobContext phase = job.phase("comparing", double(i) / double(spacings.size()),
                                           double(i + 1) / double(spacings.size()));
        Project project = city.project();
        project.probes.clear();
        const auto placed = placeProbesEvery(project, spacings[i]);
        if (!placed)
            return tl::unexpected(placed.error());
        const auto changed = city.updated(std::move(project), projectFile, phase);
        if (!changed)
            return tl::unexpected(changed.error());
        auto report = compareMethods(*changed, withoutPictures, phase);
        if (!report)
            return tl::unexpected(report.error());
        rows.push_back({spacings[i], *placed, std::move(*report)});
    }
    return rows;
}

}  // namespace reflet
