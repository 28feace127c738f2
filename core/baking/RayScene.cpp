// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RayScene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace reflet {

struct RayScene::Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::shared_ptr<const RayScene> city;  ///< the city alone, of which `scene` has an instance

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    /// An empty scene of the device.
    void openScene();
    /// Builds its BVH.
    [[nodiscard]] Result<void> commit(const JobContext& job) const;
    /// Embree 3.13.5 never returns from some coherent packets of shadow rays into an instance
    /// (seen on AVX-512), so that scenes with one go without the coherent traversal.
    [[nodiscard]] RTCIntersectContextFlags packetFlags() const {
        return city == nullptr ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                               : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }

    ~Handles() {
        if (scene != nullptr) {
            rtcReleaseScene(scene);
        }
        if (device != nullptr) {
            rtcReleaseDevice(device);
        }
    }
};

namespace {

constexpr unsigned kCityGeometry = 0;
constexpr std::size_t kPacket = 16;

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Copies a mesh into buffers of Embree's own (padded as it needs them). A triangle with an index
/// out of range or a vertex that is not finite becomes a point at vertex 0, which no ray meets.
template <class TriangleAt>
bool attachMesh(RTCDevice device, RTCScene scene, unsigned id, std::span<const glm::vec3> vertices,
                std::size_t triangles, const TriangleAt& triangleAt) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), std::max<std::size_t>(vertices.size(), 1)));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), std::max<std::size_t>(triangles, 1)));
    const bool allocated = positions != nullptr && indices != nullptr;
    if (allocated) {
        std::fill_n(positions, 3, 0.0F);
        std::fill_n(indices, 3, 0U);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::vec3 p = finite(vertices[i]) ? vertices[i] : glm::vec3(0.0F);
            std::memcpy(positions + 3 * i, &p, sizeof(p));
        }
        for (std::size_t i = 0; i < triangles; ++i) {
            const glm::uvec3 t = triangleAt(i);
            const bool sound = t.x < vertices.size() && t.y < vertices.size() &&
                               t.z < vertices.size() && finite(vertices[t.x]) &&
                               finite(vertices[t.y]) && finite(vertices[t.z]);
            const glm::uvec3 kept = sound ? t : glm::uvec3(0U);
            std::memcpy(indices + 3 * i, &kept, sizeof(kept));
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
    }
    rtcReleaseGeometry(geometry);
    return allocated;
}

bool continueBuild(void* job, double fraction) {
    static_cast<const JobContext*>(job)->progress(fraction);
    return !static_cast<const JobContext*>(job)->cancelled();
}

Error buildError(RTCError code) {
    if (code == RTC_ERROR_CANCELLED) {
        return JobContext::cancelledError();
    }
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
        return {ErrorCode::ResourceLimit,
                "There is not enough memory for the ray tracing structure of the city",
                {},
                "Import a smaller area or fewer levels of detail.",
                {}};
    }
    return {
        ErrorCode::Internal,
        "Embree refused to build the ray tracing structure (error " + std::to_string(code) + ")",
        {},
        {},
        {}};
}

SceneHit sceneHit(unsigned geometry, unsigned primitive, float distance, float u, float v) {
    SceneHit hit;
    hit.distance = kInfinity;
    if (geometry == RTC_INVALID_GEOMETRY_ID) {
        return hit;
    }
    hit.distance = distance;
    hit.barycentric = {u, v};
    if (geometry == kCityGeometry) {
        hit.triangle = primitive;
    } else {
        hit.occluder = geometry - 1;
        hit.occluderTriangle = primitive;
    }
    return hit;
}

/// Fills the rays [first, first + count) of a packet; the rest are inactive.
template <class Packet>
void fillPacket(Packet& ray, std::array<int, kPacket>& active, std::span<const glm::vec3> origins,
                std::span<const glm::vec3> directions, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        const std::size_t k = first + std::min(i, count - 1);
        active[i] = i < count ? -1 : 0;
        ray.org_x[i] = origins[k].x;
        ray.org_y[i] = origins[k].y;
        ray.org_z[i] = origins[k].z;
        ray.dir_x[i] = directions[k].x;
        ray.dir_y[i] = directions[k].y;
        ray.dir_z[i] = directions[k].z;
        ray.tnear[i] = 0.0F;
        ray.time[i] = 0.0F;
        ray.mask[i] = 0xffffffffU;
        ray.id[i] = unsigned(i);
        ray.flags[i] = 0;
    }
}

RTCRay singleRay(const glm::vec3& origin, const glm::vec3& direction, float distance) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = distance;
    ray.mask = 0xffffffffU;
    return ray;
}

/// Tells each hit of a ray to a visitor and lets the ray go on.
struct CrossingContext {
    RTCIntersectContext context;  // must come first: Embree hands back a pointer to it
    const std::function<void(std::uint32_t, float)>* visit;
};

void reportCrossing(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    arguments->valid[0] = 0;
    if (RTCHitN_geomID(arguments->hit, 1, 0) == kCityGeometry) {
        const auto* crossing = reinterpret_cast<const CrossingContext*>(arguments->context);
        (*crossing->visit)(RTCHitN_primID(arguments->hit, 1, 0),
                           RTCRayN_tfar(arguments->ray, 1, 0));
    }
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Handles> handles) : m_handles(std::move(handles)) {}
RayScene::~RayScene() = default;

void RayScene::Handles::openScene() {
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene,
                     RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
}

Result<void> RayScene::Handles::commit(const JobContext& job) const {
    JobContext shared = job;
    rtcSetSceneProgressMonitorFunction(scene, continueBuild, &shared);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE) {
        return tl::unexpected(buildError(code));
    }
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return {};
}

Result<std::unique_ptr<RayScene>> RayScene::build(const CityModel& city,
                                                  std::span<const Occluder> occluders,
                                                  const JobContext& job) {
    auto handles = std::make_unique<Handles>();
    handles->device = rtcNewDevice(nullptr);
    if (handles->device == nullptr) {
        return tl::unexpected(buildError(rtcGetDeviceError(nullptr)));
    }
    handles->openScene();
    const bool allocated = attachMesh(handles->device, handles->scene, kCityGeometry, city.vertices,
                                      city.triangles.size(), [&](std::size_t i) {
                                          const auto& v = city.triangles[i].vertex;
                                          return glm::uvec3(v[0], v[1], v[2]);
                                      });
    if (!allocated) {
        return tl::unexpected(buildError(RTC_ERROR_OUT_OF_MEMORY));
    }
    if (auto committed = handles->commit(job); !committed) {
        return tl::unexpected(committed.error());
    }
    std::unique_ptr<RayScene> scene(new RayScene(std::move(handles)));
    return occluders.empty() ? std::move(scene) : withOccluders(std::move(scene), occluders, job);
}

Result<std::unique_ptr<RayScene>> RayScene::withOccluders(std::shared_ptr<const RayScene> city,
                                                          std::span<const Occluder> occluders,
                                                          const JobContext& job) {
    if (city->m_handles->city != nullptr) {
        city = city->m_handles->city;
    }
    // An instance of its own device: Embree shares scenes within a device only. Hits in the
    // instance report the city's geometry number, those of occluders follow it.
    auto handles = std::make_unique<Handles>();
    handles->device = city->m_handles->device;
    rtcRetainDevice(handles->device);
    handles->openScene();
    RTCGeometry instance = rtcNewGeometry(handles->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, city->m_handles->scene);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(handles->scene, instance, kCityGeometry);
    rtcReleaseGeometry(instance);
    handles->city = std::move(city);
    bool allocated = true;
    for (std::size_t i = 0; allocated && i < occluders.size(); ++i) {
        const Occluder& occluder = occluders[i];
        allocated = attachMesh(handles->device, handles->scene, unsigned(i + 1), occluder.vertices,
                               occluder.triangles.size(),
                               [&](std::size_t k) { return occluder.triangles[k]; });
    }
    if (!allocated) {
        return tl::unexpected(buildError(RTC_ERROR_OUT_OF_MEMORY));
    }
    if (auto committed = handles->commit(job); !committed) {
        return tl::unexpected(committed.error());
    }
    return std::unique_ptr<RayScene>(new RayScene(std::move(handles)));
}

SceneHit RayScene::intersect(const glm::vec3& origin, const glm::vec3& direction,
                             float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = singleRay(origin, direction, distance);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(m_handles->scene, &context, &query);
    return sceneHit(query.hit.geomID, query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v);
}

void RayScene::intersect(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                         float distance, std::span<SceneHit> hits) const {
    assert(origins.size() == directions.size() && origins.size() == hits.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = m_handles->packetFlags();
    RTCRayHit16 query;
    alignas(64) std::array<int, kPacket> active;
    for (std::size_t first = 0; first < origins.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, origins.size() - first);
        fillPacket(query.ray, active, origins, directions, first, count);
        std::fill_n(query.ray.tfar, kPacket, distance);
        std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(query.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(active.data(), m_handles->scene, &context, &query);
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i] = sceneHit(query.hit.geomID[i], query.hit.primID[i], query.ray.tfar[i],
                                       query.hit.u[i], query.hit.v[i]);
        }
    }
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = singleRay(origin, direction, distance);
    rtcOccluded1(m_handles->scene, &context, &ray);
    return ray.tfar < 0.0F;
}

void RayScene::occluded(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                        std::span<const float> distances, std::span<unsigned char> occluded) const {
    assert(origins.size() == directions.size() && origins.size() == distances.size() &&
           origins.size() == occluded.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = m_handles->packetFlags();
    RTCRay16 ray;
    alignas(64) std::array<int, kPacket> active;
    for (std::size_t first = 0; first < origins.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, origins.size() - first);
        fillPacket(ray, active, origins, directions, first, count);
        for (std::size_t i = 0; i < kPacket; ++i) {
            ray.tfar[i] = distances[first + std::min(i, count - 1)];
        }
        rtcOccluded16(active.data(), m_handles->scene, &context, &ray);
        for (std::size_t i = 0; i < count; ++i) {
            occluded[first + i] = ray.tfar[i] < 0.0F ? 1 : 0;
        }
    }
}

void RayScene::crossings(const glm::vec3& origin, const glm::vec3& direction,
                         const std::function<void(std::uint32_t, float)>& visit) const {
    CrossingContext crossing{};
    rtcInitIntersectContext(&crossing.context);
    crossing.context.filter = reportCrossing;
    crossing.visit = &visit;
    RTCRayHit query{};
    query.ray = singleRay(origin, direction, kInfinity);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(m_handles->scene, &crossing.context, &query);
}

}  // namespace reflet
