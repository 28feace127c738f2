// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Validate.h"

namespace reflet::cli {

int run(const ValidateArguments& arguments, const Console& console) {
    const auto report = validateProject(arguments.project);
    if (!report)
        return console.failed(report.error());
    if (console.json()) {
        console.data({{"project", arguments.project},
                      {"valid", report->valid},
                      {"findings", toJson(report->findings)}});
    }
    for (const auto& finding : report->findings)
        console.note(finding);
    console.text(arguments.project + (report->valid ? ": valid" : ": not valid"));
    return report->valid ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
