// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/cli/PictureArguments.h"
#include "app/pipeline/DrivenCity.h"
#include "app/pipeline/FrameBench.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet::cli {

namespace {

Result<FrameBenchOptions> optionsOf(const BenchArguments& arguments) {
    const auto size = pictureSize(arguments.size);
    if (!size)
        return tl::unexpected(size.error());
    FrameBenchOptions options;
    options.width = size->x;
    options.height = size->y;
    options.scale = arguments.scale;
    options.frames = arguments.frames.value_or(options.frames);
    options.framesPerSecond = arguments.framesPerSecond;
    options.budget = arguments.budget;
    return options;
}

nlohmann::json toJson(const LodStatistics& lod) {
    if (!lod.on)
        return nullptr;
    return {{"coarse", lod.coarse},   {"allowed", lod.allowed}, {"full", lod.full},
            {"reduced", lod.reduced}, {"blended", lod.blended}, {"shared", lod.shared},
            {"waiting", lod.waiting}, {"hidden", lod.hidden}};
}

/// What lies outside all stages of the picture: the wait for its pixels most of all.
double restOf(const FrameCosts& costs) {
    const FrameStatistics& s = costs.worstStages;
    return std::max(0.0,
                    costs.worst - s.city - s.tracing - s.maps - s.inMaps - s.bodies - s.overlays);
}

nlohmann::json worstPicture(const FrameCosts& costs) {
    const FrameStatistics& s = costs.worstStages;
    return {{"number", costs.worstNumber}, {"city", s.city},
            {"tracing", s.tracing},        {"maps", s.maps},
            {"inMaps", s.inMaps},          {"vehicles", s.bodies},
            {"overlays", s.overlays},      {"rest", restOf(costs)},
            {"localMaps", s.localMaps},    {"levelOfDetail", toJson(s.lod)}};
}

nlohmann::json toJson(const FrameCosts& costs) {
    return {{"scale", costs.scale},
            {"median", costs.median},
            {"p95", costs.p95},
            {"p99", costs.p99},
            {"worst", costs.worst},
            {"worstPicture", worstPicture(costs)},
            {"cpu", costs.cpu},
            {"framesPerSecond", costs.median > 0.0 ? 1000.0 / costs.median : 0.0},
            {"city", costs.city},
            {"tracing", costs.tracing},
            {"maps", costs.maps},
            {"inMaps", costs.inMaps},
            {"vehicles", costs.vehicles},
            {"overlays", costs.overlays},
            {"triangles", costs.triangles},
            {"localMaps", costs.localMaps},
            {"levelOfDetail", toJson(costs.lod)}};
}

std::string toText(const LodStatistics& lod) {
    if (!lod.on)
        return "-";
    return fmt::format("{} ({:.1f} ms) {}/{}/{} {}/{}/{}", lod.coarse, lod.allowed, lod.full,
                       lod.reduced, lod.blended, lod.shared, lod.waiting, lod.hidden);
}

void tell(const Console& console, const std::string& scene, const char* row,
          const FrameCosts& costs) {
    console.text(
        fmt::format("{:<9} {:<9} {:>5.2f} {:>7.1f} {:>7.1f} {:>7.1f} {:>7.1f} {:>6.1f} "
                    "{:>7.1f} {:>6.1f} {:>7.1f} {:>8.1f} {:>8.1f} {:>5}  {}",
                    scene, row, costs.scale, costs.median, costs.p99, costs.worst, costs.cpu,
                    costs.city, costs.tracing, costs.maps, costs.inMaps, costs.vehicles,
                    costs.overlays, costs.localMaps, toText(costs.lod)));
}

/// Where the time of the worst picture went.
void tellWorst(const Console& console, const FrameCosts& costs) {
    const FrameStatistics& s = costs.worstStages;
    console.text(
        fmt::format("{:<19} {:>5} {:>7} {:>7} {:>7.1f} {:>7} {:>6.1f} {:>7.1f} {:>6.1f} {:>7.1f} "
                    "{:>8.1f} {:>8.1f} {:>5}  {}; rest {:.1f}",
                    fmt::format("  worst: number {}", costs.worstNumber + 1), "", "", "",
                    costs.worst, "", s.city, s.tracing, s.maps, s.inMaps, s.bodies, s.overlays,
                    s.localMaps, toText(s.lod), restOf(costs)));
}

void tell(const Console& console, const FrameBenchReport& report) {
    console.text(fmt::format("{}; milliseconds a picture, budget {:.1f} ms", report.renderer,
                             report.budget));
    console.text(
        fmt::format("{:<9} {:<9} {:>5} {:>7} {:>7} {:>7} {:>7} {:>6} {:>7} {:>6} {:>7} "
                    "{:>8} {:>8} {:>5}  {}",
                    "camera", "picture", "scale", "median", "p99", "worst", "cpu", "city",
                    "tracing", "maps", "in maps", "vehicles", "overlays", "drawn",
                    "coarse (allowed) full/reduced/blended shared/waiting/hidden"));
    for (const FrameBenchScene& scene : report.scenes) {
        tell(console, scene.name, "full", scene.full);
        tellWorst(console, scene.full);
        tell(console, scene.name, "no LOD", scene.plain);
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
        rows["plain"] = toJson(scene.plain);
        if (scene.scaled)
            rows["scaled"] = toJson(*scene.scaled);
        rows["adaptive"] = toJson(scene.adaptive);
        rows["still"] = toJson(scene.still);
    }
    return {{"renderer", report.renderer},
            {"size", {options.width, options.height}},
            {"frames", options.frames},
            {"budget", report.budget},
            {"scenes", scenes}};
}

}  // namespace

int runFrames(const BenchArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    const auto driven = openDriven(arguments.files.front(), console.job());
    if (!driven)
        return console.failed(driven.error());
    for (const auto& failure : driven->rems.failures)
        console.note(failure);
    const auto report =
        benchFrames(driven->city, driven->rems.rems, driven->traffic, *options, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report, *options));
    tell(console, *report);
    return driven->rems.failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
