// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ImportBench.h"

#include "app/pipeline/Import.h"
#include "app/pipeline/PreparedCity.h"
#include "core/base/Stopwatch.h"
#include "importers/FormatRegistry.h"
#include "importers/cityjson/CityJsonImporter.h"

#include <sys/resource.h>

namespace reflet {

namespace {

std::size_t peakBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace

Result<ImportBenchReport> benchImport(const std::filesystem::path& file, const JobContext& job) {
    const auto format = cityFormatOf(file);
    if (!format)
        return tl::unexpected(format.error());
    ImportBenchReport report;
    report.format = (*format)->name;
    std::error_code ignored;
    report.bytes = std::filesystem::file_size(file, ignored);
    if (report.format == "CityJSON") {
        const Stopwatch watch;
        if (auto parsed = parseCityJson(file, job.phase("parsing alone", 0.0, 0.1)); !parsed)
            return tl::unexpected(parsed.error());
        report.parse = watch.seconds();
    }
    const auto step = [&](const char* name, const Stopwatch& watch) {
        report.steps.push_back({name, watch.seconds(), watch.cpuSeconds()});
        report.total += report.steps.back().seconds;
    };

    ImportRequest request;
    request.files = {file};
    const Stopwatch importing;
    auto imported = importProject(request, job.phase("importing", 0.1, 0.6));
    if (!imported)
        return tl::unexpected(imported.error());
    step("import", importing);
    report.triangles = imported->city->city.triangles.size();

    const Stopwatch preparing;
    const auto prepared = PreparedCity::prepare(
        std::move(imported->project), file.parent_path() / "bench.reflet",
        job.phase("preparing", 0.6, 1.0), {std::move(imported->city), true, false});
    if (!prepared)
        return tl::unexpected(prepared.error());
    if (auto drawn = prepared->drawn(job); !drawn)
        return tl::unexpected(drawn.error());
    step("prepare", preparing);
    report.peakBytes = peakBytes();
    return report;
}

}  // namespace reflet
