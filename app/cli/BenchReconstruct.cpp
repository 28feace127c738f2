// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/DrivenCity.h"
#include "app/pipeline/ReconstructBench.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

nlohmann::json toJson(const ReconstructBenchReport& report) {
    nlohmann::json cases = nlohmann::json::object();
    for (const ReconstructCase& each : report.cases) {
        cases[each.name] = {{"ours", each.ours},
                            {"reference", each.reference},
                            {"ratio", each.ratio()},
                            {"rays", each.rays},
                            {"quads", each.quads}};
    }
    return {{"threads", report.threads},
            {"resolution", report.resolution},
            {"maps", report.maps},
            {"cases", cases}};
}

void tell(const Console& console, const ReconstructBenchReport& report) {
    console.text(fmt::format(
        "{} local maps of {} x {} texels a face, {} threads; traced anew with Embree: {:.1f} ms",
        report.maps, report.resolution, report.resolution, report.threads,
        report.cases.front().reference));
    console.text(fmt::format("{:<20} {:>9} {:>9} {:>9} {:>14}", "method", "ms a map", "rays",
                             "quads", "times as fast"));
    for (const ReconstructCase& each : report.cases) {
        console.text(fmt::format("{:<20} {:>9.2f} {:>9.0f} {:>9.0f} {:>14.1f}", each.name,
                                 each.ours, each.rays, each.quads, each.ratio()));
    }
}

}  // namespace

int runReconstruct(const BenchArguments& arguments, const Console& console) {
    const auto driven = openDriven(arguments.files.front(), console.job());
    if (!driven)
        return console.failed(driven.error());
    for (const auto& failure : driven->rems.failures)
        console.note(failure);
    const auto report = benchReconstruct(driven->city, driven->rems.rems, driven->traffic,
                                         arguments.poses, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report));
    tell(console, *report);
    return driven->rems.failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
