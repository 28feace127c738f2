// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/WriteSample.h"

namespace reflet::cli {

int run(const SampleArguments& arguments, const Console& console) {
    const auto project = writeSample(arguments.name, arguments.seed, arguments.folder);
    if (!project)
        return console.failed(project.error());
    if (console.json())
        console.data({{"project", project->string()}});
    console.text(project->string());
    console.note("Next: reflet-cli render " + project->string() + " --all -o pictures");
    return kDone;
}

}  // namespace reflet::cli
