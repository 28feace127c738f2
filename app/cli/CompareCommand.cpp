// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Compare.h"
#include "core/base/Files.h"

#include <fmt/format.h>

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

json toJson(const MethodFigures& f) {
    json out = toJson(f.map);
    out.update(toJson(f.surfaces));
    out.update({{"milliseconds", f.milliseconds},
                {"quads", f.quads},
                {"rays", f.rays},
                {"uncovered", f.uncoveredShare},
                {"vehicle", toJson(f.vehicle)}});
    return out;
}

json toJson(const CompareReport& report) {
    json methods = json::object();
    for (const auto& [name, figures] : report.methods)
        methods[name] = toJson(figures);
    json pictures = json::array();
    for (const auto& picture : report.pictures)
        pictures.push_back(picture.string());
    return {{"poses", report.poses},
            {"maps", report.maps},
            {"methods", methods},
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
    if (arguments.output.empty())
        return options;
    options.output = arguments.output;
    if (auto made = makeFolder(arguments.output); !made)
        return tl::unexpected(made.error());
    return options;
}

}  // namespace

int run(const CompareArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto report = compareMethods(*city, *options, console.job());
    if (!report)
        return console.failed(report.error());
    const json document = toJson(*report);
    if (options->output) {
        const auto written =
            writeFileAtomically(*options->output / "compare.json", document.dump(2) + "\n");
        if (!written)
            return console.failed(written.error());
    }
    if (console.json())
        console.data(document);
    for (const auto& remark : report->remarks)
        console.note(remark);
    printTable(*report, console);
    return report->remarks.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
