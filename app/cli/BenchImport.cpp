// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/ImportBench.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet::cli {

int runImport(const BenchArguments& arguments, const Console& console) {
    const auto report = benchImport(arguments.files.front(), arguments.cancels, console.job());
    if (!report)
        return console.failed(report.error());
    const double ratio = report->parse ? report->total / *report->parse : 0.0;
    if (console.json()) {
        nlohmann::json steps = nlohmann::json::object();
        for (const ImportStep& step : report->steps)
            steps[step.name] = {{"seconds", step.seconds}, {"cpu", step.cpu}};
        nlohmann::json out{{"format", report->format},
                           {"bytes", report->bytes},
                           {"triangles", report->triangles},
                           {"ours", report->total},
                           {"reference", nullptr},
                           {"ratio", nullptr},
                           {"steps", steps},
                           {"peakBytes", report->peakBytes}};
        for (const auto& [share, seconds] : report->cancels)
            out["cancels"].push_back({{"share", share}, {"seconds", seconds}});
        if (report->parse) {
            out["reference"] = *report->parse;
            out["ratio"] = ratio;
        }
        console.data(out);
    }
    constexpr double kMega = 1e6;
    console.text(fmt::format("{}, {:.1f} MB, {} triangles", report->format,
                             double(report->bytes) / kMega, report->triangles));
    for (const ImportStep& step : report->steps)
        console.text(fmt::format("  {:<10} {:>7.2f} s, {:.2f} s of processor time", step.name,
                                 step.seconds, step.cpu));
    console.text(fmt::format("  {:<10} {:>7.2f} s, at most {:.0f} MB", "all", report->total,
                             double(report->peakBytes) / kMega));
    if (report->parse)
        console.text(fmt::format("  {:<10} {:>7.2f} s; all takes {:.1f} times as long",
                                 "parse alone", *report->parse, ratio));
    const auto longest =
        std::max_element(report->cancels.begin(), report->cancels.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (longest != report->cancels.end())
        console.text(fmt::format("  {:<10} {:>7.2f} s at most, of {} times; after {:.0f} % of all",
                                 "cancel", longest->second, report->cancels.size(),
                                 100.0 * longest->first));
    return kDone;
}

}  // namespace reflet::cli
