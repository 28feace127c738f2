// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/coverage/SuggestBench.h"

#include <fmt/format.h>

namespace reflet::cli {

int runSuggest(const BenchArguments& arguments, const Console& console) {
    SuggestBenchOptions options;
    if (!arguments.files.empty())
        options.project = arguments.files.front();
    options.candidates = arguments.candidates;
    options.samples = arguments.samples;
    options.count = arguments.count;
    const auto report = benchSuggest(options, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json()) {
        console.data({{"seconds", report->seconds},
                      {"candidates", report->candidates},
                      {"samples", report->samples},
                      {"moveOne", report->moveOne},
                      {"probes", report->probes},
                      {"routes", report->routes},
                      {"triangles", report->triangles},
                      {"coverage", report->coverage},
                      {"ratio", report->ratio}});
    }
    console.text(
        fmt::format("{} probes among {} candidates for {} samples on {:.1f} km of routes: "
                    "{:.1f} s, coverage {:.1f} %, {:.1f} % of the bound",
                    report->probes, report->candidates, report->samples, report->routes / 1000.0,
                    report->seconds, 100.0 * report->coverage, 100.0 * report->ratio));
    console.text(fmt::format("moving one probe: {:.3f} s", report->moveOne));
    return kDone;
}

}  // namespace reflet::cli
