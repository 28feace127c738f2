// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/Traffic.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

#include <filesystem>

namespace reflet::cli {

namespace {

struct Place {
    std::string name;
    glm::dvec3 position;  ///< project frame
};

/// --at gives one place, --reflector one per body.
Result<std::vector<Place>> placesOf(const ReconstructArguments& arguments,
                                    const PreparedCity& city) {
    if (arguments.at.empty() == arguments.reflector.empty()) {
        return fail(ErrorCode::Usage, "no place was given", "reconstruct",
                    "Give --at E,N,U or --reflector ID.");
    }
    if (!arguments.at.empty()) {
        const auto numbers = parseNumbers(arguments.at, 3, 3, "--at");
        if (!numbers)
            return tl::unexpected(numbers.error());
        return std::vector<Place>{
            {"at", city.inFrame({(*numbers)[0], (*numbers)[1], (*numbers)[2]})}};
    }
    const auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    const auto index = traffic->find(arguments.reflector);
    if (!index)
        return tl::unexpected(index.error());
    const PlacedReflector placed = traffic->at(*index, arguments.time);
    std::vector<Place> places;
    for (std::size_t i = 0; i < placed.poses.size(); ++i) {
        places.push_back({fmt::format("{}-{}", placed.id, i + 1), placed.mapCenter(i)});
    }
    return places;
}

/// One body: the file itself. Several: the file's name with the body's number before the suffix.
std::filesystem::path outputOf(const std::string& output, std::size_t index, std::size_t count) {
    std::filesystem::path path(output);
    if (count == 1)
        return path;
    return path.parent_path() /
           fmt::format("{}-{}{}", path.stem().string(), index + 1, path.extension().string());
}

nlohmann::json statisticsOf(const LocalEnvironmentMap& map, const std::string& file) {
    const auto& s = map.statistics;
    return {{"file", file},           {"quads", s.quads},         {"rays", s.rays},
            {"vertices", s.vertices}, {"uncovered", s.uncovered}, {"milliseconds", s.milliseconds}};
}

}  // namespace

int run(const ReconstructArguments& arguments, const Console& console) {
    const auto method = methodFromString(arguments.method);
    if (!method)
        return console.failed(method.error());
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto places = placesOf(arguments, *city);
    if (!places)
        return console.failed(places.error());
    const auto rems = loadRems(*city, console.job());
    if (!rems)
        return console.failed(rems.error());
    for (const auto& failure : rems->failures)
        console.note(failure);
    std::shared_ptr<const RadianceScene> scene;
    if (*method == Method::RayTrace) {
        const auto made = city->scene(console.job());
        if (!made)
            return console.failed(made.error());
        scene = *made;
    }
    nlohmann::json maps = nlohmann::json::array();
    for (std::size_t i = 0; i < places->size(); ++i) {
        const Place& place = (*places)[i];
        const auto map =
            reconstruct(*city, rems->rems, scene.get(), *method, place.position, console.job());
        if (!map)
            return console.failed(map.error());
        const auto path = outputOf(arguments.output, i, places->size());
        const auto written =
            writeEnvironmentMap(place.name, place.position + city->project().frame.origin,
                                map->radiance, map->distance, path);
        if (!written)
            return console.failed(written.error());
        maps.push_back(statisticsOf(*map, path.string()));
        console.text(fmt::format("{}: {} quads, {} rays, {} of {} vertices uncovered, {:.1f} ms",
                                 path.string(), map->statistics.quads, map->statistics.rays,
                                 map->statistics.uncovered, map->statistics.vertices,
                                 map->statistics.milliseconds));
    }
    if (console.json())
        console.data({{"method", arguments.method}, {"maps", maps}});
    return rems->failures.empty() ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
