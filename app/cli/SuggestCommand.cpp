// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/DemandOptions.h"
#include "app/pipeline/ProbeFiles.h"
#include "app/pipeline/coverage/CoverageJson.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace reflet::cli {

namespace {

SuggestOptions optionsOf(const SuggestArguments& arguments) {
    SuggestOptions options;
    take(arguments.demand, options);
    options.coverage = arguments.coverage;
    options.count = arguments.count;
    options.most = std::max(options.most, arguments.count.value_or(0));
    options.spacing = arguments.spacing;
    options.leastGain = arguments.leastGain;
    options.afresh = arguments.afresh;
    options.baselines = !arguments.noBaselines;
    return options;
}

std::string share(const std::optional<double>& value) {
    return value ? fmt::format("{:.1f} %", 100.0 * *value) : std::string("-");
}

void tellProbes(const Suggestion& suggestion, const Console& console) {
    for (const SuggestedProbe& probe : suggestion.probes) {
        console.text(fmt::format("{:<6} {:>12.2f} {:>12.2f} {:>8.2f}  {:>+6.2f} %  {}", probe.id,
                                 probe.position.x, probe.position.y, probe.position.z,
                                 100.0 * probe.gain, probe.reason));
    }
}

void tellBaselines(const Suggestion& suggestion, const Console& console) {
    const Suggestion::Baselines& other = suggestion.baselines;
    console.text(fmt::format(
        "as many probes elsewhere: evenly spaced {}, at junctions {}{}, by "
        "chance {}",
        share(other.uniform), share(other.junctions),
        other.junctionCount > 0 ? fmt::format(" ({} of them)", other.junctionCount) : "",
        share(other.random)));
    if (other.uniformCount)
        console.text(
            fmt::format("even spacing needs {} probes for the same coverage", *other.uniformCount));
}

void tell(const Suggestion& suggestion, const SuggestArguments& arguments, const Console& console) {
    for (const Diagnostic& remark : suggestion.remarks)
        console.note(remark);
    console.text(certificateSentence(suggestion));
    tellProbes(suggestion, console);
    console.text(
        fmt::format("coverage {:.1f} % before, {:.1f} % ± {:.1f} % after, on samples of "
                    "their own; shown {:.1f} %; worst stretch {:.1f} %, a twentieth below "
                    "{:.1f} %",
                    100.0 * suggestion.before.mean, 100.0 * suggestion.after.mean,
                    100.0 * suggestion.after.error, 100.0 * suggestion.shown,
                    100.0 * suggestion.worst, 100.0 * suggestion.p05));
    if (!arguments.noBaselines)
        tellBaselines(suggestion, console);
    for (const ProbeMove& move : suggestion.moves)
        console.text(fmt::format("moving {} to {:.2f}, {:.2f}, {:.2f} would gain {:.2f} %", move.id,
                                 move.to.x, move.to.y, move.to.z, 100.0 * move.gain));
    if (!suggestion.reached)
        console.note("What was asked for was not reached; this is the best that was found.");
}

/// With --afresh the suggestion stands in the place of what is not locked.
Project changed(Project project, const Suggestion& suggestion, bool afresh) {
    if (afresh)
        std::erase_if(project.probes, [](const Probe& probe) { return !probe.locked; });
    return withSuggested(std::move(project), suggestion);
}

Result<void> checkOutputs(const std::vector<std::string>& outputs) {
    const auto known = {".csv", ".json", ".geojson", ".gpkg"};
    for (const std::string& output : outputs)
        if (std::find(known.begin(), known.end(),
                      std::filesystem::path(output).extension().string()) == known.end())
            return fail(ErrorCode::Usage, "is in no form that probes are written in", output,
                        "End it in .csv, .geojson, .gpkg or .json.");
    return {};
}

Result<void> write(const PreparedCity& city, const Suggestion& suggestion,
                   const SuggestArguments& arguments) {
    Project none = city.project();
    none.probes.clear();
    const std::vector<Probe> probes = withSuggested(std::move(none), suggestion).probes;
    for (const std::string& output : arguments.outputs)
        if (auto written = writeProbes(probes, city.project().frame, output); !written)
            return written;
    if (!arguments.write || (suggestion.probes.empty() && !arguments.afresh))
        return {};
    return saveProject(changed(city.project(), suggestion, arguments.afresh), arguments.project);
}

}  // namespace

int run(const SuggestArguments& arguments, const Console& console) {
    if (auto sound = checkOutputs(arguments.outputs); !sound)
        return console.failed(sound.error());
    if (!arguments.coverage && !arguments.count)
        return console.failed({ErrorCode::Usage, "neither a coverage nor a count was asked for",
                               "suggest", "Say --coverage 0.95 or --count 27."});
    const auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto suggestion = suggestProbes(*city, optionsOf(arguments), console.job());
    if (!suggestion)
        return console.failed(suggestion.error());
    if (auto written = write(*city, *suggestion, arguments); !written)
        return console.failed(written.error());
    if (console.json())
        console.data(suggestionJson(*suggestion, city->project()));
    tell(*suggestion, arguments, console);
    return suggestion->reached ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
