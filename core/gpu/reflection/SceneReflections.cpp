// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/SceneReflections.h"

#include "core/rendering/MapBodies.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace reflet {

namespace {

/// Metres from the camera beyond which a body's map is not worth more than the nearest REM.
constexpr double kReflectorRange = 400.0;
/// Samples along the edge of a texel that vehicles are drawn with into local maps of stills.
constexpr int kMapSamples = 2;
/// Metres in one picture beyond which a body did not drive but was put elsewhere.
constexpr double kJump = 5.0;

/// While something moves, bodies that look smaller than so many texels are left out of maps.
constexpr int kSmallestOther = 4;
/// Metres within which a car is as large as that in a map of 128².
constexpr double kOtherRange = 90.0;

std::size_t othersNear(const FrameRequest& request, const SceneBody& body) {
    std::size_t count = 0;
    for (const PlacedReflector& other : request.reflectors) {
        for (std::size_t i = 0; other.id != body.reflector && i < other.poses.size(); ++i) {
            const double away = glm::distance(other.poses[i].translation, body.mapCenter);
            count += away < kOtherRange ? 1 : 0;
        }
    }
    return count;
}

bool usesRays(Method method) {
    return method == Method::Mem || method == Method::Dense;
}

/// Whether a method's maps are made by Reflet, finely or not.
bool hasDetail(Method method) {
    return method != Method::Sky && method != Method::RayTrace;
}

}  // namespace

void SceneReflections::setCity(std::shared_ptr<const DrawnCity> city) {
    m_planner.setCity(std::move(city));
    invalidate();
}

void SceneReflections::invalidate() {
    m_maps.invalidate();
}

void SceneReflections::smear(const FrameRequest& request, std::span<SceneBody> bodies) {
    const double share = request.moving ? std::clamp(request.tuning.lod.blur, 0.0, 1.0) : 0.0;
    std::map<std::pair<std::string, std::size_t>, glm::dvec3> centers;
    for (SceneBody& body : bodies) {
        const std::pair key(body.reflector, body.drawn.body);
        centers[key] = body.mapCenter;
        const auto before = m_centers.find(key);
        if (share <= 0.0 || before == m_centers.end())
            continue;
        const glm::dvec3 way = body.mapCenter - before->second;
        if (glm::length(way) <= kJump)
            body.drawn.smear = glm::vec3(share * way);
    }
    m_centers = std::move(centers);
}

void SceneReflections::planDetails(const FrameRequest& request) {
    m_choices.clear();
    if (!request.moving || !request.tuning.lod.on)
        return;
    std::vector<DetailPlanner::Body> seen;
    for (const SceneBody& body : m_bodies) {
        const VehicleMesh::Body& mesh = *body.drawn.mesh;
        seen.push_back({body.reflector, body.drawn.body, body.mapCenter,
                        placedBounds(mesh.bounds, body.drawn.project_from_body),
                        double(body.pixels), mesh.squeeze, body.interest,
                        othersNear(request, body)});
    }
    m_choices = m_planner.plan(seen, request.camera.position, request.tuning, request.scale < 1.0F);
}

void SceneReflections::want(const FrameRequest& request, std::size_t i, Method method,
                            std::size_t place, FrameStatistics& statistics) {
    const SceneBody& body = m_bodies[i];
    if (!reflectsAnything(*body.drawn.vehicle))
        return;
    ReflectionMaps::Wanted wanted;
    wanted.reflector = body.reflector;
    wanted.body = body.drawn.body;
    wanted.asked = method;
    wanted.tuned = request.tuning;
    wanted.tuned.lod = {};  // another budget makes no other map
    // Looked up pixel by pixel the city needs no map, but the vehicles in it do.
    if (method == Method::PerPixel)
        method = Method::Mem;
    wanted.request = {method, body.mapCenter, wanted.tuned, nullptr};
    LocalMapRequest& map = wanted.request;
    if (method == Method::RayTrace) {
        const auto given = request.given.find(body.reflector);
        if (given != request.given.end() && body.drawn.body < given->second.size())
            map.given = given->second[body.drawn.body];
        statistics.referenceMissing = statistics.referenceMissing || !map.given;
        map.method = map.given ? method : Method::Mem;
    } else if (method != Method::Sky &&
               glm::distance(body.mapCenter, request.camera.position) > kReflectorRange) {
        map.method = Method::Nearest;
    }
    if (!m_choices.empty() && hasDetail(map.method)) {
        const DetailPlanner::Choice& choice = m_choices[i];
        wanted.detail = choice.detail;
        wanted.weight = choice.weight;
        wanted.units = choice.units;
        wanted.hidden = choice.hidden;
        map.settings = settingsOf(choice.detail, wanted.tuned);
        if (choice.detail.blend && usesRays(map.method))
            map.method = Method::Blend;
    }
    m_wanted.push_back(std::move(wanted));
    m_places.push_back(place);
}

void SceneReflections::begin(const FrameRequest& request, std::span<const SceneBody> bodies,
                             float split, const LocalMapPass& pass, FrameStatistics& statistics) {
    m_bodies.assign(bodies.begin(), bodies.end());
    planDetails(request);
    m_wanted.clear();
    m_places.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].columns.from <= split)
            want(request, i, request.method, i, statistics);
    }
    m_leftMaps = m_wanted.size();
    for (std::size_t i = 0; request.right && i < bodies.size(); ++i) {
        if (bodies[i].columns.to >= split)
            want(request, i, *request.right, bodies.size() + i, statistics);
    }
    m_maps.begin(m_wanted, pass,
                 m_choices.empty() ? ReflectionMaps::kAll : m_planner.budget().allowedUnits());
    count(statistics);
}

void SceneReflections::count(FrameStatistics& statistics) const {
    LodStatistics& lod = statistics.lod;
    lod.on = !m_choices.empty();
    if (!lod.on)
        return;
    lod.coarse = m_planner.budget().coarse();
    lod.allowed = m_planner.budget().allowedMilliseconds();
    lod.shared = m_maps.report().shared.size();
    lod.waiting = m_maps.report().waiting;
    for (const ReflectionMaps::Wanted& wanted : m_wanted) {
        if (!wanted.detail)
            continue;
        const bool full =
            wanted.detail->quadStep == 0 && wanted.detail->resolution == wanted.tuned.resolution;
        ++(wanted.hidden          ? lod.hidden
           : wanted.detail->blend ? lod.blended
           : full                 ? lod.full
                                  : lod.reduced);
    }
}

std::vector<GpuLocalMap> SceneReflections::finish(LocalMapPass& pass, CityPass* city,
                                                  FrameStatistics& statistics) {
    const std::vector<GpuLocalMap> maps = m_maps.finish(pass, city);
    std::vector<GpuLocalMap> placed(2 * m_bodies.size());
    for (std::size_t k = 0; k < maps.size(); ++k)
        placed[m_places[k]] = maps[k];
    m_isNew.assign(maps.size(), false);
    const ReflectionMaps::Report& report = m_maps.report();
    statistics.localMaps = report.drawn.size();
    statistics.tracing = report.waited;
    for (const std::size_t k : report.drawn) {
        m_isNew[k] = true;
        const ReconstructionStatistics& drawn = maps[k].statistics;
        if (k >= m_leftMaps)
            continue;
        statistics.quads += drawn.quads;
        statistics.rays += drawn.rays;
        statistics.vertices += drawn.vertices;
        statistics.uncovered += drawn.uncovered;
    }
    return placed;
}

void SceneReflections::drawIntoMaps(const FrameRequest& request, VehicleMeshes& vehicles,
                                    MapBodiesPass& pass, BodyPass& bodyPass,
                                    std::vector<GpuLocalMap>& maps) {
    m_copyUnits = 0.0;
    if (request.reflectors.size() < 2)
        return;
    std::vector<MapBodiesPass::Other> others;
    for (const PlacedReflector& reflector : request.reflectors) {
        if (!reflector.vehicle)
            continue;
        const VehicleMesh& mesh = vehicles.of(reflector.vehicle);
        for (std::size_t i = 0; i < std::min(mesh.bodies.size(), reflector.poses.size()); ++i) {
            others.push_back({reflector.id,
                              {reflector.vehicle.get(),
                               &mesh.bodies[i],
                               {},
                               &mesh.materials,
                               i,
                               reflector.poses[i]},
                              {}});
        }
    }
    std::vector<std::size_t> shown;  // bodies in the view, among the others
    for (const SceneBody& body : m_bodies) {
        const auto same = [&](const MapBodiesPass::Other& other) {
            return other.reflector == body.reflector && other.drawn.body == body.drawn.body;
        };
        shown.push_back(
            std::size_t(std::find_if(others.begin(), others.end(), same) - others.begin()));
    }
    for (std::size_t first = 0; first < maps.size(); first += m_bodies.size()) {
        for (std::size_t i = 0; i < m_bodies.size(); ++i)
            others[shown[i]].mirrors = maps[first + i];
        drawSide(request, first, others, pass, bodyPass, maps);
    }
    m_copyUnits = pass.drawnUnits();
}

void SceneReflections::drawSide(const FrameRequest& request, std::size_t first,
                                std::span<const MapBodiesPass::Other> others, MapBodiesPass& pass,
                                BodyPass& bodyPass, std::vector<GpuLocalMap>& maps) {
    std::vector<MapBodiesPass::CityMap> wanted;
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < m_places.size(); ++k) {
        const std::size_t place = m_places[k];
        const ReflectionMaps::Wanted& map = m_wanted[k];
        const bool here = place >= first && place < first + m_bodies.size();
        const bool shows = map.request.method != Method::Sky &&
                           map.request.method != Method::RayTrace && !map.hidden &&
                           !(map.detail && !map.detail->others);
        if (!here || !shows)
            continue;
        const SceneBody& body = m_bodies[place - first];
        MapBodiesPass::CityMap city{body.reflector, body.drawn.body, first == 0 ? 0 : 1,
                                    maps[place],    m_isNew[k],      0.0,
                                    map.weight};
        if (map.detail) {
            city.tolerance = map.detail->angle;
            city.smallest = kSmallestOther;
        }
        wanted.push_back(std::move(city));
        places.push_back(place);
    }
    const FrameBudget& budget = m_planner.budget();
    const double left = (budget.allowedUnits() - m_maps.report().units) / budget.othersWeight();
    const double units = m_choices.empty() ? ReflectionMaps::kAll : left - pass.drawnUnits();
    const auto drawn = pass.draw(wanted, others, bodyPass, request.moving ? 1 : kMapSamples,
                                 m_planner.hiding(), units);
    for (std::size_t k = 0; k < drawn.size(); ++k)
        maps[places[k]] = drawn[k];
}

void SceneReflections::took(const FrameStatistics& statistics) {
    if (m_choices.empty())
        return;
    m_planner.budget().took(statistics.milliseconds,
                            {statistics.tracing + statistics.maps, m_maps.report().units},
                            {statistics.inMaps, m_copyUnits});
}

}  // namespace reflet
