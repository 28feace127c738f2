// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/DrivenCity.h"

namespace reflet {

Result<DrivenCity> openDriven(const std::filesystem::path& projectFile, const JobContext& job) {
    auto city = PreparedCity::open(projectFile, job.phase("opening", 0.0, 0.2));
    if (!city)
        return tl::unexpected(city.error());
    auto traffic = trafficOf(city->project(), city->folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    auto rems = loadRems(*city, job.phase("reading probes", 0.2, 1.0));
    if (!rems)
        return tl::unexpected(rems.error());
    return DrivenCity{std::move(*city), std::move(*traffic), std::move(*rems)};
}

}  // namespace reflet
