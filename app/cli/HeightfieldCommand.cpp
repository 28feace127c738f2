// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/PreparedCity.h"
#include "core/io/GeoFile.h"
#include "core/project/ProjectFile.h"

#include <fmt/format.h>

namespace reflet::cli {

int run(const HeightfieldArguments& arguments, const Console& console) {
    auto project = loadProject(arguments.project);
    if (!project)
        return console.failed(project.error());
    if (arguments.cell) {
        if (!(*arguments.cell > 0.0)) {
            return console.failed(
                {ErrorCode::Usage, "the cell size must be positive", "--cell", "Take e.g. 1.", {}});
        }
        project->heightfield.cellSize = *arguments.cell;
    }
    const auto city = PreparedCity::prepare(*project, arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const int layers = arguments.layers == "n" ? 3 : std::stoi(arguments.layers);
    const auto written =
        writeHeightfield(city->heightfield(), project->frame, layers, arguments.output);
    if (!written)
        return console.failed(written.error());
    const GridSpec& grid = city->heightfield().grid;
    if (console.json()) {
        console.data({{"output", arguments.output},
                      {"columns", grid.columns},
                      {"rows", grid.rows},
                      {"cellSize", grid.cellSize},
                      {"layers", layers}});
    }
    console.text(fmt::format("{}: {} x {} cells of {} m, {} layers", arguments.output, grid.columns,
                             grid.rows, grid.cellSize, layers));
    return kDone;
}

}  // namespace reflet::cli
