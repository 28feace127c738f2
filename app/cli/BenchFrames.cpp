// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/FrameBench.h"

#include <fmt/format.h>

#include <cstdio>

namespace reflet::cli {

namespace {

constexpr int kLargestEdge = 16384;

Result<FrameBenchOptions> optionsOf(const BenchArguments& arguments) {
    FrameBenchOptions options;
    char rest = 0;
    const int found =
        std::sscanf(arguments.size.c_str(), "%dx%d%c", &options.width, &options.height, &rest);
    const auto fits = [](int edge) { return edge >= 16 && edge <= kLargestEdge; };
    if (found != 2 || !fits(options.width) || !fits(options.height)) {
        return fail(ErrorCode::Usage, "\"" + arguments.size + "\" is no picture size", "--size",
                    fmt::format("Write it as 1280x720, each 16 to {}.", kLargestEdge));
    }
    options.scale = arguments.scale;
    options.frames = arguments.frames;
    options.framesPerSecond = arguments.framesPerSecond;
    return options;
}

nlohmann::json toJson(const FrameCosts& costs) {
    return {{"scale", costs.scale},
            {"median", costs.median},
            {"p95", costs.p95},
            {"cpu", costs.cpu},
            {"framesPerSecond", costs.median > 0.0 ? 1000.0 / costs.median : 0.0},
            {"city", costs.city},
            {"maps", costs.maps},
            {"vehicles", costs.vehicles},
            {"overlays", costs.overlays},
            {"triangles", costs.triangles},
            {"localMaps", costs.localMaps}};
}

void tell(const Console& console, const std::string& scene, const char* row,
          const FrameCosts& costs) {
    console.text(
        fmt::format("{:<9} {:<9} {:>5.2f} {:>8.1f} {:>8.1f} {:>7.1f} {:>7.1f} {:>7.1f} {:>8.1f} "
                    "{:>8.1f} {:>9}",
                    scene, row, costs.scale, costs.median, costs.p95, costs.cpu, costs.city,
                    costs.maps, costs.vehicles, costs.overlays, costs.triangles));
}

void tell(const Console& console, const FrameBenchReport& report) {
    console.text(report.renderer + "; milliseconds a picture");
    console.text(fmt::format("{:<9} {:<9} {:>5} {:>8} {:>8} {:>7} {:>7} {:>7} {:>8} {:>8} {:>9}",
                             "camera", "picture", "scale", "median", "p95", "cpu", "city", "maps",
                             "vehicles", "overlays", "triangles"));
    for (const FrameBenchScene& scene : report.scenes) {
        tell(console, scene.name, "full", scene.full);
        if (scene.scaled)
            tell(console, scene.name, "scaled", *scene.scaled);
        tell(console, scene.name, "adaptive", scene.adaptive);
        tell(console, scene.name, "still", scene.still);
    }
}

nlohmann::json toJson(const FrameBenchReport& report, const FrameBenchOptions& options) {
    nlohmann::json scenes = nlohmann::json::object();
    for (const FrameBenchScene& scene : report.scenes) {
        nlohmann::json& rows = scenes[scene.name];
        rows["full"] = toJson(scene.full);
        if (scene.scaled)
            rows["scaled"] = toJson(*scene.scaled);
        rows["adaptive"] = toJson(scene.adaptive);
        rows["still"] = toJson(scene.still);
    }
    return {{"renderer", report.renderer},
            {"size", {options.width, options.height}},
            {"frames", options.frames},
            {"scenes", scenes}};
}

}  // namespace

int runFrames(const BenchArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    const auto city = PreparedCity::open(arguments.files.front(), console.job());
    if (!city)
        return console.failed(city.error());
    const auto traffic = trafficOf(city->project(), city->folder());
    if (!traffic)
        return console.failed(traffic.error());
    const auto rems = loadRems(*city, console.job());
    if (!rems)
        return console.failed(rems.error());
    for (const auto& failure : rems->failures)
        console.note(failure);
    const auto report = benchFrames(*city, rems->rems, *traffic, *options, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report, *options));
    tell(console, *report);
    return rems->failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
