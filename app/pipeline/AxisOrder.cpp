// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/AxisOrder.h"

#include "app/pipeline/LoadedCity.h"
#include "app/pipeline/Place.h"

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

/// The origin that the project would have if it were made of the model now.
Result<glm::dvec3> originOf(const ModelReference& model, const Project& project,
                            const std::filesystem::path& folder, const JobContext& job) {
    ImportOptions options = importOptionsOf(model, project.frame);
    options.frame.reset();
    options.projectCrs = project.frame.crs.value_or("");
    const auto imported = importFile(modelPath(model, folder), options, job);
    if (!imported)
        return tl::unexpected(imported.error());
    return imported->value.city.frame.origin;
}

/// All that has a position in a project, on the other side of the line where east equals north.
void exchangePositions(Project& project) {
    const auto exchange = [](glm::dvec3& point) { std::swap(point.x, point.y); };
    for (Probe& probe : project.probes)
        exchange(probe.position);
    for (RouteSpec& route : project.routes)
        std::for_each(route.points.begin(), route.points.end(), exchange);
    for (View& view : project.views) {
        exchange(view.position);
        exchange(view.target);
    }
}

}  // namespace

Result<Project> withAxisOrder(Project project, const std::vector<std::string>& models,
                              const std::string& order, const std::filesystem::path& folder,
                              const JobContext& job) {
    if (order != "en" && order != "ne")
        return fail(ErrorCode::Usage, "is no order of coordinates", order,
                    "Say en where east comes first in the file, ne where north does.");
    for (const std::string& name : models) {
        const auto model = findModel(project, name);
        if (!model)
            return tl::unexpected(model.error());
        if ((*model)->use != ModelUse::City)
            return fail(ErrorCode::Refused, "is a raster, whose axes are known", (*model)->path,
                        "Mend its place with gdal_translate -a_ullr.");
        (*model)->axisOrder = order;
    }
    const auto isCity = [](const ModelReference& m) { return m.use == ModelUse::City; };
    const auto first = std::find_if(project.models.begin(), project.models.end(), isCity);
    if (first == project.models.end() || first->axisOrder != order || first->placement)
        return project;
    const auto origin = originOf(*first, project, folder, job);
    if (!origin)
        return tl::unexpected(origin.error());
    const glm::dvec3 before = std::exchange(project.frame.origin, *origin);
    const bool crossed = *origin != before && *origin == glm::dvec3(before.y, before.x, before.z);
    const bool all = std::all_of(project.models.begin(), project.models.end(),
                                 [&](const auto& m) { return !isCity(m) || m.axisOrder == order; });
    if (crossed && all)
        exchangePositions(project);
    return project;
}

}  // namespace reflet
