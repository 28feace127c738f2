// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/UpdateSource.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet::cli {

namespace {

const char* verbOf(AffectedProbe::Why why) {
    switch (why) {
        case AffectedProbe::Why::Sees:
            return "sees";
        case AffectedProbe::Why::Lit:
            return "shows what takes light or shadow from";
        case AffectedProbe::Why::Near:
            break;
    }
    return "stands near";
}

std::string detailsOf(const ObjectChange& change) {
    std::string details;
    const auto add = [&](bool really, const char* what) {
        if (really)
            details += fmt::format("{}{}", details.empty() ? ": " : ", ", what);
    };
    add(change.geometry, "geometry");
    add(change.appearance, "appearance");
    add(change.description, "type or parent");
    add(change.attributes, "attributes");
    return details;
}

void print(const SourceUpdate& update, const Console& console) {
    using enum ObjectChange::Kind;
    if (update.sameFile) {
        console.text("Nothing has changed: the file is the one that the project has.");
        return;
    }
    const CityChanges& changes = update.changes;
    console.text(fmt::format("{} -> {}: {} added, {} removed, {} changed, {} as they were",
                             update.model, update.file, changes.count(Added),
                             changes.count(Removed), changes.count(Changed), changes.unchanged));
    constexpr std::size_t kShown = 20;
    for (std::size_t i = 0; i < std::min(kShown, changes.objects.size()); ++i) {
        const ObjectChange& change = changes.objects[i];
        console.text(fmt::format("  {:<8} {} ({}){}", toString(change.kind), change.id, change.type,
                                 detailsOf(change)));
    }
    if (changes.objects.size() > kShown)
        console.note(fmt::format("... and {} more; --json lists them all.",
                                 changes.objects.size() - kShown));
    for (const AffectedProbe& probe : update.probes)
        console.text(fmt::format("  probe {} {} {}", probe.id, verbOf(probe.why), probe.object));
}

}  // namespace

int run(const UpdateArguments& arguments, const Console& console) {
    const auto before =
        PreparedCity::open(arguments.project, console.job().phase("opening", 0.0, 0.5));
    if (!before)
        return console.failed(before.error());
    const auto update = updateSource(*before, arguments.model, arguments.file,
                                     console.job().phase("comparing", 0.5, 1.0));
    if (!update)
        return console.failed(update.error());
    const bool writes = !arguments.dryRun && !update->sameFile;
    if (writes) {
        if (const auto saved = saveProject(update->project, arguments.project); !saved)
            return console.failed(saved.error());
    }
    if (console.json()) {
        nlohmann::json out = updateJson(*update);
        out["project"] = arguments.project;
        out["written"] = writes;
        out["diagnostics"] = toJson(update->diagnostics);
        console.data(out);
        return kDone;
    }
    print(*update, console);
    if (writes)
        console.note(
            fmt::format("Probes and routes are kept. Next: reflet-cli bake {}; probes that depend "
                        "on nothing of "
                        "what has changed keep their pictures.",
                        arguments.project));
    return kDone;
}

}  // namespace reflet::cli
