// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/pipeline/HeightfieldBench.h"

#include <fmt/format.h>

namespace reflet::cli {

int runHeightfield(const BenchArguments& arguments, const Console& console) {
    const auto report = benchHeightfield(arguments.triangles, arguments.cellSize, console.job());
    if (!report)
        return console.failed(report.error());
    const double ratio = report->reference / report->ours;
    if (console.json()) {
        console.data({{"triangles", report->triangles},
                      {"cells", report->cells},
                      {"ours", report->ours},
                      {"reference", report->reference},
                      {"ratio", ratio},
                      {"tooLow", report->tooLow}});
    }
    console.text(fmt::format(
        "{} triangles, {} cells: {:.2f} s; a ray down each centre {:.2f} s ({:.2f} times as long), "
        "and {:.2f} % of its cells are more than a metre too low",
        report->triangles, report->cells, report->ours, report->reference, ratio,
        100.0 * report->tooLow));
    return kDone;
}

}  // namespace reflet::cli
