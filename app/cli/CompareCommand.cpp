// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/CompareSpacings.h"
#include "app/pipeline/ContactSheet.h"
#include "core/base/Files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace reflet::cli {

namespace {

using nlohmann::json;

json number(const std::optional<double>& value) {
    return value ? json(*value) : json();
}

json toJson(const ImageFigures& f) {
    return {{"psnr", number(f.psnr)},
            {"ssim", number(f.ssim)},
            {"flip", number(f.flip)},
            {"meanError", f.meanError}};
}

json meanOf(const std::optional<TexelError>& error) {
    return error ? json(error->mean) : json();
}

json toJson(const std::optional<SurfaceFigures>& surfaces) {
    if (!surfaces) {
        return {{"wrongSurface", nullptr},  {"wrongSurfaceSeen", nullptr},
                {"texelError", nullptr},    {"texelErrorMedian", nullptr},
                {"texelErrorP95", nullptr}, {"algorithm", nullptr},
                {"model", nullptr}};
    }
    const SurfaceFigures& f = *surfaces;
    return {{"wrongSurface", f.wrong},
            {"wrongSurfaceSeen", number(f.wrongSeen)},
            {"texelError", meanOf(f.texelError)},
            {"texelErrorMedian", f.texelError ? json(f.texelError->median) : json()},
            {"texelErrorP95", f.texelError ? json(f.texelError->p95) : json()},
            {"algorithm",
             {{"wrongSurface", f.algorithmWrong}, {"texelError", meanOf(f.algorithmTexelError)}}},
            {"model", {{"wrongSurface", f.modelWrong}}}};
}

json toJson(const std::optional<PopFigures>& pop) {
    if (!pop)
        return {};
    return {{"perMetre", pop->perMetre},
            {"medianStep", pop->medianStep},
            {"largestStep", pop->largestStep},
            {"atChange", number(pop->atChange)},
            {"changes", pop->changes}};
}

json toJson(const MethodFigures& f) {
    json out = toJson(f.map);
    out.update(toJson(f.surfaces));
    out["pop"] = toJson(f.pop);
    out.update({{"milliseconds", f.milliseconds},
                {"quads", f.quads},
                {"rays", f.rays},
                {"uncovered", f.uncoveredShare},
                {"vehicle", toJson(f.vehicle)}});
    return out;
}

json methodsOf(const CompareReport& report) {
    json methods = json::object();
    for (const auto& [name, figures] : report.methods)
        methods[name] = toJson(figures);
    return methods;
}

json toJson(const CompareReport& report) {
    json pictures = json::array();
    for (const auto& picture : report.pictures)
        pictures.push_back(picture.string());
    return {{"poses", report.poses},
            {"maps", report.maps},
            {"methods", methodsOf(report)},
            {"pictures", pictures},
            {"remarks", cli::toJson(report.remarks)}};
}

std::string decibels(const std::optional<double>& value) {
    return value ? fmt::format("{:.2f}", *value) : "same";
}

std::string figure(const std::optional<double>& value) {
    return value ? fmt::format("{:.4f}", *value) : "same";
}

void printTable(const CompareReport& report, const Console& console) {
    console.text(fmt::format(
        "Against the ray-traced reference, {} local maps at {} poses:", report.maps, report.poses));
    console.text(
        fmt::format("{:10} {:>9} {:>8} {:>8} {:>8} {:>10} {:>9} {:>12} {:>9} {:>11} {:>10}",
                    "method", "PSNR dB", "SSIM", "FLIP", "error", "wrong", "texels", "on vehicle",
                    "FLIP", "uncovered", "ms a map"));
    for (const auto& [name, f] : report.methods) {
        const auto& surfaces = f.surfaces;
        console.text(fmt::format(
            "{:10} {:>9} {:>8} {:>8} {:>8.4f} {:>10} {:>9} {:>9} dB {:>9} {:>9.1f} % {:>10.2f}",
            name, decibels(f.map.psnr), figure(f.map.ssim), figure(f.map.flip), f.map.meanError,
            surfaces ? fmt::format("{:.2f} %", 100.0 * surfaces->wrong) : "-",
            surfaces && surfaces->texelError ? fmt::format("{:.2f}", surfaces->texelError->mean)
                                             : "-",
            decibels(f.vehicle.psnr), figure(f.vehicle.flip), 100.0 * f.uncoveredShare,
            f.milliseconds));
    }
}

void printPops(const CompareReport& report, const Console& console) {
    for (const auto& [name, f] : report.methods) {
        if (!f.pop)
            continue;
        const PopFigures& pop = *f.pop;
        console.text(fmt::format(
            "{:10} changes by {:.4f} a metre that the city does not; largest step {:.4f}, median "
            "{:.4f}; where probes change ({} times) {}",
            name, pop.perMetre, pop.largestStep, pop.medianStep, pop.changes,
            pop.atChange ? fmt::format("{:.1f} times the median", *pop.atChange) : "-"));
    }
}

json toJson(const std::vector<SpacingRow>& rows) {
    json spacings = json::array();
    json remarks = json::array();
    for (const SpacingRow& row : rows) {
        spacings.push_back({{"metres", row.metres},
                            {"probes", row.probes},
                            {"poses", row.report.poses},
                            {"maps", row.report.maps},
                            {"methods", methodsOf(row.report)}});
        for (const json& remark : cli::toJson(row.report.remarks))
            remarks.push_back(remark);
    }
    return {{"spacings", spacings}, {"remarks", remarks}};
}

/// What each further probe is worth, from one spacing to the next denser one.
void printWorth(const std::vector<SpacingRow>& rows, const std::string& method,
                const Console& console) {
    std::vector<const SpacingRow*> sorted;
    for (const SpacingRow& row : rows) {
        if (row.report.methods.contains(method))
            sorted.push_back(&row);
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const SpacingRow* a, const SpacingRow* b) { return a->probes < b->probes; });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const double before = sorted[i - 1]->report.methods.at(method).map.meanError;
        const double after = sorted[i]->report.methods.at(method).map.meanError;
        const std::size_t more = sorted[i]->probes - sorted[i - 1]->probes;
        if (more == 0 || !(before > 0.0))
            continue;
        console.text(fmt::format(
            "{}: from {:g} m to {:g} m, {} probes more change the error by {:+.1f} %: {:+.2f} % a "
            "probe",
            method, sorted[i - 1]->metres, sorted[i]->metres, more, 100.0 * (after / before - 1.0),
            100.0 * (after / before - 1.0) / double(more)));
    }
}

void printSpacings(const std::vector<SpacingRow>& rows, const Console& console) {
    console.text(fmt::format("{:>9} {:>7} {:10} {:>9} {:>8} {:>8} {:>9} {:>9} {:>9} {:>11}",
                             "every", "probes", "method", "PSNR dB", "FLIP", "error", "wrong",
                             "of seen", "texels", "uncovered"));
    const auto percent = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.2f} %", 100.0 * *value) : std::string("-");
    };
    for (const SpacingRow& row : rows) {
        for (const auto& [name, f] : row.report.methods) {
            const auto& s = f.surfaces;
            console.text(fmt::format(
                "{:>7g} m {:>7} {:10} {:>9} {:>8} {:>8.4f} {:>9} {:>9} {:>9} {:>9.1f} %",
                row.metres, row.probes, name, decibels(f.map.psnr), figure(f.map.flip),
                f.map.meanError, s ? percent(s->wrong) : "-", s ? percent(s->wrongSeen) : "-",
                s && s->texelError ? fmt::format("{:.2f}", s->texelError->mean) : "-",
                100.0 * f.uncoveredShare));
        }
    }
    printWorth(rows, toString(Method::Mem), console);
}

Result<CompareOptions> optionsOf(const CompareArguments& arguments) {
    CompareOptions options;
    options.poses = arguments.poses;
    options.methods.clear();
    for (const auto& name : splitList(arguments.methods)) {
        const auto method = methodFromString(name);
        if (!method)
            return tl::unexpected(method.error());
        options.methods.push_back(*method);
    }
    if (options.methods.empty())
        return fail(ErrorCode::Usage, "no method was given", "--methods",
                    "E.g. nearest,blend,box,mem.");
    options.drive = arguments.drive;
    if (arguments.output.empty())
        return options;
    options.output = arguments.output;
    if (auto made = makeFolder(arguments.output); !made)
        return tl::unexpected(made.error());
    return options;
}

int runSpacings(const PreparedCity& city, const CompareArguments& arguments,
                const CompareOptions& options, const Console& console) {
    const auto spacings = parseNumbers(arguments.spacings, 1, 100, "--spacings");
    if (!spacings)
        return console.failed(spacings.error());
    const auto rows = compareSpacings(city, arguments.project, *spacings, options, console.job());
    if (!rows)
        return console.failed(rows.error());
    const json document = toJson(*rows);
    if (options.output) {
        const auto written =
            writeFileAtomically(*options.output / "compare.json", document.dump(2) + "\n");
        if (!written)
            return console.failed(written.error());
    }
    if (console.json())
        console.data(document);
    bool remarked = false;
    for (const SpacingRow& row : *rows) {
        for (const auto& remark : row.report.remarks)
            console.note(remark);
        remarked = remarked || !row.report.remarks.empty();
    }
    printSpacings(*rows, console);
    return remarked ? kSomeFailed : kDone;
}

Result<void> writeReport(const std::filesystem::path& folder, const CompareReport& report,
                         const json& document, const std::string& title) {
    auto written = writeFileAtomically(folder / "compare.json", document.dump(2) + "\n");
    if (!written)
        return written;
    return writeFileAtomically(folder / "index.html", contactSheet(report, title));
}

}  // namespace

int run(const CompareArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    if (!arguments.spacings.empty())
        return runSpacings(*city, arguments, *options, console);
    const auto report = compareMethods(*city, *options, console.job());
    if (!report)
        return console.failed(report.error());
    const json document = toJson(*report);
    if (options->output) {
        const auto written = writeReport(
            *options->output, *report, document,
            "Reflections of " + std::filesystem::path(arguments.project).stem().string());
        if (!written)
            return console.failed(written.error());
    }
    if (console.json())
        console.data(document);
    for (const auto& remark : report->remarks)
        console.note(remark);
    printTable(*report, console);
    printPops(*report, console);
    return report->remarks.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
