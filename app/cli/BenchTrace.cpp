// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/TraceBench.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

nlohmann::json toJson(const TraceRates& rates) {
    return {{"rays", rates.rays},
            {"heightfield", rates.heightfield},
            {"scalar", rates.scalar},
            {"embree",
             {{"single", rates.single}, {"packet8", rates.packet8}, {"packet16", rates.packet16}}},
            {"ratio", rates.ratio()}};
}

nlohmann::json toJson(const TraceThreads& rates) {
    nlohmann::json out = toJson(rates.all);
    out["oneThread"] = toJson(rates.one);
    return out;
}

nlohmann::json toJson(const TraceBenchReport& report) {
    nlohmann::json scenes = nlohmann::json::object();
    for (const TraceBenchScene& scene : report.scenes) {
        scenes[scene.name] = {{"triangles", scene.triangles},
                              {"compared", scene.compared},
                              {"mismatches", scene.mismatches},
                              {"vertices", toJson(scene.vertices)},
                              {"texels", toJson(scene.texels)}};
    }
    return {{"threads", report.threads}, {"scenes", scenes}};
}

void tell(const Console& console, const char* what, int threads, const TraceRates& rates) {
    console.text(
        fmt::format("  {:<8} {:>7} {:>9} {:>11.1f} {:>7.1f} {:>7.1f} {:>7.1f} {:>8.1f} {:>6.2f}",
                    what, threads, rates.rays, rates.heightfield, rates.scalar, rates.single,
                    rates.packet8, rates.packet16, rates.ratio()));
}

void tell(const Console& console, const TraceBenchReport& report) {
    console.text("million rays a second; ratio = heightfield / Embree's best");
    for (const TraceBenchScene& scene : report.scenes) {
        console.text(fmt::format("{}: {} triangles; of {} rays {} not as the plain walk's",
                                 scene.name, scene.triangles, scene.compared, scene.mismatches));
        console.text(fmt::format("  {:<8} {:>7} {:>9} {:>11} {:>7} {:>7} {:>7} {:>8} {:>6}", "rays",
                                 "threads", "count", "heightfield", "scalar", "single", "packet8",
                                 "packet16", "ratio"));
        tell(console, "vertices", report.threads, scene.vertices.all);
        tell(console, "vertices", 1, scene.vertices.one);
        tell(console, "texels", report.threads, scene.texels.all);
        tell(console, "texels", 1, scene.texels.one);
    }
}

}  // namespace

int runTrace(const BenchArguments& arguments, const Console& console) {
    TraceBenchOptions options;
    options.files.assign(arguments.files.begin(), arguments.files.end());
    options.poses = arguments.poses;
    options.checkedRays = arguments.checkedRays;
    const auto report = benchTrace(options, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report));
    tell(console, *report);
    for (const TraceBenchScene& scene : report->scenes) {
        if (scene.mismatches > 0)
            return kSomeFailed;
    }
    return kDone;
}

}  // namespace reflet::cli
