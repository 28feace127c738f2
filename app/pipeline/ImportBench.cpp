// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ImportBench.h"

#include "app/pipeline/Import.h"
#include "app/pipeline/PreparedCity.h"
#include "core/base/Stopwatch.h"
#include "importers/FormatRegistry.h"
#include "importers/cityjson/CityJsonImporter.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <sys/resource.h>
#include <thread>

namespace reflet {

namespace {

std::size_t peakBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

/// File to project and city.
Result<ImportReport> readCity(const std::filesystem::path& file, const JobContext& job) {
    ImportRequest request;
    request.files = {file};
    return importProject(request, job);
}

/// Heightfield and what is drawn.
Result<void> prepareCity(ImportReport imported, const std::filesystem::path& file,
                         const JobContext& job) {
    const auto prepared =
        PreparedCity::prepare(std::move(imported.project), file.parent_path() / "bench.reflet", job,
                              {std::move(imported.city), true, false});
    if (!prepared)
        return tl::unexpected(prepared.error());
    if (auto drawn = prepared->drawn(job); !drawn)
        return tl::unexpected(drawn.error());
    return {};
}

/// Seconds from a request to cancel, `delay` seconds after the start, until all had returned;
/// nullopt when all was done before.
std::optional<double> secondsToCancel(const std::filesystem::path& file, double delay) {
    std::stop_source cancel;
    std::optional<Stopwatch> asked;
    {
        std::jthread timer([&](const std::stop_token& done) {
            std::mutex mutex;
            std::unique_lock lock(mutex);
            std::condition_variable_any wake;
            wake.wait_for(lock, done, std::chrono::duration<double>(delay), [] { return false; });
            if (done.stop_requested())
                return;
            asked.emplace();
            cancel.request_stop();
        });
        const JobContext job({}, cancel.get_token());
        if (auto imported = readCity(file, job))
            static_cast<void>(prepareCity(std::move(*imported), file, job));
    }
    return asked ? std::optional(asked->seconds()) : std::nullopt;
}

}  // namespace

Result<ImportBenchReport> benchImport(const std::filesystem::path& file, int cancels,
                                      const JobContext& job) {
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

    const Stopwatch importing;
    auto imported = readCity(file, job.phase("importing", 0.1, 0.6));
    if (!imported)
        return tl::unexpected(imported.error());
    step("import", importing);
    report.triangles = imported->city->city.triangles.size();

    const Stopwatch preparing;
    if (auto done = prepareCity(std::move(*imported), file, job.phase("preparing", 0.6, 1.0));
        !done)
        return tl::unexpected(done.error());
    step("prepare", preparing);
    report.peakBytes = peakBytes();
    for (int n = 0; n < cancels && !job.cancelled(); ++n) {
        const double share = (n + 0.5) / cancels;
        if (const auto seconds = secondsToCancel(file, share * report.total))
            report.cancels.emplace_back(share, *seconds);
    }
    return report;
}

}  // namespace reflet
