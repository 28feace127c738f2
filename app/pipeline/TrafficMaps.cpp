// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TrafficMaps.h"

#include "core/rendering/MapBodies.h"

namespace reflet {

namespace {

Box boundsOf(const PlacedBody& body) {
    Box box;
    for (const glm::vec3& v : body.vehicle->bodies[body.body].vertices)
        box.add(glm::dvec3(v));
    return box;
}

}  // namespace

Result<TrafficMaps> TrafficMaps::create(const PreparedCity& city, const RemSet& rems,
                                        std::vector<PlacedReflector> reflectors,
                                        const JobContext& job) {
    TrafficMaps maps;
    maps.m_city = &city;
    maps.m_rems = rems;
    maps.m_reflectors = std::move(reflectors);
    std::size_t first = 0;
    for (const PlacedReflector& reflector : maps.m_reflectors) {
        maps.m_first.push_back(first);
        first += reflector.poses.size();
    }
    maps.m_geometry = std::make_unique<BodyGeometry>(maps.m_reflectors);
    auto scene = city.sceneWith(maps.m_geometry->occluders(), job);
    if (!scene)
        return tl::unexpected(scene.error());
    maps.m_scene = std::move(*scene);
    return maps;
}

glm::dvec3 TrafficMaps::center(std::size_t body) const {
    const PlacedBody& placed = bodies()[body];
    return placed.project_from_body * glm::dvec3(placed.vehicle->bodies[placed.body].center);
}

void TrafficMaps::lookUpPixels(std::vector<PlacedBody>& bodies) {
    if (m_pixels.empty()) {
        const auto prepared = m_city->preparedRems(m_rems);
        const ReconstructionInput input{&m_city->tracer(), m_rems, m_city->diameter(),
                                        prepared.get()};
        for (const PlacedReflector& reflector : m_reflectors) {
            m_pixels.push_back(std::make_unique<PixelReflections>(input, reflector.middle(),
                                                                  m_city->project().tuning));
        }
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (reflectsAnything(*bodies[i].vehicle))
            bodies[i].pixels = m_pixels[bodies[i].reflector].get();
    }
}

Result<const LocalEnvironmentMap*> TrafficMaps::cityMap(std::size_t body, Method method,
                                                        const JobContext& job) {
    const auto known = m_cityMaps.find({body, method});
    if (known != m_cityMaps.end())
        return &known->second;
    std::shared_ptr<const RadianceScene> scene;
    if (method == Method::RayTrace) {
        auto made = m_city->scene(job);
        if (!made)
            return tl::unexpected(made.error());
        scene = std::move(*made);
    }
    auto map = reconstruct(*m_city, m_rems, scene.get(), method, center(body), job);
    if (!map)
        return tl::unexpected(map.error());
    return &m_cityMaps.insert_or_assign({body, method}, std::move(*map)).first->second;
}

Result<LocalEnvironmentMap> TrafficMaps::map(std::size_t body, Method method,
                                             const JobContext& job) {
    const auto own = cityMap(body, method, job);
    if (!own)
        return tl::unexpected(own.error());
    LocalEnvironmentMap out = **own;
    if (method == Method::Sky)
        return out;
    const std::size_t reflector = bodies()[body].reflector;
    const int resolution = out.radiance.resolution();
    std::vector<PlacedBody> others = bodies();
    MapBodies drawing{m_scene.get(), others, nullptr, 2};
    std::shared_ptr<const RadianceScene> city;
    if (method == Method::RayTrace) {
        auto made = m_city->scene(job);
        if (!made)
            return tl::unexpected(made.error());
        city = std::move(*made);
        drawing.city = city.get();
        drawing.samplesPerEdge = m_city->project().bake.samplesPerEdge;
    }
    for (std::size_t i = 0; i < others.size() && method != Method::RayTrace; ++i) {
        if (others[i].reflector == reflector || !reflectsAnything(*others[i].vehicle) ||
            !fillsTexel(boundsOf(others[i]), others[i].project_from_body, out.center, resolution))
            continue;
        const auto mirrored = cityMap(i, method, job);
        if (!mirrored)
            return tl::unexpected(mirrored.error());
        others[i].map = *mirrored;
    }
    const auto drawn = drawIntoMap(out, reflector, drawing, job);
    if (!drawn)
        return tl::unexpected(drawn.error());
    return out;
}

Result<std::vector<std::vector<std::shared_ptr<const LocalEnvironmentMap>>>> tracedMaps(
    const PreparedCity& city, const std::vector<PlacedReflector>& reflectors,
    const JobContext& job) {
    auto maps = TrafficMaps::create(city, {}, reflectors, job);
    if (!maps)
        return tl::unexpected(maps.error());
    std::vector<std::vector<std::shared_ptr<const LocalEnvironmentMap>>> out(reflectors.size());
    for (std::size_t r = 0; r < reflectors.size(); ++r) {
        for (std::size_t i = 0; i < reflectors[r].poses.size(); ++i) {
            if (!reflectsAnything(*reflectors[r].vehicle))
                break;
            auto map = maps->map(maps->firstBody(r) + i, Method::RayTrace, job);
            if (!map)
                return tl::unexpected(map.error());
            out[r].push_back(std::make_shared<const LocalEnvironmentMap>(std::move(*map)));
        }
    }
    return out;
}

}  // namespace reflet
