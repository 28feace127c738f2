// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/PictureArguments.h"
#include "app/pipeline/DrivenCity.h"
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
    const auto driven = openDriven(arguments.project, console.job());
    if (!driven)
        return console.failed(driven.error());
    for (const auto& failure : driven->rems.failures)
        console.note(failure);
    const auto film = renderFilm(driven->city, driven->rems.rems, driven->traffic, *options,
                                 arguments.output, console.job());
    if (!film)
        return console.failed(film.error());
    if (console.json()) {
        console.data({{"film", film->file.string()},
                      {"frames", film->frames},
                      {"encoded", std::filesystem::is_regular_file(film->file)}});
    }
    console.text(film->file.string());
    return driven->rems.failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
