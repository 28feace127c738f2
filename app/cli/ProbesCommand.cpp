// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/ProbeFiles.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

using nlohmann::json;

void tell(const ProbeImport& import, std::size_t read, bool dryRun, const Console& console) {
    if (console.json()) {
        console.data({{"read", read},
                      {"added", import.added},
                      {"withoutHeight", import.withoutHeight},
                      {"inSolids", import.inSolids},
                      {"written", !dryRun},
                      {"remarks", toJson(import.remarks)}});
    }
    for (const Diagnostic& remark : import.remarks)
        console.note(remark);
    console.text(fmt::format("{} of {} probes {}added", import.added.size(), read,
                             dryRun ? "would be " : ""));
    if (import.withoutHeight > 0)
        console.text(fmt::format("{} had no height and stand 1.75 m above the ground",
                                 import.withoutHeight));
}

int importProbes(const ProbesArguments& arguments, const Console& console) {
    if (arguments.file.empty())
        return console.failed({ErrorCode::Usage, "no file was named", "FILE",
                               "`reflet-cli probes import P.reflet PROBES.csv`"});
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    std::vector<Diagnostic> remarks;
    const auto read = readProbes(arguments.file, city->project().frame, remarks);
    if (!read)
        return console.failed(read.error());
    auto import = withProbes(*city, *read, arguments.movable, console.job());
    if (!import)
        return console.failed(import.error());
    import->remarks.insert(import->remarks.begin(), remarks.begin(), remarks.end());
    if (!arguments.dryRun && !import->added.empty()) {
        if (auto saved = saveProject(import->project, arguments.project); !saved)
            return console.failed(saved.error());
    }
    tell(*import, read->size(), arguments.dryRun, console);
    const bool whole =
        std::all_of(import->remarks.begin(), import->remarks.end(),
                    [](const Diagnostic& remark) { return remark.severity == Severity::Info; });
    return whole ? kDone : kSomeFailed;
}

int exportProbes(const ProbesArguments& arguments, const Console& console) {
    if (!arguments.file.empty() || arguments.outputs.empty())
        return console.failed({ErrorCode::Usage, "no file to write was named", "-o",
                               "`reflet-cli probes export P.reflet -o PROBES.csv`"});
    const auto project = loadProject(arguments.project);
    if (!project)
        return console.failed(project.error());
    for (const std::string& output : arguments.outputs)
        if (auto written = writeProbes(project->probes, project->frame, output); !written)
            return console.failed(written.error());
    if (console.json())
        console.data({{"probes", project->probes.size()}, {"files", arguments.outputs}});
    console.text(fmt::format("{} probes written", project->probes.size()));
    return kDone;
}

}  // namespace

int run(const ProbesArguments& arguments, const Console& console) {
    return arguments.action == "import" ? importProbes(arguments, console)
                                        : exportProbes(arguments, console);
}

}  // namespace reflet::cli
