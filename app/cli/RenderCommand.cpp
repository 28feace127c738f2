// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/PictureArguments.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/GlRender.h"
#include "app/pipeline/Render.h"
#include "core/base/Files.h"
#include "core/io/ImageFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace reflet::cli {

namespace {

Result<RenderOptions> optionsOf(const RenderArguments& arguments) {
    const auto picture = pictureArguments(arguments);
    if (!picture)
        return tl::unexpected(picture.error());
    RenderOptions options;
    options.width = picture->width;
    options.height = picture->height;
    options.method = picture->method;
    options.right = picture->right;
    options.wipe = picture->wipe;
    options.samplesPerEdge = arguments.samples;
    if (arguments.view.empty() && !arguments.all) {
        return fail(ErrorCode::Usage, "no view was named", "render",
                    "Give --view NAME, --all or --film.");
    }
    return options;
}

Result<std::vector<View>> chosenViews(const RenderArguments& arguments,
                                      const std::vector<View>& views) {
    if (views.empty()) {
        return fail(ErrorCode::Usage, "the project has neither views nor vehicles",
                    arguments.project,
                    "Add a vehicle: `reflet-cli edit P.reflet --route LINE.geojson --vehicle "
                    "tram1=tram,ROUTE`.");
    }
    if (arguments.all)
        return views;
    std::string known;
    for (const auto& view : views) {
        if (view.name == arguments.view)
            return std::vector<View>{view};
        known += (known.empty() ? "" : ", ") + view.name;
    }
    return fail(ErrorCode::Usage, "the project has no view of that name", arguments.view,
                "Its views are: " + known + ".");
}

/// The view's name as a file name: letters, digits, '-' and '_' only.
std::string fileNameOf(const std::string& name) {
    std::string out = name;
    std::replace_if(
        out.begin(), out.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '-');
    return out + ".png";
}

Result<DisplayImage> pictureOf(PreparedCity& city, const RemSet& rems, const Traffic& traffic,
                               const View& view, const RenderOptions& options, bool gl,
                               const JobContext& job) {
    const auto reflectors = traffic.at(view.time);
    const Camera camera = cameraOf(view, city.project().frame);
    if (gl)
        return renderPictureGl(city, rems, reflectors, camera, options, job);
    const auto picture = renderPicture(city, rems, reflectors, camera, options, job);
    if (!picture)
        return tl::unexpected(picture.error());
    return toDisplayImage(*picture, city.project().exposure);
}

}  // namespace

int run(const RenderArguments& arguments, const Console& console) {
    if (arguments.film)
        return runFilm(arguments, console);
    const auto options = optionsOf(arguments);
    if (!options)
        return console.failed(options.error());
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const std::vector<Diagnostic> remarks = city->remarks();
    for (const auto& remark : remarks)
        console.note(remark);
    const auto traffic = trafficOf(city->project(), city->folder());
    if (!traffic)
        return console.failed(traffic.error());
    const auto views = chosenViews(arguments, viewsOf(*city, *traffic));
    if (!views)
        return console.failed(views.error());
    LoadedRems rems;
    if (options->method != Method::RayTrace || options->right) {
        auto loaded = loadRems(*city, console.job());
        if (!loaded)
            return console.failed(loaded.error());
        rems = std::move(*loaded);
        for (const auto& failure : rems.failures)
            console.note(failure);
        if (rems.rems.empty())
            console.note(
                "The project has no baked probe: vehicles reflect nothing. Place some with "
                "`reflet-cli edit P.reflet --probes-every 15`.");
    }
    const std::filesystem::path output(arguments.output);
    if (arguments.all) {
        if (auto made = makeFolder(output); !made)
            return console.failed(made.error());
    }
    nlohmann::json written = nlohmann::json::array();
    for (const auto& view : *views) {
        const auto picture =
            pictureOf(*city, rems.rems, *traffic, view, *options, arguments.gl, console.job());
        if (!picture)
            return console.failed(picture.error());
        const auto path = arguments.all ? output / fileNameOf(view.name) : output;
        const auto saved = writePng(*picture, path);
        if (!saved)
            return console.failed(saved.error());
        written.push_back({{"view", view.name}, {"file", path.string()}});
        console.text(path.string());
    }
    // What came up while it was drawn: textures are read then.
    const std::vector<Diagnostic> all = city->remarks();
    for (std::size_t i = remarks.size(); i < all.size(); ++i)
        console.note(all[i]);
    if (console.json())
        console.data({{"pictures", written},
                      {"method", toString(options->method)},
                      {"right", options->right ? nlohmann::json(toString(*options->right))
                                               : nlohmann::json()}});
    return rems.failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
