// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Bake.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>

#include <cstdio>

namespace reflet::cli {

namespace {

Result<BakeOptions> optionsOf(const BakeArguments& arguments) {
    BakeOptions options;
    options.only = splitList(arguments.only);
    options.baker = arguments.backend == "gl" ? Baker::OpenGl : Baker::Rays;
    char rest = 0;
    if (std::sscanf(arguments.shard.c_str(), "%d/%d%c", &options.shardIndex, &options.shardCount,
                    &rest) != 2) {
        return fail(ErrorCode::Usage, "\"" + arguments.shard + "\" is not understood", "--shard",
                    "Write it as I/N, e.g. 1/4.");
    }
    return options;
}

void printReport(const BakeReport& report, const Console& console) {
    if (console.json()) {
        console.data({{"probes", report.probes},
                      {"baked", report.baked},
                      {"reused", report.reused},
                      {"kept", report.kept},
                      {"seconds", report.seconds},
                      {"raysPerSecond", report.raysPerSecond},
                      {"bytes", report.bytes},
                      {"failures", toJson(report.failures)}});
    }
    for (const auto& failure : report.failures)
        console.note(failure);
    console.text(fmt::format(
        "{} probes: {} baked, {} reused, {} kept (they see nothing of what changed), {} "
        "refused in {:.1f} s; {:.1f} MB on disk",
        report.probes, report.baked, report.reused, report.kept, report.failures.size(),
        report.seconds, double(report.bytes) / 1e6));
}

}  // namespace

int run(const BakeArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    auto project = loadProject(arguments.project);
    if (!project)
        return console.failed(project.error());
    if (arguments.resolution) {
        if (*arguments.resolution < 32 || *arguments.resolution > 2048) {
            return console.failed({ErrorCode::Usage,
                                   "the resolution is out of range",
                                   "--resolution",
                                   "Take 32 to 2048.",
                                   {}});
        }
        project->bake.resolution = *arguments.resolution;
    }
    auto city = PreparedCity::prepare(*project, arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto report = bakeProbes(*city, *options, console.job());
    if (!report)
        return console.failed(report.error());
    printReport(*report, console);
    return report->failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
