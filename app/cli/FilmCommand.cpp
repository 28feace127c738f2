// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/Film.h"

#include <fmt/format.h>

#include <cstdio>

namespace reflet::cli {

namespace {

Result<FilmOptions> optionsOf(const RenderArguments& arguments) {
    FilmOptions options;
    char rest = 0;
    if (std::sscanf(arguments.size.c_str(), "%dx%d%c", &options.width, &options.height, &rest) !=
        2) {
        return fail(ErrorCode::Usage, "\"" + arguments.size + "\" is no picture size", "--size",
                    "Write it as 1920x1080.");
    }
    const auto method = methodFromString(arguments.method);
    if (!method)
        return tl::unexpected(method.error());
    if (*method == Method::RayTrace) {
        return fail(ErrorCode::Usage, "films are drawn with OpenGL, not ray traced", "--method",
                    "Take another method, or draw views without --film.");
    }
    options.method = *method;
    options.seconds = arguments.seconds;
    options.framesPerSecond = arguments.framesPerSecond;
    options.reflector = arguments.reflector;
    return options;
}

}  // namespace

int runFilm(const RenderArguments& arguments, const Console& console) {
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    const auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto traffic = trafficOf(city->project(), city->folder());
    if (!traffic)
        return console.failed(traffic.error());
    const auto rems = loadRems(*city, console.job());
    if (!rems)
        return console.failed(rems.error());
    for (const auto& failure : rems->failures)
        console.note(failure);
    auto ambient = city->ambient(console.job());
    if (!ambient)
        return console.failed(ambient.error());
    const auto film = renderFilm(*city, rems->rems, *traffic, *ambient, *options, arguments.output,
                                 console.job());
    if (!film)
        return console.failed(film.error());
    if (console.json()) {
        console.data({{"film", film->file.string()},
                      {"frames", film->frames},
                      {"encoded", std::filesystem::is_regular_file(film->file)}});
    }
    console.text(film->file.string());
    return rems->failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
