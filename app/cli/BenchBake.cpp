// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/BakeBench.h"
#include "core/base/Median.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

/// The middle one of the changes: probes that it left as they are, and its time.
struct Middle {
    double kept = 0.0;  ///< share of all probes
    double seconds = 0.0;
};

Middle middleOf(const BakeBenchReport& report) {
    std::vector<double> kept, seconds;
    for (const BakeBenchChange& change : report.changes) {
        kept.push_back(1.0 - double(change.baked) / double(report.probes));
        seconds.push_back(change.seconds);
    }
    return {median(std::move(kept)), median(std::move(seconds))};
}

nlohmann::json toJson(const BakeBenchReport& report) {
    nlohmann::json sizes = nlohmann::json::object(), changes = nlohmann::json::array();
    for (const BakeBenchSize& size : report.sizes) {
        sizes[std::to_string(size.resolution)] = {{"probes", size.probes},
                                                  {"milliseconds", size.milliseconds},
                                                  {"first", size.first},
                                                  {"noting", size.noting},
                                                  {"raysPerSecond", size.raysPerSecond}};
    }
    for (const BakeBenchChange& change : report.changes)
        changes.push_back({{"object", change.object},
                           {"baked", change.baked},
                           {"kept", report.probes - change.baked},
                           {"seconds", change.seconds}});
    const Middle middle = middleOf(report);
    return {{"threads", report.threads},
            {"triangles", report.triangles},
            {"cpu", sizes},
            {"project",
             {{"resolution", report.resolution},
              {"probes", report.probes},
              {"seconds", report.seconds},
              {"changes", changes},
              {"keptShare", middle.kept},
              {"changeSeconds", middle.seconds}}}};
}

void tell(const Console& console, const BakeBenchReport& report) {
    console.text(fmt::format("{} triangles, {} threads", report.triangles, report.threads));
    console.text(fmt::format("{:>10} {:>8} {:>12} {:>12} {:>12} {:>14}", "texels", "probes",
                             "ms a probe", "the first", "its notes", "million rays/s"));
    constexpr double kMillion = 1e6;
    for (const BakeBenchSize& size : report.sizes)
        console.text(fmt::format("{:>10} {:>8} {:>12.1f} {:>12.1f} {:>12.1f} {:>14.2f}",
                                 fmt::format("{}²", size.resolution), size.probes,
                                 size.milliseconds, size.first, size.noting,
                                 size.raysPerSecond / kMillion));
    console.text(fmt::format("the whole project, {} probes of {}²: {:.1f} s", report.probes,
                             report.resolution, report.seconds));
    for (const BakeBenchChange& change : report.changes)
        console.text(fmt::format("without {:.40}: {} baked again, {} kept, {:.2f} s", change.object,
                                 change.baked, report.probes - change.baked, change.seconds));
}

}  // namespace

int runBake(const BenchArguments& arguments, const Console& console) {
    const auto city = PreparedCity::open(arguments.files.front(), console.job());
    if (!city)
        return console.failed(city.error());
    const auto report = benchBake(*city, {}, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report));
    tell(console, *report);
    return kDone;
}

}  // namespace reflet::cli
