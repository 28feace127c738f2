// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/MemoryBench.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

nlohmann::json orNull(const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json toJson(const MemoryBenchReport& report) {
    return {{"maps", report.maps},
            {"texels", report.texels},
            {"plainBytes", report.plainBytes},
            {"compressedBytes", report.compressedBytes},
            {"milliseconds", report.milliseconds},
            {"psnr", orNull(report.decibels)},
            {"worstPsnr", orNull(report.worstDecibels)},
            {"distancesOff", report.offShare},
            {"validity",
             {{"texels", report.validity.texels},
              {"changedTexels", report.changedTexelShare()},
              {"changedDecisions", report.changedDecisionShare()}}}};
}

std::string decibels(const std::optional<double>& value) {
    return value ? fmt::format("{:.1f} dB", *value) : "no loss";
}

void tell(const Console& console, const MemoryBenchReport& report) {
    constexpr double kMega = 1e6;
    console.text(
        fmt::format("{} probes, {} texels: {:.2f} MB as half floats, {:.2f} MB compressed "
                    "({:.2f} bytes a texel)",
                    report.maps, report.texels, double(report.plainBytes) / kMega,
                    double(report.compressedBytes) / kMega,
                    double(report.compressedBytes) / double(report.texels)));
    console.text(fmt::format("radiance {}, the worst probe {}; {:.1f} ms to compress one",
                             decibels(report.decibels), decibels(report.worstDecibels),
                             report.milliseconds));
    console.text(fmt::format("distances off by more than 5 cm and 0.1 %: {:.2f} % of the texels",
                             100.0 * report.offShare));
    if (report.validity.texels > 0) {
        console.text(
            fmt::format("validity changes in {:.2f} % of {} texels of local maps, {:.2f} % "
                        "of {} decisions",
                        100.0 * report.changedTexelShare(), report.validity.texels,
                        100.0 * report.changedDecisionShare(), report.validity.decisions));
    }
}

}  // namespace

int runMemory(const BenchArguments& arguments, const Console& console) {
    const auto city = PreparedCity::open(arguments.files.front(), console.job());
    if (!city)
        return console.failed(city.error());
    const auto rems = loadRems(*city, console.job());
    if (!rems)
        return console.failed(rems.error());
    for (const auto& failure : rems->failures)
        console.note(failure);
    const auto report = benchMemory(*city, rems->rems, arguments.poses, console.job());
    if (!report)
        return console.failed(report.error());
    if (console.json())
        console.data(toJson(*report));
    tell(console, *report);
    return rems->failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
