// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/WithoutTrees.h"

#include <memory>
#include <set>

namespace reflet {

namespace {

bool isTree(const CityModel& city, const CityTriangle& triangle) {
    return city.objects[city.surfaces[triangle.surface].object].type ==
           CityObjectType::SolitaryVegetation;
}

}  // namespace

TreeCount treesOf(const CityModel& city) {
    TreeCount count;
    std::set<std::uint32_t> objects;
    for (const CityTriangle& triangle : city.triangles) {
        if (!isTree(city, triangle))
            continue;
        ++count.triangles;
        objects.insert(city.surfaces[triangle.surface].object);
    }
    count.objects = objects.size();
    return count;
}

LoadedCity withoutTrees(const LoadedCity& city) {
    LoadedCity bare = city;
    const CityModel& all = city.city;
    bare.city.triangles.clear();
    bare.city.uv.clear();
    for (std::size_t i = 0; i < all.triangles.size(); ++i) {
        if (isTree(all, all.triangles[i]))
            continue;
        bare.city.triangles.push_back(all.triangles[i]);
        if (!all.uv.empty())
            bare.city.uv.push_back(all.uv[i]);
    }
    bare.contentHash = ContentHash().add(city.contentHash).add("without trees").hex();
    return bare;
}

Result<std::optional<DrivenCity>> drivenWithoutTrees(const DrivenCity& driven,
                                                     const std::filesystem::path& projectFile,
                                                     const JobContext& job) {
    if (treesOf(driven.city.city()).triangles == 0)
        return std::nullopt;
    PrepareOptions options;
    options.city = std::make_shared<const LoadedCity>(withoutTrees(driven.city.loaded()));
    auto city = PreparedCity::prepare(driven.city.project(), projectFile,
                                      job.phase("taking the trees away", 0.0, 0.2), options);
    if (!city)
        return tl::unexpected(city.error());
    auto rems = loadRems(*city, job.phase("reading probes", 0.2, 1.0));
    if (!rems)
        return tl::unexpected(rems.error());
    return DrivenCity{std::move(*city), driven.traffic, std::move(*rems)};
}

}  // namespace reflet
