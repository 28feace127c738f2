// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Doctor.h"

#include <fmt/format.h>

namespace reflet::cli {

int run(const DoctorArguments&, const Console& console) {
    const DoctorReport report = runDoctor();
    if (console.json()) {
        nlohmann::json items = nlohmann::json::array();
        for (const auto& item : report.items) {
            items.push_back({{"name", item.name},
                             {"ok", item.ok},
                             {"found", item.found},
                             {"remedy", item.remedy}});
        }
        console.data(
            {{"version", report.version}, {"healthy", report.healthy()}, {"items", items}});
    }
    console.text("reflet-cli " + report.version);
    for (const auto& item : report.items) {
        console.text(
            fmt::format("{:8} {:12} {}", item.ok ? "ok" : "missing", item.name, item.found));
        if (!item.remedy.empty())
            console.text(fmt::format("{:21} {}", "", item.remedy));
    }
    return report.healthy() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
