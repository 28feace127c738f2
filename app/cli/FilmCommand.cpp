// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/PictureArguments.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/Film.h"

namespace reflet::cli {

namespace {

Result<FilmOptions> optionsOf(const RenderArguments& arguments) {
    const auto picture = pictureArguments(arguments);
    if (!picture)
        return tl::unexpected(picture.error());
    FilmOptions options;
    options.width = picture->width;
    options.height = picture->height;
    options.method = picture->method;
    options.right = picture->right;
    options.wipe = picture->wipe;
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
    const auto film =
        renderFilm(*city, rems->rems, *traffic, *options, arguments.output, console.job());
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
