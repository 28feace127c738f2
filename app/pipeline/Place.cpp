// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Place.h"

#include "app/pipeline/LoadedCity.h"
#include "core/geo/Crs.h"
#include "core/geo/LocalNorth.h"
#include "core/io/RasterFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace reflet {

namespace {

constexpr double kDegree = kPi / 180.0;

/// Whether the file says itself where on the Earth it lies.
Result<bool> hasOwnCrs(const ModelReference& model, const std::filesystem::path& folder,
                       const JobContext& job) {
    const std::filesystem::path path = modelPath(model, folder);
    if (!model.crs.empty() && model.crs != "local")
        return true;
    std::error_code failed;
    if (std::filesystem::is_directory(path, failed))
        return true;
    if (model.use != ModelUse::City) {
        const auto raster = RasterFile::open(path);
        if (!raster)
            return tl::unexpected(raster.error());
        return raster->info().crs.has_value();
    }
    ImportOptions options;
    options.crs = model.crs;
    const auto seen = inspectFile(path, options, job);
    if (!seen)
        return tl::unexpected(seen.error());
    return seen->value.crsHorizontal.has_value();
}

ModelPlacement placementOf(const PlaceByOffset& how) {
    return {how.offset, how.heading, 1.0};
}

double bearing(const glm::dvec2& from, const glm::dvec2& to) {
    return std::atan2(to.x - from.x, to.y - from.y);
}

Result<ModelPlacement> placementOf(const PlaceByPoints& how, std::vector<Diagnostic>& remarks) {
    const double inModel = glm::length(how.inModel[1] - how.inModel[0]);
    const double onMap = glm::length(how.onMap[1] - how.onMap[0]);
    constexpr double kNearest = 0.1;
    if (!(inModel >= kNearest && onMap >= kNearest))
        return fail(ErrorCode::Usage, "two points of a pair lie together", "points",
                    "Take points that are far apart, best at opposite ends of the model.");
    const double ratio = onMap / inModel;
    constexpr double kSuspicious = 0.005;
    if (std::abs(ratio - 1.0) > kSuspicious)
        remarks.push_back(
            {Severity::Warning, "place-distance", "",
             fmt::format("The points are {:.2f} m apart on the map and {:.2f} m in the model; it "
                         "was not scaled, each point lies {:.2f} m off.",
                         onMap, inModel, 0.5 * std::abs(onMap - inModel)),
             "Check the points, and whether the model is in metres."});
    ModelPlacement out;
    out.heading = std::remainder(
        bearing(how.onMap[0], how.onMap[1]) - bearing(how.inModel[0], how.inModel[1]), 2.0 * kPi);
    const glm::dvec2 middle = 0.5 * (how.inModel[0] + how.inModel[1]);
    const glm::dvec2 target = 0.5 * (how.onMap[0] + how.onMap[1]);
    out.offset = glm::dvec3(target, how.up) - out * glm::dvec3(middle, 0.0);
    return out;
}

Result<ModelPlacement> placementOf(const PlaceByLonLat& how, const std::string& crs) {
    const auto north = localNorth(crs, how.longitude, how.latitude);
    if (!north)
        return tl::unexpected(north.error());
    return ModelPlacement{glm::dvec3(north->grid, how.up),
                          std::remainder(how.heading - north->convergence, 2.0 * kPi),
                          north->scale};
}

/// The CRS that a local project comes into; nullopt: it stays local.
Result<std::optional<std::string>> newCrs(const PlaceRequest& request) {
    const auto* place = std::get_if<PlaceByLonLat>(&request.how);
    if (request.crs.empty() && place == nullptr)
        return std::nullopt;
    std::string text = request.crs;
    if (text.empty()) {
        auto zone = utmZone(place->longitude, place->latitude);
        if (!zone)
            return tl::unexpected(zone.error());
        text = std::move(*zone);
    }
    const auto crs = Crs::parse(text);
    if (!crs)
        return tl::unexpected(crs.error());
    if (!crs->isProjected() || crs->metresPerUnit() != 1.0)
        return fail(ErrorCode::Refused, "the project's CRS must be a projected one in metres", text,
                    "Choose one, for example the UTM zone.");
    return std::optional(crs->horizontal());
}

/// All that has a position in a project, moved as one.
void moveAll(Project& project, const ModelPlacement& move, const std::string& crs) {
    for (ModelReference& model : project.models) {
        model.placement = model.placement ? move * *model.placement : move;
        model.crs = "local";
    }
    for (Probe& probe : project.probes)
        probe.position = move * probe.position;
    for (NoProbeArea& area : project.noProbes)
        area.center = glm::dvec2(move * glm::dvec3(area.center, 0.0));
    for (RouteSpec& route : project.routes)
        for (glm::dvec3& point : route.points)
            point = move * point;
    for (View& view : project.views) {
        view.position = move * view.position;
        view.target = move * view.target;
    }
    project.frame.origin = frameOrigin(move * project.frame.origin);
    project.frame.crs = crs;
}

struct Numbers {
    std::vector<double> values;
    std::string kind;
    std::string model;
};

tl::unexpected<Error> notUnderstood(std::string_view text) {
    return fail(ErrorCode::Usage, "\"" + std::string(text) + "\" is not understood", "--place",
                "Write [MODEL=]offset:E,N[,U[,HEADING]], points:X1,Y1,E1,N1,X2,Y2,E2,N2[,U] or "
                "lonlat:LON,LAT[,HEADING[,U]], headings in degrees.");
}

/// "MODEL=kind:1,2,3"
Result<Numbers> numbersOf(std::string_view text) {
    Numbers out;
    std::string_view rest = text;
    if (const auto equals = rest.rfind('='); equals != std::string_view::npos) {
        out.model = rest.substr(0, equals);
        rest.remove_prefix(equals + 1);
    }
    const auto colon = rest.find(':');
    if (colon == std::string_view::npos)
        return notUnderstood(text);
    out.kind = rest.substr(0, colon);
    rest.remove_prefix(colon + 1);
    while (true) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc() || !std::isfinite(value))
            return notUnderstood(text);
        out.values.push_back(value);
        rest.remove_prefix(std::size_t(end - rest.data()));
        if (rest.empty())
            return out;
        if (rest.front() != ',')
            return notUnderstood(text);
        rest.remove_prefix(1);
    }
}

}  // namespace

Result<ModelReference*> findModel(Project& project, const std::string& name) {
    std::vector<ModelReference*> found;
    for (ModelReference& model : project.models)
        if (!name.empty() && model.path == name)
            return &model;
    for (ModelReference& model : project.models)
        if (name.empty() || model.path.ends_with("/" + name))
            found.push_back(&model);
    if (found.size() == 1)
        return found.front();
    std::string known;
    for (const ModelReference& model : project.models)
        known += (known.empty() ? "" : ", ") + model.path;
    return fail(ErrorCode::Usage,
                found.empty() ? "the project has no model of that path"
                              : "more than one model could be meant",
                name, "Its models are: " + known + ".");
}

Result<PlaceRequest> parsePlace(std::string_view text) {
    const auto read = numbersOf(text);
    if (!read)
        return tl::unexpected(read.error());
    const std::vector<double>& v = read->values;
    const auto at = [&](std::size_t k) { return k < v.size() ? v[k] : 0.0; };
    const auto count = [&](std::size_t least, std::size_t most) {
        return v.size() >= least && v.size() <= most;
    };
    PlaceRequest request;
    request.model = read->model;
    if (read->kind == "offset" && count(2, 4))
        request.how = PlaceByOffset{{at(0), at(1), at(2)}, at(3) * kDegree};
    else if (read->kind == "points" && count(8, 9))
        request.how = PlaceByPoints{{glm::dvec2(at(0), at(1)), glm::dvec2(at(4), at(5))},
                                    {glm::dvec2(at(2), at(3)), glm::dvec2(at(6), at(7))},
                                    at(8)};
    else if (read->kind == "lonlat" && count(2, 4))
        request.how = PlaceByLonLat{at(0), at(1), at(2) * kDegree, at(3)};
    else
        return notUnderstood(text);
    return request;
}

Result<PlacedProject> placeModel(Project project, const PlaceRequest& request,
                                 const std::filesystem::path& folder, const JobContext& job) {
    PlacedProject out;
    const auto found = findModel(project, request.model);
    if (!found)
        return tl::unexpected(found.error());
    ModelReference& model = **found;
    const auto ownCrs = hasOwnCrs(model, folder, job);
    if (!ownCrs)
        return tl::unexpected(ownCrs.error());
    const auto* byOffset = std::get_if<PlaceByOffset>(&request.how);
    if (*ownCrs && (byOffset == nullptr || byOffset->heading != 0.0))
        return fail(ErrorCode::Refused, "has a place on the Earth; it can only be moved",
                    model.path,
                    "Move it by an offset alone, for example 43.2 m up for another height datum: "
                    "offset:0,0,43.2.");
    if (*ownCrs) {
        model.placement = placementOf(*byOffset);
        out.project = std::move(project);
        return out;
    }
    std::optional<std::string> crs;
    if (!project.frame.crs) {
        auto chosen = newCrs(request);
        if (!chosen)
            return tl::unexpected(chosen.error());
        crs = std::move(*chosen);
    }
    const std::string grid = crs ? *crs : project.frame.crs.value_or("");
    Result<ModelPlacement> placement = ModelPlacement{};
    if (byOffset != nullptr)
        placement = placementOf(*byOffset);
    else if (const auto* points = std::get_if<PlaceByPoints>(&request.how))
        placement = placementOf(*points, out.remarks);
    else
        placement = placementOf(std::get<PlaceByLonLat>(request.how), grid);
    if (!placement)
        return tl::unexpected(placement.error());
    if (crs) {
        // What the model stands at now comes to the new place, and all else with it.
        const ModelPlacement now = model.placement.value_or(ModelPlacement{});
        moveAll(project, *placement * inverse(now), *crs);
    } else {
        model.placement = *placement;
        model.crs = "local";
    }
    out.project = std::move(project);
    return out;
}

}  // namespace reflet
